#include "common/threads/waiting.h"

#include <utility>

#include "common/threads/start_thread.h"

namespace swarmanoid
{
namespace
{

SimulatedTime* simulated_time = nullptr;

}  // namespace

void SimulateTime(SimulatedTime* time) { simulated_time = time; }

RunTime RunClock::now() { return simulated_time != nullptr ? simulated_time->Now() : std::chrono::steady_clock::now(); }

void RunCondition::notify_all()
{
  if (simulated_time != nullptr) return simulated_time->NotifyAll(this);
  condition_.notify_all();
}

void RunCondition::wait_until(std::unique_lock<std::mutex>& lock, RunTime until)
{
  if (simulated_time != nullptr) return simulated_time->Wait(this, lock, until);
  condition_.wait_until(lock, until);
}

RunThread::RunThread(const std::string& purpose, std::function<void()> call)
{
  if (simulated_time != nullptr)
    simulated_ = simulated_time->StartThread(std::move(call));
  else
    thread_ = StartThread(purpose, std::move(call));
}

RunThread& RunThread::operator=(RunThread&& other) noexcept
{
  thread_ = std::move(other.thread_);
  simulated_ = std::exchange(other.simulated_, -1);
  return *this;
}

void RunThread::join()
{
  if (thread_.joinable()) return thread_.join();
  simulated_time->Join(std::exchange(simulated_, -1));
}

}  // namespace swarmanoid
