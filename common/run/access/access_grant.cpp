#include "common/run/access/access_grant.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <ctime>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "common/configuration/shown_text.h"
#include "common/run/access/addresses.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kIdDigits = 8;
constexpr std::size_t kParts = 8;
constexpr std::size_t kLongestToken = 4096;
constexpr const char* kVersion = "1";

template <class Number>
std::optional<Number> NumberOfText(const std::string& text)
{
  Number number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

// Returns the address of this machine that datagrams to the other machine leave from.
std::string OwnAddressTowards(const std::string& address)
{
  sockaddr_in there{};
  there.sin_family = AF_INET;
  there.sin_port = htons(7400);
  const int file = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in here{};
  socklen_t size = sizeof here;
  const bool good = file >= 0 && inet_pton(AF_INET, address.c_str(), &there.sin_addr) == 1 &&
                    connect(file, reinterpret_cast<const sockaddr*>(&there), sizeof there) == 0 &&
                    getsockname(file, reinterpret_cast<sockaddr*>(&here), &size) == 0;
  if (file >= 0) close(file);
  char text[INET_ADDRSTRLEN] = {};
  if (!good || inet_ntop(AF_INET, &here.sin_addr, text, sizeof text) == nullptr)
    throw BusError(
        fmt::format("there is no way from this machine to {}, where the run of the access grant is", address));
  return text;
}

}  // namespace

bool AccessGrant::HasEnded() const { return ends != 0 && std::time(nullptr) >= ends; }

const char* RoleWord(GrantRole role)
{
  return role == GrantRole::kWatcher ? "watch" : role == GrantRole::kOperator ? "operate" : "open";
}

std::optional<GrantRole> GrantRoleOf(const std::string& word)
{
  for (const GrantRole role : {GrantRole::kWatcher, GrantRole::kOperator, GrantRole::kOpenView})
    if (word == RoleWord(role)) return role;
  return std::nullopt;
}

const char* RoleName(GrantRole role)
{
  return role == GrantRole::kWatcher ? "watcher" : role == GrantRole::kOperator ? "operator" : "open view";
}

std::string AccessGrant::Name() const
{
  return fmt::format("{}{} {}", RoleName(role), role == GrantRole::kOpenView ? "" : " grant", id);
}

std::string NewGrantId()
{
  std::uint32_t number = 0;
  if (getrandom(&number, sizeof number, 0) != sizeof number)
    throw BusError("the system gives no random numbers for the access grant");
  return fmt::format("{:08x}", number);
}

bool IsGrantId(const std::string& text)
{
  return text.size() == kIdDigits && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

std::string TextOf(const AccessToken& token)
{
  return fmt::format("{},{},{},{},{},{},{},{}", kVersion, token.grant.id, RoleWord(token.grant.role), token.grant.ends,
                     token.domain, token.discovery_server.empty() ? token.address : token.discovery_server,
                     TextOfKey(token.key), token.experiment);
}

std::optional<AccessToken> TokenOfText(const std::string& text)
{
  if (text.size() > kLongestToken) return std::nullopt;
  // The name of the experiment is last, because it may have commas.
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; parts.size() + 1 < kParts && std::getline(stream, part, ',');) parts.push_back(part);
  std::string experiment;
  if (!std::getline(stream, experiment) || parts.size() + 1 != kParts || parts[0] != kVersion) return std::nullopt;
  const auto ends = NumberOfText<std::int64_t>(parts[3]);
  const auto domain = NumberOfText<int>(parts[4]);
  const auto key = KeyOfText(parts[6]);
  const auto role = GrantRoleOf(parts[2]);
  if (!IsGrantId(parts[1]) || !role || *role == GrantRole::kOpenView || !ends || *ends < 0 || !domain || *domain < 0 ||
      *domain > 232 || !key || experiment.empty() || !IsShowable(experiment))
    return std::nullopt;
  AccessToken token{{parts[1], *role, *ends}, *domain, parts[5], {}, *key, experiment};
  if (const auto server = ParseServerAddress(parts[5]))
  {
    token.discovery_server = parts[5];
    token.address = server->first;
  }
  in_addr address{};
  if (inet_pton(AF_INET, token.address.c_str(), &address) != 1) return std::nullopt;
  return token;
}

std::optional<AccessToken> TokenOfEnvironment()
{
  const char* const text = std::getenv(kTokenVariable);
  if (text == nullptr || *text == 0) return std::nullopt;
  const auto token = TokenOfText(text);
  if (!token)
    throw BusError(
        fmt::format("{} holds no access grant; paste the whole line that `swarmanoid share` printed", kTokenVariable));
  if (token->grant.HasEnded())
    throw BusError(
        fmt::format("{} ended at {}; the owner of the run of '{}' can give another one, by `swarmanoid "
                    "share`",
                    token->grant.Name(), UtcText(token->grant.ends), token->experiment));
  return token;
}

void UseToken(const AccessToken& token, BusOptions& options)
{
  if (options.insecure)
    throw BusError(fmt::format("the {} in {} has a key; leave out --insecure", token.grant.Name(), kTokenVariable));
  const std::string own = OwnAddressTowards(token.address);
  const bool on_this_machine = own.starts_with("127.");
  options.domain = token.domain;
  if (!options.Spread()) options.network_interface = on_this_machine ? "lo" : own;
  options.discovery_server = token.discovery_server;
  // Discovery must work without multicast, too.
  if (!on_this_machine && token.discovery_server.empty()) options.peers = {token.address};
  options.grant = GrantChannel{token.grant.id, token.key};
  options.key = token.key;
}

std::string UtcText(std::int64_t seconds)
{
  const auto time = static_cast<std::time_t>(seconds);
  std::tm parts{};
  gmtime_r(&time, &parts);
  char text[32] = {};
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

}  // namespace swarmanoid
