// TickWait measures how long the run has waited for one tick. It says when to send again what others may have lost, and
// when users must be told of the wait. One thread.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

namespace swarmanoid
{

class TickWait
{
public:
  using Clock = std::chrono::steady_clock;
  // The interval between repetitions doubles from the first value to the last one.
  static constexpr Clock::duration kFirstRepeat = std::chrono::milliseconds(100);
  static constexpr Clock::duration kLastRepeat = std::chrono::seconds(1);
  static constexpr Clock::duration kStall = std::chrono::seconds(2);
  static constexpr Clock::duration kBetweenReports = std::chrono::seconds(1);

  // The wait begins.
  void Begin(Clock::time_point now)
  {
    since_ = now;
    reported_ = {};
    Repeated(now);
  }
  // All messages were sent again for another reason.
  void Repeated(Clock::time_point now)
  {
    repeated_ = now;
    repeat_after_ = kFirstRepeat;
  }

  // Returns whether to send the messages again now.
  bool TakeRepeat(Clock::time_point now)
  {
    if (now - repeated_ < repeat_after_) return false;
    repeated_ = now;
    repeat_after_ = std::min(2 * repeat_after_, kLastRepeat);
    return true;
  }
  // Returns the length of the wait if it is to be reported now.
  std::optional<Clock::duration> TakeStall(Clock::time_point now)
  {
    const Clock::duration waited = Waited(now);
    if (waited < std::max(kStall, reported_ + kBetweenReports)) return std::nullopt;
    return reported_ = waited;
  }
  Clock::duration Waited(Clock::time_point now) const { return now - since_; }

private:
  Clock::time_point since_;
  Clock::time_point repeated_;
  Clock::duration repeat_after_ = kFirstRepeat;
  Clock::duration reported_{};  // the wait that the last report told
};

}  // namespace swarmanoid
