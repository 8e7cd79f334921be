// ListeningClock: how long this process has been able to hear others. On a machine with far too much work, or while it
// is stopped, its threads do not run, and what others send waits unread. That time says nothing about the others: a
// process that works must not count as dead because of it.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

namespace swarmanoid
{

class ListeningClock
{
public:
  using Clock = std::chrono::steady_clock;
  using Duration = Clock::duration;

  // A thread that measures a silence asks for the time once in this period. Of the time between two questions at most
  // kMostBetween counts: the rest is time in which the thread did not run.
  static constexpr Duration kPeriod = std::chrono::milliseconds(50);
  static constexpr Duration kMostBetween = 2 * kPeriod;

  // The time of listening at `now`, which never decreases.
  Duration At(Clock::time_point now)
  {
    if (last_) listened_ += std::clamp(now - *last_, Duration::zero(), kMostBetween);
    last_ = std::max(now, last_.value_or(now));
    return listened_;
  }

private:
  Duration listened_ = Duration::zero();
  std::optional<Clock::time_point> last_;
};

}  // namespace swarmanoid
