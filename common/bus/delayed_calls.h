// Calls functions of the bus after a delay, unless they are cancelled. It has its own thread, because a DDS thread must
// not wait or destroy the reader that called it. Delays are measured in listening time (ListeningClock), so a process
// that could not listen waits longer. Any thread may call it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "common/bus/listening_clock.h"

namespace swarmanoid
{

class DelayedCalls
{
public:
  using Clock = std::chrono::steady_clock;

  DelayedCalls() = default;
  ~DelayedCalls() { Stop(); }
  DelayedCalls(const DelayedCalls&) = delete;
  DelayedCalls& operator=(const DelayedCalls&) = delete;

  // Does nothing if a call of that name is already pending.
  void Schedule(const std::string& name, std::chrono::duration<double> delay, std::function<void()> call);
  // Cancels the call, unless it already runs.
  void Forget(const std::string& name);
  // Cancels the call, and waits for it if it already runs.
  void Cancel(const std::string& name);
  // Cancels all calls, and waits for the one that runs.
  void Stop();

private:
  struct Call
  {
    ListeningClock::Duration due{};
    std::function<void()> call;
  };

  void Work();

  // Guards the members below but thread_.
  std::mutex mutex_;
  std::condition_variable changed_;
  ListeningClock listening_;
  std::map<std::string, Call> calls_;
  std::string running_;
  bool stopped_ = false;
  std::thread thread_;  // from the first call on
};

}  // namespace swarmanoid
