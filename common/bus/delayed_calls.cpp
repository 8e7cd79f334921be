#include "common/bus/delayed_calls.h"
#include "common/threads/start_thread.h"

#include <algorithm>
#include <utility>

namespace swarmanoid
{

void DelayedCalls::Schedule(const std::string& name, std::chrono::duration<double> delay, std::function<void()> call)
{
  const std::lock_guard lock(mutex_);
  if (stopped_) return;
  calls_.try_emplace(
      name, Call{listening_.At(Clock::now()) + std::chrono::duration_cast<Clock::duration>(delay), std::move(call)});
  if (!thread_.joinable()) thread_ = StartThread("does delayed work of the bus", [this] { Work(); });
  changed_.notify_all();
}

void DelayedCalls::Forget(const std::string& name)
{
  const std::lock_guard lock(mutex_);
  calls_.erase(name);
}

void DelayedCalls::Cancel(const std::string& name)
{
  std::unique_lock lock(mutex_);
  calls_.erase(name);
  changed_.wait(lock, [&] { return running_ != name; });
}

void DelayedCalls::Stop()
{
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    calls_.clear();
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

void DelayedCalls::Work()
{
  std::unique_lock lock(mutex_);
  while (!stopped_)
  {
    const auto first = std::min_element(calls_.begin(), calls_.end(),
                                        [](const auto& a, const auto& b) { return a.second.due < b.second.due; });
    if (first == calls_.end())
    {
      changed_.wait(lock);
      continue;
    }
    const ListeningClock::Duration left = first->second.due - listening_.At(Clock::now());
    if (left > ListeningClock::Duration::zero())
    {
      changed_.wait_for(lock, std::min(left, ListeningClock::kPeriod));
      continue;
    }
    const std::function<void()> call = std::move(first->second.call);
    running_ = first->first;
    calls_.erase(first);
    lock.unlock();
    call();
    lock.lock();
    running_.clear();
    changed_.notify_all();
  }
}

}  // namespace swarmanoid
