#include "tests/simulated_cluster/simulated_processes.h"

#include <cxxabi.h>
#include <sys/mman.h>
#include <ucontext.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <utility>

namespace swarmanoid::test
{
namespace
{

constexpr std::size_t kStackBytes = 512 * 1024;

// Unwinds the stack of a fiber whose process was killed. It is no std::exception, so that no code takes it for a
// failure of its own.
struct Killed
{
};

// The data that the C++ runtime keeps for each thread, and here for each fiber: the exceptions that are being handled.
struct HandledExceptions
{
  void* caught = nullptr;
  unsigned uncaught = 0;
};

void Exchange(HandledExceptions& out, const HandledExceptions& in)
{
  auto* const globals = reinterpret_cast<HandledExceptions*>(abi::__cxa_get_globals());
  out = *globals;
  *globals = in;
}

// Stacks are reused, because mapping one takes as long as a whole small run.
std::vector<void*>& FreeStacks()
{
  static std::vector<void*> stacks;
  return stacks;
}

Simulation* current_simulation = nullptr;

}  // namespace

struct Fiber
{
  enum class State
  {
    kReady,
    kWaiting,
    kEnded
  };

  SimulatedProcess* process = nullptr;
  std::function<void()> call;
  State state = State::kReady;
  bool has_started = false;
  bool is_killed = false;
  const void* condition = nullptr;
  std::uint64_t waits = 0;  // tells an old time-out from that of the present wait
  HandledExceptions handled;
  ucontext_t context{};
  ucontext_t back{};
  void* stack = nullptr;
};

Simulation::Simulation(std::uint64_t seed) : random_(seed)
{
  current_simulation = this;
  SimulateTime(this);
}

Simulation::~Simulation()
{
  for (const auto& process : processes_)
    if (process->is_alive) Kill(*process);
  SimulateTime(nullptr);
  current_simulation = nullptr;
}

Simulation& Simulation::Current() { return *current_simulation; }

SimulatedProcess& Simulation::Start(const std::string& name, const std::string& machine, std::function<int()> main)
{
  processes_.push_back(std::make_unique<SimulatedProcess>());
  SimulatedProcess& process = *processes_.back();
  process.name = name;
  process.machine = machine;
  process.pid = next_pid_++;
  AddFiber(process,
           [this, &process, main = std::move(main)]
           {
             process.exit_code = main();
             process.ends_at_once = true;
           });
  AddFiber(process, [this, &process] { ServeBus(process); });
  return process;
}

Fiber& Simulation::AddFiber(SimulatedProcess& process, std::function<void()> call)
{
  process.fibers.push_back(std::make_unique<Fiber>());
  Fiber& fiber = *process.fibers.back();
  fiber.process = &process;
  fiber.call = std::move(call);
  if (FreeStacks().empty())
    fiber.stack = mmap(nullptr, kStackBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK, -1, 0);
  else
  {
    fiber.stack = FreeStacks().back();
    FreeStacks().pop_back();
  }
  getcontext(&fiber.context);
  fiber.context.uc_stack.ss_sp = fiber.stack;
  fiber.context.uc_stack.ss_size = kStackBytes;
  fiber.context.uc_link = nullptr;
  makecontext(&fiber.context, &Simulation::Enter, 0);
  ready_.push_back(&fiber);
  return fiber;
}

void Simulation::Enter()
{
  Fiber& fiber = *current_simulation->running_;
  try
  {
    if (!fiber.is_killed) fiber.call();
  }
  catch (const Killed&)
  {
  }
  fiber.state = Fiber::State::kEnded;
  current_simulation->SwitchToEvents();
  std::abort();  // nothing switches to a fiber that has ended
}

void Simulation::SwitchTo(Fiber& fiber)
{
  running_ = &fiber;
  running_process_ = fiber.process;
  fiber.has_started = true;
  HandledExceptions own;
  Exchange(own, fiber.handled);
  swapcontext(&fiber.back, &fiber.context);
  Exchange(fiber.handled, own);
  running_ = nullptr;
  running_process_ = nullptr;
  if (fiber.state != Fiber::State::kEnded || fiber.stack == nullptr) return;
  FreeStacks().push_back(std::exchange(fiber.stack, nullptr));
  fiber.call = nullptr;
  NotifyAll(&fiber);
}

void Simulation::SwitchToEvents()
{
  Fiber& fiber = *running_;
  swapcontext(&fiber.context, &fiber.back);
}

void Simulation::Wait(const void* condition, std::unique_lock<std::mutex>& lock, RunTime until)
{
  if (running_->is_killed) throw Killed();
  Suspend(condition, lock, until);
  if (running_->is_killed) throw Killed();
}

void Simulation::Suspend(const void* condition, std::unique_lock<std::mutex>& lock, RunTime until)
{
  Fiber& fiber = *running_;
  lock.unlock();
  fiber.condition = condition;
  fiber.state = Fiber::State::kWaiting;
  const std::uint64_t wait = ++fiber.waits;
  if (until < now_ + std::chrono::hours(1))
    At(until,
       [this, &fiber, wait]
       {
         if (fiber.state != Fiber::State::kWaiting || fiber.waits != wait) return;
         fiber.state = Fiber::State::kReady;
         ready_.push_back(&fiber);
       });
  SwitchToEvents();
  if (lock.try_lock()) return;
  std::fputs("a fiber waits while it holds a mutex that another one needs\n", stderr);
  std::abort();
}

void Simulation::NotifyAll(const void* condition)
{
  for (const auto& process : processes_)
    for (const auto& fiber : process->fibers)
      if (fiber->state == Fiber::State::kWaiting && fiber->condition == condition)
      {
        fiber->state = Fiber::State::kReady;
        ready_.push_back(fiber.get());
      }
}

void Simulation::Sleep(Duration time)
{
  std::mutex own;
  std::unique_lock lock(own);
  Wait(&own, lock, now_ + time);
}

int Simulation::StartThread(std::function<void()> call)
{
  SimulatedProcess& process = *running_process_;
  AddFiber(process, std::move(call));
  return static_cast<int>(process.fibers.size()) - 1;
}

void Simulation::Join(int thread)
{
  Fiber& fiber = *running_process_->fibers[static_cast<std::size_t>(thread)];
  std::mutex own;
  std::unique_lock lock(own);
  // This also runs within destructors, which must not throw. The threads of a process are killed before the main one.
  while (fiber.state != Fiber::State::kEnded) Suspend(&fiber, lock, now_ + std::chrono::hours(1));
}

void Simulation::ServeBus(SimulatedProcess& process)
{
  std::mutex own;
  std::unique_lock lock(own);
  while (true)
  {
    while (process.calls.empty()) Wait(&process.calls, lock, now_ + std::chrono::hours(1));
    const auto call = std::move(process.calls.front());
    process.calls.pop_front();
    call();
  }
}

void Simulation::Post(SimulatedProcess& process, std::function<void()> call)
{
  if (!process.is_alive) return;
  process.calls.push_back(std::move(call));
  NotifyAll(&process.calls);
}

void Simulation::EndProcess(int code)
{
  running_process_->exit_code = code;
  running_process_->ends_at_once = true;
  running_->state = Fiber::State::kWaiting;
  running_->condition = nullptr;
  ++running_->waits;
  SwitchToEvents();
  throw Killed();
}

void Simulation::Kill(SimulatedProcess& process)
{
  if (!process.is_alive) return;
  process.is_alive = false;
  process.calls.clear();
  std::erase_if(ready_, [&](const Fiber* fiber) { return fiber->process == &process; });
  for (const auto& fiber : process.fibers) fiber->is_killed = true;
  // The main fiber is last, because it waits for the others.
  for (std::size_t k = process.fibers.size(); k-- > 0;)
  {
    Fiber& fiber = *process.fibers[k];
    // A wait within a destructor ends at once, and leaves the fiber where it is.
    while (fiber.state != Fiber::State::kEnded) SwitchTo(fiber);
  }
  std::erase_if(ready_, [&](const Fiber* fiber) { return fiber->process == &process; });
  if (on_end) on_end(process);
}

void Simulation::Stop(SimulatedProcess& process, Duration time)
{
  process.stopped_until = std::max(process.stopped_until, now_ + time);
  After(time, [] {});
}

void Simulation::At(RunTime time, std::function<void()> call)
{
  events_.push({std::max(time, now_), events_made_++, std::move(call)});
}

bool Simulation::Step()
{
  ++steps_;
  const auto can_run = [this](const Fiber* fiber) { return fiber->process->stopped_until <= now_; };
  const auto runnable = static_cast<std::size_t>(std::count_if(ready_.begin(), ready_.end(), can_run));
  if (runnable == 0)
  {
    if (events_.empty()) return false;
    Event event = std::move(const_cast<Event&>(events_.top()));
    events_.pop();
    now_ = event.time;
    event.call();
    return true;
  }
  std::size_t chosen = runnable == 1 ? 0 : random_.Below(runnable);
  auto at = std::find_if(ready_.begin(), ready_.end(), can_run);
  for (; chosen > 0; --chosen) at = std::find_if(std::next(at), ready_.end(), can_run);
  Fiber& fiber = **at;
  ready_.erase(at);
  SimulatedProcess& process = *fiber.process;
  SwitchTo(fiber);
  if (process.ends_at_once) Kill(process);
  return true;
}

}  // namespace swarmanoid::test
