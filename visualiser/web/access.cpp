#include "visualiser/web/access.h"

#include <arpa/inet.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace swarmanoid
{
namespace
{

std::string Lower(std::string_view text)
{
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

bool IsPort(std::string_view text)
{
  return !text.empty() && text.size() <= 5 && text.find_first_not_of("0123456789") == std::string_view::npos;
}

std::string MachinesName()
{
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return {};
  return Lower(name.data());
}

}  // namespace

bool IsKnownHost(std::string_view host)
{
  std::string name;
  std::array<unsigned char, sizeof(in6_addr)> address{};
  if (host.starts_with('['))
  {
    const std::size_t end = host.find(']');
    if (end == std::string_view::npos) return false;
    const std::string_view rest = host.substr(end + 1);
    if (!rest.empty() && !(rest[0] == ':' && IsPort(rest.substr(1)))) return false;
    name = host.substr(1, end - 1);
    return inet_pton(AF_INET6, name.c_str(), address.data()) == 1;
  }
  const std::size_t colon = host.find(':');
  if (colon != std::string_view::npos && !IsPort(host.substr(colon + 1))) return false;
  name = Lower(host.substr(0, colon));
  if (name.empty()) return false;
  return name == "localhost" || name == MachinesName() || inet_pton(AF_INET, name.c_str(), address.data()) == 1;
}

bool IsOwnOrigin(std::string_view origin, std::string_view host)
{
  if (origin.empty()) return true;
  constexpr std::string_view kScheme = "http://";
  return origin.starts_with(kScheme) && Lower(origin.substr(kScheme.size())) == Lower(host);
}

std::string_view PathOf(std::string_view target) { return target.substr(0, target.find('?')); }

std::string_view QueryValue(std::string_view target, std::string_view name)
{
  std::size_t start = target.find('?');
  while (start != std::string_view::npos)
  {
    const std::size_t end = target.find('&', ++start);
    const std::string_view pair =
        target.substr(start, end == std::string_view::npos ? std::string_view::npos : end - start);
    const std::size_t equals = pair.find('=');
    if (equals != std::string_view::npos && pair.substr(0, equals) == name) return pair.substr(equals + 1);
    start = end;
  }
  return {};
}

Authority AuthorityOf(const AccessRules& rules, std::string_view token)
{
  if (!rules.allow_control || token.empty()) return Authority::kReadOnly;
  if (rules.token.empty() || token.size() != rules.token.size()) return Authority::kWrongToken;
  unsigned difference = 0;
  for (std::size_t i = 0; i < token.size(); ++i)
    difference |= static_cast<unsigned char>(token[i]) ^ static_cast<unsigned char>(rules.token[i]);
  return difference == 0 ? Authority::kControl : Authority::kWrongToken;
}

std::string MakeToken()
{
  std::array<unsigned char, 16> bits{};
  if (getrandom(bits.data(), bits.size(), 0) != static_cast<ssize_t>(bits.size()))
    throw std::runtime_error(std::string("web_render: no random numbers for the token: ") + std::strerror(errno));
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : bits)
  {
    token += kDigits[byte >> 4U];
    token += kDigits[byte & 15U];
  }
  return token;
}

}  // namespace swarmanoid
