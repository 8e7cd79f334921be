// The clock, threads and condition variables of the processes of a run. They are those of the machine. A simulated
// cluster (tests/simulated_cluster) replaces them: there all processes share one thread and a virtual clock.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace swarmanoid
{

using RunTime = std::chrono::steady_clock::time_point;

// Tests replace the time and the threads of a program by an object of this class.
class SimulatedTime
{
public:
  virtual ~SimulatedTime() = default;
  // Returns the present time.
  virtual RunTime Now() = 0;
  // Releases the lock and waits until the condition is notified or the time comes.
  virtual void Wait(const void* condition, std::unique_lock<std::mutex>& lock, RunTime until) = 0;
  // Wakes all threads that wait for the condition.
  virtual void NotifyAll(const void* condition) = 0;
  // Returns the number of the new thread.
  virtual int StartThread(std::function<void()> call) = 0;
  // Waits for the end of the thread.
  virtual void Join(int thread) = 0;
};

// Replaces the time source; nullptr restores the machine's. No other thread may run meanwhile.
void SimulateTime(SimulatedTime* time);

// It is a clock of the form that the standard library wants, with the time points of the steady clock.
struct RunClock
{
  using duration = std::chrono::steady_clock::duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = RunTime;
  static constexpr bool is_steady = true;
  static time_point now();
};

// Has the interface of std::condition_variable.
class RunCondition
{
public:
  void notify_all();
  void wait_until(std::unique_lock<std::mutex>& lock, RunTime until);

  template <class Predicate>
  bool wait_until(std::unique_lock<std::mutex>& lock, RunTime until, const Predicate& met)
  {
    while (!met())
    {
      if (RunClock::now() >= until) return false;
      wait_until(lock, until);
    }
    return true;
  }

  void wait_for(std::unique_lock<std::mutex>& lock, RunClock::duration time)
  {
    wait_until(lock, RunClock::now() + time);
  }

  template <class Predicate>
  bool wait_for(std::unique_lock<std::mutex>& lock, RunClock::duration time, const Predicate& met)
  {
    return wait_until(lock, RunClock::now() + time, met);
  }

  template <class Predicate>
  void wait(std::unique_lock<std::mutex>& lock, const Predicate& met)
  {
    while (!met()) wait_until(lock, RunClock::now() + std::chrono::hours(1));
  }

private:
  std::condition_variable condition_;
};

// Has the interface of std::thread.
class RunThread
{
public:
  RunThread() = default;
  // `purpose`: as for StartThread.
  RunThread(const std::string& purpose, std::function<void()> call);
  RunThread(RunThread&& other) noexcept { *this = std::move(other); }
  RunThread& operator=(RunThread&& other) noexcept;

  bool joinable() const { return thread_.joinable() || simulated_ >= 0; }
  void join();

private:
  std::thread thread_;
  int simulated_ = -1;
};

}  // namespace swarmanoid
