// StepTimeout: notices that one step of somebody's code takes too long, says so, and ends the process if a limit is
// set. A thread of its own, since the one that runs the code does not come back.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "common/activity/activity.h"

namespace swarmanoid
{

class StepTimeout
{
public:
  struct Settings
  {
    // The longest that a step may take: 0 for no limit. Finish is not limited: films take their time.
    std::chrono::milliseconds limit{0};
    // Called when a step has taken a while, and now and then while it goes on: "<activity>", seconds.
    std::function<void(const std::string& activity, double seconds)> stalled;
    std::string cause = "--step-timeout";   // what set the limit
    ActivityStep of = ActivityStep::kNone;  // of such steps alone; kNone: of all
  };

  explicit StepTimeout(Settings settings);
  ~StepTimeout();
  StepTimeout(const StepTimeout&) = delete;
  StepTimeout& operator=(const StepTimeout&) = delete;

private:
  void Run();

  Settings settings_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool end_ = false;
  std::thread thread_;
};

}  // namespace swarmanoid
