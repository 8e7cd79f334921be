#include "common/limits/step_timeout.h"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>

#include "common/activity/current_activity.h"
#include "common/activity/failure_report.h"
#include "common/threads/start_thread.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kPeriod = 500ms;
constexpr auto kFirstWord = 2s;

bool Same(const activity::Current& a, const activity::Current& b)
{
  return a.actor == b.actor && a.step == b.step && a.tick == b.tick;
}

// The thread blocks all signals, so that other threads handle them.
std::thread StartQuietly(const std::function<void()>& run)
{
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread thread = StartThread("watches how long steps take", run);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

}  // namespace

StepTimeout::StepTimeout(Settings settings) : settings_(std::move(settings)), thread_(StartQuietly([this] { Run(); }))
{
}

StepTimeout::~StepTimeout()
{
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  ended_.notify_all();
  thread_.join();
}

void StepTimeout::Run()
{
  const auto limit = settings_.limit;
  const auto period = limit > 0ms ? std::clamp<std::chrono::milliseconds>(limit / 10, 5ms, kPeriod)
                                  : std::chrono::milliseconds(kPeriod);
  activity::Current last;
  Clock::time_point since = Clock::now();
  Clock::time_point looked = since;
  Clock::duration next_word = kFirstWord;
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, period, [this] { return end_; }))
  {
    const activity::Current now = activity::Now();
    const Clock::time_point time = Clock::now();
    // The time in which this process itself was stopped does not count.
    since += std::max<Clock::duration>(time - looked - 4 * period, 0ms);
    looked = time;
    const bool limited =
        settings_.of == ActivityStep::kNone ? now.step != ActivityStep::kFinish : now.step == settings_.of;
    if (now.actor == nullptr || !limited || !Same(now, last))
    {
      last = now;
      since = time;
      next_word = kFirstWord;
      continue;
    }
    if (limit > 0ms && time - since >= limit)
      DieOfStep(fmt::format("did not return within {} s ({})", std::chrono::duration<double>(limit).count(),
                            settings_.cause));
    if (time - since < next_word) continue;
    if (settings_.stalled) settings_.stalled(CurrentActivity(), std::chrono::duration<double>(time - since).count());
    next_word *= 2;
  }
}

}  // namespace swarmanoid
