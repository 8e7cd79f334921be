// StepTimeout: notices that one step of a plug-in takes too long, reports it, and ends the process if a limit is set.
// It has its own thread, since the thread that runs the code does not return.
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
    // The longest time that a step may take; 0: no limit. Finish has no limit, since films take long.
    std::chrono::milliseconds limit{0};
    // It is called with "<activity>" and seconds when a step has taken a while, and repeatedly while it continues.
    std::function<void(const std::string& activity, double seconds)> stalled;
    std::string cause = "--step-timeout";   // the option or parameter that set the limit
    ActivityStep of = ActivityStep::kNone;  // only steps of this kind are limited; kNone: all steps
  };

  explicit StepTimeout(Settings settings);
  ~StepTimeout();
  StepTimeout(const StepTimeout&) = delete;
  StepTimeout& operator=(const StepTimeout&) = delete;

private:
  void Run();

  Settings settings_;
  std::mutex mutex_;  // guards end_
  std::condition_variable ended_;
  bool end_ = false;
  std::thread thread_;
};

}  // namespace swarmanoid
