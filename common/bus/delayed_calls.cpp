#include "common/bus/delayed_calls.h"

#include <algorithm>
#include <utility>

namespace swarmanoid
{

void DelayedCalls::Schedule(const std::string& name, std::chrono::duration<double> delay, std::function<void()> call)
{
  const std::lock_guard lock(mutex_);
  if (stopped_) return;
  calls_.try_emplace(name, Call{Clock::now() + std::chrono::duration_cast<Clock::duration>(delay), std::move(call)});
  if (!thread_.joinable()) thread_ = std::thread([this] { Work(); });
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
    if (Clock::now() < first->second.due)
    {
      // A copy: the entry may go meanwhile.
      const Clock::time_point due = first->second.due;
      changed_.wait_until(lock, due);
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
