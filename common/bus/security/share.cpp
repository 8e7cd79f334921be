#include "common/bus/security/share.h"

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

#include "common/bus/membership/cluster_options.h"
#include "common/configuration/shown_text.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kIdDigits = 8;
constexpr std::size_t kParts = 8;
constexpr std::size_t kLongestTicket = 4096;
constexpr const char* kVersion = "1";
constexpr const char* kOperator = "operate";
constexpr const char* kWatcher = "watch";

const char* RoleWord(ShareRole role) { return role == ShareRole::kOperator ? kOperator : kWatcher; }

template <class Number>
std::optional<Number> NumberOfText(const std::string& text)
{
  Number number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

// The address of this machine from which datagrams to that one go out.
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
    throw BusError(fmt::format("there is no way from this machine to {}, where the run of the share is", address));
  return text;
}

}  // namespace

bool Share::HasEnded() const { return ends != 0 && std::time(nullptr) >= ends; }

std::optional<ShareRole> ShareRoleOf(double number)
{
  for (const ShareRole role : {ShareRole::kWatcher, ShareRole::kOperator, ShareRole::kOpenView})
    if (number == static_cast<double>(role)) return role;
  return std::nullopt;
}

const char* RoleName(ShareRole role)
{
  return role == ShareRole::kWatcher ? "watcher" : role == ShareRole::kOperator ? "operator" : "open view";
}

std::string Share::Name() const
{
  return fmt::format("{}{} {}", RoleName(role), role == ShareRole::kOpenView ? "" : " share", id);
}

std::string NewShareId()
{
  std::uint32_t number = 0;
  if (getrandom(&number, sizeof number, 0) != sizeof number)
    throw BusError("the system gives no random numbers for the share");
  return fmt::format("{:08x}", number);
}

bool IsShareId(const std::string& text)
{
  return text.size() == kIdDigits && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

ShareChannel ChannelOf(const RunKey& run_key, const Share& share)
{
  if (share.role == ShareRole::kOpenView) return {kOpenChannel, std::nullopt};
  const std::string purpose = fmt::format("swarmanoid share {} {} {}", share.id, RoleWord(share.role), share.ends);
  return {share.id, DerivedKey(run_key, share.id, purpose)};
}

std::string TextOf(const ShareTicket& ticket)
{
  return fmt::format("{},{},{},{},{},{},{},{}", kVersion, ticket.share.id, RoleWord(ticket.share.role),
                     ticket.share.ends, ticket.domain,
                     ticket.discovery_server.empty() ? ticket.address : ticket.discovery_server, TextOfKey(ticket.key),
                     ticket.experiment);
}

std::optional<ShareTicket> TicketOfText(const std::string& text)
{
  if (text.size() > kLongestTicket) return std::nullopt;
  // The name of the experiment is last: it may have commas.
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; parts.size() + 1 < kParts && std::getline(stream, part, ',');) parts.push_back(part);
  std::string experiment;
  if (!std::getline(stream, experiment) || parts.size() + 1 != kParts || parts[0] != kVersion) return std::nullopt;
  const auto ends = NumberOfText<std::int64_t>(parts[3]);
  const auto domain = NumberOfText<int>(parts[4]);
  const auto key = KeyOfText(parts[6]);
  const bool is_role = parts[2] == kOperator || parts[2] == kWatcher;
  if (!IsShareId(parts[1]) || !is_role || !ends || *ends < 0 || !domain || *domain < 0 || *domain > 232 || !key ||
      experiment.empty() || !IsShowable(experiment))
    return std::nullopt;
  const ShareRole role = parts[2] == kOperator ? ShareRole::kOperator : ShareRole::kWatcher;
  ShareTicket ticket{{parts[1], role, *ends}, *domain, parts[5], {}, *key, experiment};
  if (const auto server = ParseServerAddress(parts[5]))
  {
    ticket.discovery_server = parts[5];
    ticket.address = server->first;
  }
  in_addr address{};
  if (inet_pton(AF_INET, ticket.address.c_str(), &address) != 1) return std::nullopt;
  return ticket;
}

std::optional<ShareTicket> TicketOfEnvironment()
{
  const char* const text = std::getenv(kShareVariable);
  if (text == nullptr || *text == 0) return std::nullopt;
  const auto ticket = TicketOfText(text);
  if (!ticket)
    throw BusError(
        fmt::format("{} holds no share; paste the whole line that `swarmanoid share` printed", kShareVariable));
  if (ticket->share.HasEnded())
    throw BusError(
        fmt::format("{} ended at {}; whoever started the run of '{}' can give another one, by `swarmanoid "
                    "share`",
                    ticket->share.Name(), UtcText(ticket->share.ends), ticket->experiment));
  return ticket;
}

void UseTicket(const ShareTicket& ticket, BusOptions& options)
{
  if (options.insecure)
    throw BusError(fmt::format("the {} in {} has a key; leave out --insecure", ticket.share.Name(), kShareVariable));
  const std::string own = OwnAddressTowards(ticket.address);
  const bool on_this_machine = own.starts_with("127.");
  options.domain = ticket.domain;
  if (!options.Spread()) options.network_interface = on_this_machine ? "lo" : own;
  options.discovery_server = ticket.discovery_server;
  // Found without multicast, too.
  if (!on_this_machine && ticket.discovery_server.empty()) options.peers = {ticket.address};
  options.share = ShareChannel{ticket.share.id, ticket.key};
  options.key = ticket.key;
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
