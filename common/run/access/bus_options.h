// How a process takes part in the bus of a run. The bus, the launcher and the programs of the roles use these options.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/run/access/run_key.h"

namespace swarmanoid
{

class BusError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

inline constexpr int kDefaultDomain = 77;
// How long a run may stand still without an answer to a request, unless the user says otherwise. A process may need
// most of it to find the run, beside other work on the machine.
inline constexpr double kPatience_s = 15;

// A grant has a channel of its own, with its own key. It connects the space server to programs that observe or steer a
// run without being members (access_grant.h).
struct GrantChannel
{
  std::string id;
  std::optional<RunKey> key{};  // none: what is sent is not sealed, and nothing is received
};

struct BusOptions
{
  int domain = kDefaultDomain;  // 0 to 232; processes of different domains never hear each other
  // "lo" reaches this machine only. "all", or the name or IPv4 address of a network interface, reaches other machines
  // too.
  std::string network_interface = "lo";
  // Machines (names or IPv4 addresses) that take part, if the network has no multicast. Every process names all.
  std::vector<std::string> peers;
  // "address:port" of the space server that serves discovery, if the network has no multicast. Same in every
  // process.
  std::string discovery_server;
  bool serves_discovery = false;  // this process is that server
  double lease_s = 5;             // silence after which a process counts as dead
  // Largest datagram, larger messages are cut. Otherwise as large as possible on this machine, and one packet on a
  // network: of a larger one that is cut into packets all are lost with one.
  std::optional<int> datagram_bytes;
  // The key of the run comes from one of these: the key itself, a descriptor or a file. Without one, a space server
  // makes a new key. Other processes use the keys of this user's runs on this machine.
  std::optional<RunKey> key{};
  int key_fd = -1;
  std::string key_file{};
  // Otherwise this process meets only those of this machine that hear it, and not those that also only speak.
  // Controller hosts have nothing to say to each other, and each pair that meets costs a hundred datagrams.
  bool hears_announcements = true;
  bool insecure = false;  // no key: every process in the domain belongs to the run
  // All messages of this process that are not of a tick go this way.
  std::optional<GrantChannel> grant{};

  bool Spread() const { return network_interface != "lo"; }
  unsigned DatagramBytes() const { return static_cast<unsigned>(datagram_bytes.value_or(Spread() ? 1440 : 65500)); }
};

// Returns the key that the process was given, if any. Call it once, because a descriptor can be read only once. Throws
// BusError.
std::optional<RunKey> GivenKey(const BusOptions& options);

// Returns the user name of this process, or the user's number if it has no name.
std::string UserName();

}  // namespace swarmanoid
