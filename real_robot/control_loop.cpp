// A step of the controller is due once in each period of the monotonic clock. The times are multiples of the period
// from the start, so errors of single steps do not add up; steps that were missed are skipped, since several in a row
// would let the controller act on the same readings.
//
// Before the first step every sensor must have a value. Later a silent sensor stops the robot in the same period, and
// the controller pauses until the sensor is back: a robot that drives on old readings does damage. Whatever ends the
// loop, End() or an exception, the actuators are stopped.
#include "real_robot/control_loop.h"

#include <ctime>

#include <fmt/format.h>
#include <algorithm>

#include "common/logging/log.h"

namespace swarmanoid
{
namespace
{

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kBetweenWarnings = 10 * kSecond;

double Seconds(std::int64_t nanoseconds) { return static_cast<double>(nanoseconds) * 1e-9; }

// Warns of steps that are too long, at intervals rather than each time.
class OverrunWatch
{
public:
  OverrunWatch(std::int64_t period, LoopReport& report) : period_(period), report_(report) {}

  void Took(std::int64_t time, std::int64_t now)
  {
    report_.longest_step_s = std::max(report_.longest_step_s, Seconds(time));
    if (time <= period_) return;
    ++report_.overruns;
    if (warned_ && now - warned_at_ < kBetweenWarnings) return;
    warned_ = true;
    warned_at_ = now;
    LogWarning("step {} took {:.1f} ms of a period of {:.1f} ms; {} such steps so far", report_.steps,
               Seconds(time) * 1e3, Seconds(period_) * 1e3, report_.overruns);
  }

private:
  std::int64_t period_;
  LoopReport& report_;
  bool warned_ = false;
  std::int64_t warned_at_ = 0;
};

// Waits until every sensor has a value; returns false if it is told to stop.
bool WaitForSensors(Robot& robot, const LoopOptions& options, const LoopClock& clock, std::int64_t period)
{
  const std::int64_t start = clock.now();
  bool said = false;
  for (std::int64_t next = start;; next += period)
  {
    clock.sleep_until(next);
    if (options.told_to_stop()) return false;
    robot.Poll();
    const std::string missing = robot.NotHeard();
    if (missing.empty()) return true;
    const double waited = Seconds(clock.now() - start);
    if (options.wait_s > 0 && waited >= options.wait_s)
      throw DriverError(missing + "; is its publisher running, in the same domain, with this name and type?");
    if (!said && waited >= 1)
    {
      said = true;
      LogInfo("waiting: {}", missing);
    }
  }
}

}  // namespace

LoopClock MonotonicClock()
{
  return {[]
          {
            timespec time{};
            clock_gettime(CLOCK_MONOTONIC, &time);
            return time.tv_sec * kSecond + time.tv_nsec;
          },
          [](std::int64_t until)
          {
            const timespec time{until / kSecond, until % kSecond};
            clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr);
          }};
}

LoopReport RunControlLoop(Robot& robot, const LoopOptions& options, const LoopClock& clock)
{
  const std::int64_t period = std::int64_t{robot.Configuration().clock_tick_ms} * 1'000'000;
  LoopReport report;
  if (!WaitForSensors(robot, options, clock, period))
  {
    robot.End();
    return report;
  }
  robot.Start();
  LogInfo("running: a step each {} ms", robot.Configuration().clock_tick_ms);

  OverrunWatch overruns(period, report);
  const std::int64_t start = clock.now();
  bool silent = false;
  std::int64_t next = start;
  while (!options.told_to_stop() && (options.steps == 0 || report.steps < options.steps))
  {
    const std::int64_t begin = clock.now();
    robot.Poll();
    if (const std::string who = robot.Silent(); !who.empty())
    {
      robot.Stop();
      if (options.end_on_silence) throw DriverError(who + "; the robot is stopped");
      if (!silent) LogWarning("{}; the robot stands until it is back", who);
      silent = true;
      report.silent_s += Seconds(period);
    }
    else
    {
      if (silent) LogInfo("all sensors are back; the controller goes on with step {}", report.steps);
      silent = false;
      robot.Tick();
      ++report.steps;
    }
    const std::int64_t end = clock.now();
    overruns.Took(end - begin, end);

    // Missed steps are skipped, never run in a row.
    next += period;
    if (next < end) next += (end - next + period - 1) / period * period;
    clock.sleep_until(next);
  }
  report.seconds = Seconds(clock.now() - start);
  robot.End();
  return report;
}

}  // namespace swarmanoid
