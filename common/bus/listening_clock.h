// ListeningClock measures how long this process has been able to hear others. On an overloaded machine, or while the
// process is stopped, its threads do not run, and messages wait unread. That time says nothing about the others. A
// working process must not count as dead because of it.
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

  // A thread that measures a silence asks for the time once in this period. At most kMostBetween counts between two
  // questions. The thread did not run in the rest of the time.
  static constexpr Duration kPeriod = std::chrono::milliseconds(50);
  static constexpr Duration kMostBetween = 2 * kPeriod;

  // Returns the listening time at `now`. It never decreases.
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
