// TickGate knows what a process still waits for before the next tick. The parts are the messages of one tick, each
// expected once. It recognises late repetitions. A message that skips a tick is an error. One thread at a time may use
// it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace swarmanoid
{

class TickGate
{
public:
  enum class Verdict
  {
    kExpected,  // take it
    kBefore,    // the message of the previous tick: the sender lacks our answer
    kDrop       // old, or here already
  };

  struct Part
  {
    std::string name;       // for errors: "state of the space server"
    bool may_lead = false;  // its sender does not wait for us, so it may be one tick ahead
  };

  explicit TickGate(std::vector<Part> parts, std::uint64_t first_tick = 0);

  // Says what to do with a message. Throws BadMessage for a tick that cannot follow.
  Verdict Offer(std::size_t part, std::uint64_t tick) const;
  // The expected message has arrived. Returns true if the current tick is complete.
  bool Arrived(std::size_t part, std::uint64_t tick);
  bool Complete() const { return missing_ == 0; }
  // Advances to the next tick.
  void Next();
  // Sets another first tick, before any message has arrived.
  void StartAt(std::uint64_t tick) { tick_ = tick; }
  // Discards the messages of that name that have arrived, because the sender's replacement sends them again. Messages
  // of lower incarnations that are still on their way are ignored.
  void Withdraw(const std::string& name, std::uint32_t incarnation);
  // Returns whether a message comes from a replaced process: its part has sent a higher incarnation.
  bool IsReplaced(std::size_t part, std::uint32_t incarnation);

  std::uint64_t Tick() const { return tick_; }
  bool Has(std::size_t part) const { return here_[part] != 0; }
  bool MayLead(std::size_t part) const { return parts_[part].may_lead; }
  std::vector<std::string> Missing() const;

private:
  std::vector<Part> parts_;
  std::vector<char> here_;
  std::vector<char> ahead_;  // whether the message of the next tick is here
  std::vector<std::uint32_t> incarnations_;
  std::size_t missing_ = 0;
  std::uint64_t tick_ = 0;
};

// Returns the names with commas: "a, b, c". Of many names it counts the last ones: "a, b, c, d, e, f and 58 others".
std::string Joined(const std::vector<std::string>& names);

}  // namespace swarmanoid
