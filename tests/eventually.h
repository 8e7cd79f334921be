// Waits for other threads and processes: for a condition, never for a time.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace swarmanoid::test
{

// The events of tests come within milliseconds. This limit is for a machine with much other work.
inline constexpr std::chrono::seconds kGenerous{100};

// Returns whether the condition was met before the time was over.
inline bool Eventually(const std::function<bool()>& met, std::chrono::milliseconds patience = kGenerous)
{
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!met())
  {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace swarmanoid::test
