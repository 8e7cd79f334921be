// The bus: one DDS participant of this process, and typed publishers and subscriptions on it. Used by the four
// programs, the launcher and tests. No header of Fast DDS is needed to use it.
//
// Callbacks run in threads of the bus, at most one at a time for each subscription. Destroy publishers and
// subscriptions before their bus.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/bus/security/run_key.h"
#include "common/bus/topics/session_messages.h"

namespace swarmanoid
{

class BusError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// What came over the wire is not what a message of its kind may be. Thrown by whoever reads or takes a message; the bus
// drops the message and knows who sent it.
class BadMessage : public BusError
{
public:
  using BusError::BusError;
};

// A message that is not for this run, though a member once sent it. It is refused, and nobody fails for it.
class ForeignMessage : public BadMessage
{
public:
  using BadMessage::BadMessage;
};

struct BadMessageReport
{
  std::string topic;
  std::string process;     // "host:pid" of the sender, as it said when it joined; empty if it did not
  std::string name;        // likewise, "engine 'ground'"
  std::uint64_t tick = 0;  // of the message, if it has one
  std::string what;
  std::string sender{};  // for people: by its own word, or an unknown process
};

// True once a process died while it held a lock in shared memory: threads of the bus wait for it and cannot be ended.
bool BusIsBroken();
// Ends the program without waiting for threads of the bus. A failed run ends so: somebody may have died as above.
[[noreturn]] void EndAtOnce(int code);

inline constexpr int kDefaultDomain = 77;

// A way beside the topics of the members of a run, with a key of its own, between the space server and those who look
// at a run, or steer it, without being members (access_grant.h).
struct GrantChannel
{
  std::string id;
  std::optional<RunKey> key{};  // none: what is sent is not sealed, and nothing is received
};

struct BusOptions
{
  int domain = kDefaultDomain;  // 0 to 232; processes of different domains never hear each other
  // "lo": this machine only. "all", or the name or IPv4 address of a network interface: other machines too.
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
  // The key of the run, where it comes from: itself, a descriptor or a file that holds it. Otherwise, for a space
  // server, a new one; for others those of the runs of this user on this machine.
  std::optional<RunKey> key{};
  int key_fd = -1;
  std::string key_file{};
  bool insecure = false;  // no key: whoever is in the domain belongs to the run
  // All messages of this process that are not of a tick go this way.
  std::optional<GrantChannel> grant{};

  bool Spread() const { return network_interface != "lo"; }
  unsigned DatagramBytes() const { return static_cast<unsigned>(datagram_bytes.value_or(Spread() ? 1440 : 65500)); }
};

class Bus
{
public:
  // Throws BusError. `name`: as others report this process, "engine 'ground'".
  Bus(const BusOptions& options, const std::string& name);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  // Called when another process of the run has gone (without a word if `died`), with "host:pid" and its name. Anybody
  // can say in the name of a process that it goes: it is believed if that process is silent from then on.
  void OnProcessGone(std::function<void(const std::string& process, const std::string& name, bool died)> callback);

  // Called with each bad message. True: its sender belongs to the run, which ends for that. Otherwise the message is
  // dropped and counted, and the first of a sender on a topic is told on standard error.
  void OnBadMessage(std::function<bool(const BadMessageReport&)> callback);
  // Whether this process holds the key of the run of that experiment, or needs none.
  bool MaySpeakTo(const std::string& experiment);
  // Called once for each process and topic when a message was refused because it is not sealed by the key of the run,
  // or repeats one; with what is wrong with it.
  void OnRefused(std::function<void(const BadMessageReport&)> callback);
  // Bad messages that were dropped.
  std::uint64_t Dropped() const;

  struct Impl;
  Impl& Internals() { return *impl_; }

private:
  std::unique_ptr<Impl> impl_;
};

// The key that a process was given, if any. Not twice: what a descriptor gives is read. Throws BusError.
std::optional<RunKey> GivenKey(const BusOptions& options);

// The IPv4 address under which processes of other machines reach this one; "127.0.0.1" if the bus uses no network.
// Throws BusError.
std::string ReachableAddress(const BusOptions& options);

// "host:pid" of this process.
std::string ProcessId();
std::string MachineName();
// Whether a process of this machine is there.
bool IsAlive(long pid);
// Name of the user of this process, or the number where there is none.
std::string UserName();

// Where the messages of a tick travel.
struct HotScope
{
  std::string experiment;    // partition
  std::string directory;     // of this machine's shared memory for the run (run_directory.h)
  bool spread = false;       // WorldMessage::spread
  std::size_t capacity = 0;  // bytes of the largest message (TickLimits)
  unsigned writers = 1;      // of the topic
  std::string listener{};    // if it is for one process alone: its name
};

// Messages of a tick: SpaceState, LocalState, ControlCommands, EngineUpdate, SensorFrame, DrawnMessage, those of
// regions.
template <class Message>
class HotPublisher
{
public:
  HotPublisher(Bus& bus, const HotScope& scope);
  ~HotPublisher();

  // Copies the message to the readers. One thread at a time. Throws BusError.
  void Write(const MessageHeader& header, const Message& message);
  unsigned Readers() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

template <class Message>
class HotSubscription
{
public:
  struct Handler
  {
    // The place for a message that has arrived, or nullptr to drop it. The place is filled after the call, wholly only
    // if the message is received. May throw BadMessage.
    std::function<Message*(const MessageHeader&)> choose;
    // The message has been filled in.
    std::function<void(const MessageHeader&, Message&)> received;
    // Throws BadMessage if a message is not what the experiment makes of it; it is not received then. Optional.
    std::function<void(const MessageHeader&, const Message&)> check{};
  };

  HotSubscription(Bus& bus, const HotScope& scope, Handler handler);
  ~HotSubscription();

  unsigned Writers() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// All other messages. `partition`: the experiment's name; for subscriptions a pattern such as "*" is allowed. What is
// called with a message may throw BadMessage. `grant`: the channel that is used instead of that of the bus.
template <class Message>
class Publisher
{
public:
  Publisher(Bus& bus, const std::string& partition, const std::optional<GrantChannel>& grant = std::nullopt);
  ~Publisher();

  // Throws BadMessage if a name in the message cannot be sent, BusError if the bus does not take it, or if this process
  // has no key of the run.
  void Write(const Message& message);
  unsigned Readers() const;
  // False if not all readers confirmed in time.
  bool WaitUntilRead(double seconds);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

template <class Message>
class Subscription
{
public:
  Subscription(Bus& bus, const std::string& partition, std::function<void(const Message&)> received,
               const std::optional<GrantChannel>& grant = std::nullopt);
  ~Subscription();

  unsigned Writers() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swarmanoid
