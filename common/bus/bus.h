// The bus: one DDS participant of this process, and typed publishers and subscriptions on it. The four
// programs, the launcher and tests use it. No header of Fast DDS is needed to use it.
//
// Callbacks run in threads of the bus, at most one at a time for each subscription. Destroy publishers and
// subscriptions before their bus.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/run/access/bus_options.h"
#include "idl/messages.h"

namespace swarmanoid
{

struct MessageHeader;

// A message from the wire is invalid for its kind. Code that reads or takes a message throws this. The bus drops the
// message and records its sender.
class BadMessage : public BusError
{
public:
  using BusError::BusError;
};

// The message belongs to another run, although a member sent it once. It is refused, and no process fails because of
// it.
class ForeignMessage : public BadMessage
{
public:
  using BadMessage::BadMessage;
};

struct BadMessageReport
{
  std::string topic;
  std::string process;     // "host:pid" of the sender, as it said when it joined; empty if it did not
  std::string name;        // the sender's name in the run, "engine 'ground'"
  std::uint64_t tick = 0;  // the message's tick, if it has one
  std::string what;
  std::string sender{};  // for people: the name that the sender gave, or an unknown process
};

// Returns true once a process died while it held a lock in shared memory: threads of the bus wait for it and cannot be
// ended.
bool BusIsBroken();
// Ends the program without waiting for threads of the bus. A failed run ends so, because a process may have died with a
// lock.
[[noreturn]] void EndAtOnce(int code);

class Bus
{
public:
  // Throws BusError. `name`: as others report this process, "engine 'ground'". `experiment`: the one to join, if known.
  // If its run is this user's and on this machine, its key signs all datagrams; otherwise those from the first message
  // on.
  Bus(const BusOptions& options, const std::string& name, const std::string& experiment = {});
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  // The bus calls `callback` with "host:pid" and the name when another process of the run has gone (without a Leave if
  // `died`). Any process can forge a Leave. So the bus believes it only if the named process is silent afterwards.
  void OnProcessGone(std::function<void(const std::string& process, const std::string& name, bool died)> callback);

  // The bus calls `callback` with each bad message. It must return true if the sender belongs to the run, which then
  // ends because of it. Otherwise the bus drops and counts the message. It reports the first one of a sender on a topic
  // on standard error.
  void OnBadMessage(std::function<bool(const BadMessageReport&)> callback);
  // Returns whether this process holds the key of the run of that experiment, or needs none.
  bool MaySpeakTo(const std::string& experiment);
  // The bus calls `callback` once for each process and topic when it refuses a message that is not sealed by the key of
  // the run, or repeats one. The report tells what is wrong.
  void OnRefused(std::function<void(const BadMessageReport&)> callback);
  // Returns the number of bad messages that were dropped.
  std::uint64_t Dropped() const;
  // Returns the time since another process joined the domain, whether it belongs to the run or not.
  std::chrono::duration<double> SinceLastJoin() const;

  struct Impl;
  Impl& Internals() { return *impl_; }

private:
  std::unique_ptr<Impl> impl_;
};

// Returns "host:pid" of this process.
std::string ProcessId();
std::string MachineName();
// Returns whether a process of this machine exists.
bool IsAlive(long pid);

// Says where the messages of a tick travel.
struct HotScope
{
  std::string experiment;    // partition
  std::string directory;     // folder of this machine's shared memory for the run (run_directory.h)
  bool spread = false;       // WorldMessage::spread
  std::size_t capacity = 0;  // bytes of the largest message (TickLimits)
  unsigned writers = 1;      // number of the topic's writers
  std::string listener{};    // name of the receiver, if the topic has only one
};

// Messages of a tick: SpaceState, LocalState, ControlCommands, EngineUpdate, SensorFrame, DrawnMessage, those of
// regions.
template <class Message>
class HotPublisher
{
public:
  HotPublisher(Bus& bus, const HotScope& scope);
  ~HotPublisher();

  // Copies the message to the readers. One thread at a time may use it. Throws BusError.
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
    // Returns the memory for a message that has arrived, or nullptr to drop it. The message is written after the call;
    // it is complete only if it is received. May throw BadMessage.
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

// Sends and receives all other messages. `partition`: the experiment's name; for subscriptions a pattern such as "*" is
// allowed. What is called with a message may throw BadMessage. `grant`: the channel that is used instead of that of the
// bus.
template <class Message>
class Publisher
{
public:
  Publisher(Bus& bus, const std::string& partition, const std::optional<GrantChannel>& grant = std::nullopt);
  ~Publisher();

  // Throws BadMessage if a name in the message cannot be sent. Throws BusError if the bus does not take it, or if this
  // process has no key of the run.
  void Write(const Message& message);
  // Readers that come from now on get no earlier message, of a topic whose last one is kept for them.
  void Forget();
  unsigned Readers() const;
  // Returns false if not all readers confirmed in time.
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
