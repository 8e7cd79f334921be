// PaceMeter: measures the speed of a run over about the last second. One thread uses it.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

namespace swarmanoid
{

class PaceMeter
{
public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kPeriod{100};

  explicit PaceMeter(double tick_seconds) : tick_seconds_(tick_seconds) {}

  // Takes the tick of the run. Returns true if there is a new measurement of the pace.
  bool Observe(std::uint64_t tick, Clock::time_point now)
  {
    if (!measuring_) Rest(tick, now);
    measuring_ = true;
    if (now - since_ < kPeriod || tick == tick_) return false;
    const double seconds = std::chrono::duration<double>(now - since_).count();
    const double rate = static_cast<double>(tick - tick_) / seconds;
    const double weight = ticks_per_second_ == 0 ? 1 : 1 - std::exp(-seconds);
    ticks_per_second_ += weight * (rate - ticks_per_second_);
    tick_ = tick;
    since_ = now;
    return true;
  }
  // The run is paused at `tick`: the time until it continues does not count.
  void Rest(std::uint64_t tick, Clock::time_point now)
  {
    measuring_ = false;
    tick_ = tick;
    since_ = now;
  }

  double TicksPerSecond() const { return ticks_per_second_; }
  double RealTimeFactor() const { return ticks_per_second_ * tick_seconds_; }

private:
  double tick_seconds_;
  bool measuring_ = false;
  std::uint64_t tick_ = 0;
  Clock::time_point since_;
  double ticks_per_second_ = 0;
};

}  // namespace swarmanoid
