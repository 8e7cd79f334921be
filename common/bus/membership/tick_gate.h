// TickGate: what a process still waits for before it can go on to the next tick. The parts are the messages of one
// tick, each expected once; late repetitions are recognised and a message that skips a tick is an error. Not
// thread-safe.
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
    kBefore,    // of the tick just done: somebody has not got our answer
    kDrop       // old, or here already
  };

  struct Part
  {
    std::string name;       // for errors: "state of the space server"
    bool may_lead = false;  // its sender does not wait for us: it may be one tick ahead
  };

  explicit TickGate(std::vector<Part> parts, std::uint64_t first_tick = 0);

  // Throws BadMessage for a tick that cannot follow.
  Verdict Offer(std::size_t part, std::uint64_t tick) const;
  // The expected message is in its place. True if nothing is missing for the current tick any more.
  bool Arrived(std::size_t part, std::uint64_t tick);
  bool Complete() const { return missing_ == 0; }
  // To the next tick.
  void Next();
  // The first tick is another one; nothing is here yet.
  void StartAt(std::uint64_t tick) { tick_ = tick; }
  // The messages of that name that are here have to come again, from whoever takes the place of their sender: those of
  // lower incarnations that are still on their way are not heard.
  void Withdraw(const std::string& name, std::uint32_t incarnation);
  // Whether a message is of a process that was replaced: one of its part with a higher incarnation was heard.
  bool IsReplaced(std::size_t part, std::uint32_t incarnation);

  std::uint64_t Tick() const { return tick_; }
  bool Has(std::size_t part) const { return here_[part] != 0; }
  bool MayLead(std::size_t part) const { return parts_[part].may_lead; }
  std::vector<std::string> Missing() const;

private:
  std::vector<Part> parts_;
  std::vector<char> here_;
  std::vector<char> ahead_;  // of the tick after
  std::vector<std::uint32_t> incarnations_;
  std::size_t missing_ = 0;
  std::uint64_t tick_ = 0;
};

// "a, b, c"
std::string Joined(const std::vector<std::string>& names);

}  // namespace swarmanoid
