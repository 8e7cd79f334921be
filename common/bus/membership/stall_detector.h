// StallDetector notices that a process has been in one state for too long. One thread polls it.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace swarmanoid
{

class StallDetector
{
public:
  using Clock = std::chrono::steady_clock;

  // `state`: what the process waits for or does at `tick`; empty if it is not worth reporting. Returns the state once
  // it has been the same for a second.
  std::optional<std::string> Observe(std::uint64_t tick, const std::string& state, Clock::time_point now)
  {
    if (!since_ || tick != tick_ || state != state_)
    {
      tick_ = tick;
      state_ = state;
      since_ = now;
    }
    if (state.empty() || now - *since_ < std::chrono::seconds(1)) return std::nullopt;
    return state;
  }

private:
  std::uint64_t tick_ = 0;
  std::string state_;
  std::optional<Clock::time_point> since_;
};

}  // namespace swarmanoid
