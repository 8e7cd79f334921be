// The addresses of this machine and of others, as options name them. Used by the bus, the launcher and the space
// server.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace swarmanoid
{

struct BusOptions;

// Splits "10.77.0.1:21900" into address and port. Returns nullopt for anything else.
std::optional<std::pair<std::string, unsigned>> ParseServerAddress(const std::string& text);

// Returns the IPv4 address of a machine. Throws BusError if `host` is neither a known name nor an address.
std::string ResolveHost(const std::string& host);

// Returns the IPv4 addresses that a participant on the network interface may use; empty for all. An address that no
// interface has would make it deaf, so this throws BusError then.
std::vector<std::string> InterfaceAddresses(const std::string& network_interface);

// Returns the IPv4 address under which processes of other machines reach this one; "127.0.0.1" if the bus uses no
// network. Throws BusError.
std::string ReachableAddress(const BusOptions& options);

}  // namespace swarmanoid
