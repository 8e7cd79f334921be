// What the bus does a little later, unless it is not needed any more: in a thread of its own, as no thread of DDS may
// wait, or take apart what it runs in. Delays are times of listening (ListeningClock): a process that could not hear
// waits longer. From any thread.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "common/bus/membership/listening_clock.h"

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

  // Nothing if there is one of that name already.
  void Schedule(const std::string& name, std::chrono::duration<double> delay, std::function<void()> call);
  // It is not called, unless it is being called already.
  void Forget(const std::string& name);
  // It is not called any more, nor is it being called.
  void Cancel(const std::string& name);
  // Likewise for all.
  void Stop();

private:
  struct Call
  {
    ListeningClock::Duration due{};
    std::function<void()> call;
  };

  void Work();

  std::mutex mutex_;
  std::condition_variable changed_;
  ListeningClock listening_;
  std::map<std::string, Call> calls_;
  std::string running_;
  bool stopped_ = false;
  std::thread thread_;  // from the first call on
};

}  // namespace swarmanoid
