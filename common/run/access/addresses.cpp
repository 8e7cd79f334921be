#include "common/run/access/addresses.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>

#include <fmt/format.h>

#include "common/configuration/configuration_tree.h"
#include "common/run/access/bus_options.h"

namespace swarmanoid
{
namespace
{

bool LoopbackIsUp(const ifaddrs* interfaces)
{
  for (const ifaddrs* entry = interfaces; entry != nullptr; entry = entry->ifa_next)
    if (entry->ifa_addr != nullptr && entry->ifa_addr->sa_family == AF_INET && (entry->ifa_flags & IFF_LOOPBACK) != 0 &&
        (entry->ifa_flags & IFF_UP) != 0)
      return true;
  return false;
}

}  // namespace

std::optional<std::pair<std::string, unsigned>> ParseServerAddress(const std::string& text)
{
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return std::nullopt;
  const std::string digits = text.substr(colon + 1);
  if (digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
  const auto port = ParseInteger(digits);
  if (!port || *port < 1 || *port > 65535) return std::nullopt;
  return std::pair(text.substr(0, colon), static_cast<unsigned>(*port));
}

std::string ResolveHost(const std::string& host)
{
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), nullptr, &wanted, &found) != 0 || found == nullptr)
    throw BusError(fmt::format("'{}' is not the name or IPv4 address of a machine", host));
  char text[INET_ADDRSTRLEN] = {};
  inet_ntop(AF_INET, &reinterpret_cast<sockaddr_in*>(found->ai_addr)->sin_addr, text, sizeof(text));
  freeaddrinfo(found);
  return text;
}

std::vector<std::string> InterfaceAddresses(const std::string& wanted)
{
  if (wanted == "all") return {};
  std::vector<std::string> addresses;
  std::string known = "lo, all";
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) throw BusError("cannot list the network interfaces");
  if (wanted == "lo")
  {
    const bool up = LoopbackIsUp(list);
    freeifaddrs(list);
    if (!up)
      throw BusError(
          "the network interface of this machine alone, lo, is down: processes on it cannot hear one another; `ip link "
          "set lo up` cures it");
    return {"127.0.0.1"};
  }
  for (const ifaddrs* entry = list; entry != nullptr; entry = entry->ifa_next)
  {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    char text[INET_ADDRSTRLEN] = {};
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(entry->ifa_addr)->sin_addr, text, sizeof(text));
    known += fmt::format(", {} ({})", entry->ifa_name, text);
    if (wanted != entry->ifa_name && wanted != text) continue;
    // A participant on it would never hear any other.
    if ((entry->ifa_flags & IFF_RUNNING) == 0)
    {
      freeifaddrs(list);
      throw BusError(fmt::format("network interface '{}' is not connected", wanted));
    }
    addresses.emplace_back(text);
  }
  freeifaddrs(list);
  if (addresses.empty()) throw BusError(fmt::format("no network interface '{}'; there are {}", wanted, known));
  return addresses;
}

std::string ReachableAddress(const BusOptions& options)
{
  const std::vector<std::string> addresses = InterfaceAddresses(options.network_interface);
  if (!addresses.empty()) return addresses.front();
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) throw BusError("cannot list the network interfaces");
  std::string found = "127.0.0.1";
  for (const ifaddrs* entry = list; entry != nullptr; entry = entry->ifa_next)
  {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    if ((entry->ifa_flags & IFF_LOOPBACK) != 0 || (entry->ifa_flags & IFF_RUNNING) == 0) continue;
    char text[INET_ADDRSTRLEN] = {};
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(entry->ifa_addr)->sin_addr, text, sizeof(text));
    found = text;
    break;
  }
  freeifaddrs(list);
  return found;
}

}  // namespace swarmanoid
