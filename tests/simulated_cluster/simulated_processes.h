// Simulation: processes that share one thread and a virtual clock, as in the simulators of FoundationDB and
// TigerBeetle. Their threads are fibers. A fiber runs until it waits; a seed decides which one runs next. The clock
// moves only when all wait. The same seed thus repeats every step of all processes.
//
// Invariants:
// * One fiber runs at a time, and switches only in Wait and Sleep. It holds no mutex there that another fiber needs.
// * Events run between two fibers, in the order of their times, then in the order in which they were made.
// * A killed process never runs its own code again, except for the destructors of what is on its stacks.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <queue>
#include <string>
#include <vector>

#include "common/threads/waiting.h"

namespace swarmanoid::test
{

using Duration = RunClock::duration;

// It makes random numbers by SplitMix64.
class SeededRandom
{
public:
  explicit SeededRandom(std::uint64_t seed) : state_(seed) {}

  std::uint64_t Next()
  {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111eb;
    return z ^ (z >> 31U);
  }
  // Returns a number from 0 to count - 1.
  std::uint64_t Below(std::uint64_t count) { return Next() % count; }
  bool Happens(double probability) { return static_cast<double>(Next() >> 11U) < probability * 0x1p53; }
  Duration Between(Duration least, Duration most)
  {
    return least + Duration(static_cast<Duration::rep>(
                       Below(static_cast<std::uint64_t>(std::max<Duration::rep>((most - least).count(), 1)))));
  }

private:
  std::uint64_t state_;
};

struct Fiber;

struct SimulatedProcess
{
  std::string name;
  std::string machine;
  long pid = 0;
  bool is_alive = true;
  bool ends_at_once = false;                // the process asked for its end: none of its fibers runs again
  bool has_left_bus = false;                // whether it said Leave
  std::optional<int> exit_code;             // nothing: it runs, or was killed
  RunTime stopped_until{};                  // until then it is stopped, as by SIGSTOP
  std::deque<std::function<void()>> calls;  // calls for the thread of its bus
  std::vector<std::unique_ptr<Fiber>> fibers;
};

class Simulation final : public SimulatedTime
{
public:
  explicit Simulation(std::uint64_t seed);
  ~Simulation() override;
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  // Returns the running process; the bus of the simulated processes needs it.
  static Simulation& Current();

  SimulatedProcess& Start(const std::string& name, const std::string& machine, std::function<int()> main);
  void Kill(SimulatedProcess& process);
  void Stop(SimulatedProcess& process, Duration time);
  // Calls the function between two fibers.
  void At(RunTime time, std::function<void()> call);
  void After(Duration time, std::function<void()> call) { At(now_ + time, std::move(call)); }
  // Calls the function in the thread of the process's bus.
  void Post(SimulatedProcess& process, std::function<void()> call);
  // Does one more step. Returns false if nothing can happen any more.
  bool Step();

  SimulatedProcess& CurrentProcess() const { return *running_process_; }
  // Ends the process of the fiber that runs, without another step of it.
  [[noreturn]] void EndProcess(int code);
  void Sleep(Duration time);
  SeededRandom& Random() { return random_; }
  std::uint64_t Steps() const { return steps_; }
  const std::vector<std::unique_ptr<SimulatedProcess>>& Processes() const { return processes_; }

  RunTime Now() override { return now_; }
  void Wait(const void* condition, std::unique_lock<std::mutex>& lock, RunTime until) override;
  void NotifyAll(const void* condition) override;
  int StartThread(std::function<void()> call) override;
  void Join(int thread) override;

  std::function<void(SimulatedProcess&)> on_end;  // called when a process has ended or was killed

private:
  struct Event
  {
    RunTime time;
    std::uint64_t number;
    std::function<void()> call;
    bool operator<(const Event& other) const { return time != other.time ? time > other.time : number > other.number; }
  };

  Fiber& AddFiber(SimulatedProcess& process, std::function<void()> call);
  void SwitchTo(Fiber& fiber);
  void SwitchToEvents();
  void Suspend(const void* condition, std::unique_lock<std::mutex>& lock, RunTime until);
  void ServeBus(SimulatedProcess& process);
  static void Enter();

  SeededRandom random_;
  RunTime now_{std::chrono::hours(1)};
  std::priority_queue<Event> events_;
  std::uint64_t events_made_ = 0;
  std::uint64_t steps_ = 0;
  std::vector<Fiber*> ready_;
  Fiber* running_ = nullptr;
  SimulatedProcess* running_process_ = nullptr;
  std::vector<std::unique_ptr<SimulatedProcess>> processes_;
  long next_pid_ = 1000;
};

}  // namespace swarmanoid::test
