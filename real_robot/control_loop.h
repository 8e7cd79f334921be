// The control loop of a real robot: one step each period, on a monotonic clock. It stops the robot while a sensor is
// silent, and at the end, whatever the reason.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "real_robot/robot.h"

namespace swarmanoid
{

// A seam for tests: time in nanoseconds from any start.
struct LoopClock
{
  std::function<std::int64_t()> now;
  std::function<void(std::int64_t)> sleep_until;  // returns early on a signal
};
// Returns the clock CLOCK_MONOTONIC.
LoopClock MonotonicClock();

struct LoopOptions
{
  std::uint64_t steps = 0;      // 0: until told to stop
  double wait_s = 10;           // for the first value of each sensor; 0: unlimited
  bool end_on_silence = false;  // a silent sensor ends the loop
  std::function<bool()> told_to_stop;
};

struct LoopReport
{
  std::uint64_t steps = 0;
  double seconds = 0;          // from the first step to the end
  std::uint64_t overruns = 0;  // steps that took longer than the period
  double longest_step_s = 0;
  double silent_s = 0;  // time during which silent sensors stopped the robot
};

// Runs until it is told to stop, or for a number of steps. Throws RobotError and DriverError; the robot is stopped
// then, too.
LoopReport RunControlLoop(Robot& robot, const LoopOptions& options, const LoopClock& clock);

}  // namespace swarmanoid
