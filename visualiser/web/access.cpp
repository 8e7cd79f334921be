#include "visualiser/web/access.h"

#include <arpa/inet.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <span>
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

std::string HexadecimalOf(std::span<const unsigned char> bytes)
{
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : bytes)
  {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
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

bool IsOwnOrigin(std::string_view origin, std::string_view host, bool tls)
{
  if (origin.empty()) return true;
  const std::string_view scheme = tls ? "https://" : "http://";
  return origin.starts_with(scheme) && Lower(origin.substr(scheme.size())) == Lower(host);
}

std::string_view PathOf(std::string_view target) { return target.substr(0, target.find('?')); }

std::string MakeToken()
{
  std::array<unsigned char, 16> bits{};
  if (getrandom(bits.data(), bits.size(), 0) != static_cast<ssize_t>(bits.size()))
    throw std::runtime_error(std::string("web_render: no random numbers for the token: ") + std::strerror(errno));
  return HexadecimalOf(bits);
}

std::string ProofOf(std::string_view token, std::string_view challenge)
{
  std::array<unsigned char, EVP_MAX_MD_SIZE> code{};
  unsigned length = 0;
  HMAC(EVP_sha256(), token.data(), static_cast<int>(token.size()),
       reinterpret_cast<const unsigned char*>(challenge.data()), challenge.size(), code.data(), &length);
  return HexadecimalOf({code.data(), length});
}

std::string Visitors::Join(std::uint64_t client)
{
  return (visitors_[client] = {MakeToken(), Authority::kReadOnly}).challenge;
}

Authority Visitors::Prove(std::uint64_t client, std::string_view proof)
{
  Visitor& visitor = visitors_.at(client);
  if (!rules_.allow_control || rules_.token.empty()) return Authority::kReadOnly;
  const std::string wanted = ProofOf(rules_.token, visitor.challenge);
  const bool proved = proof.size() == wanted.size() && CRYPTO_memcmp(proof.data(), wanted.data(), wanted.size()) == 0;
  return visitor.authority = proved ? Authority::kControl : Authority::kWrongToken;
}

bool Visitors::MayControl(std::uint64_t client) const
{
  const auto found = visitors_.find(client);
  return found != visitors_.end() && found->second.authority == Authority::kControl;
}

}  // namespace swarmanoid
