// Activity: which plug-in's code a process runs now, in which step and at which tick. The roles note it around every
// call of a plug-in. If the process fails, dies, hangs or is killed, the report names that code (failure_report.h). The
// process itself or, if a launcher gave it a page, the launcher writes the report. A process has one activity at a
// time.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

namespace swarmanoid
{

// A robot, device, engine, function or visualisation whose code a process runs. The roles and the launcher make actors
// from the experiment (common/experiment/actors.h). An actor refers to texts of the experiment.
struct Actor
{
  enum Kind : std::uint32_t
  {
    kNobody,
    kRobot,
    kFunctions,
    kEngine,
    kVisualisation,
    kSensor,
    kActuator,
    kWatcher  // the function of a user's program that observes each tick
  };
  Kind kind = kNobody;
  std::uint32_t number = 0;  // the number of the entity, or the position in the list of the experiment
  const char* id = "";       // the type, for a device
  const char* type = "";     // the id of the controller for robots and devices; otherwise the tag
};

enum class ActivityStep : std::uint32_t
{
  kNone,
  kLoad,
  kInit,
  kControlStep,
  kStatusText,
  kSaveState,
  kLoadState,
  kDestroy,
  kPreStep,
  kPostStep,
  kIsFinished,
  kUpdate,
  kDraw,
  kIdle,
  kFinish,
  kWatch,
  kInput
};

// Returns the name, such as "ControlStep". Several functions of an engine share the name that users know.
const char* NameOf(ActivityStep step);

// Returns "robot 'fb_3', controller 'diffusion': ControlStep at tick 17", or an empty text if no plug-in's code runs.
std::string ActivityText(const Actor& actor, ActivityStep step, std::uint64_t tick);
// Returns the text of this process's activity. Any thread may call it.
std::string CurrentActivity();

// While the object lives, this thread runs the code of `actor`. Objects nest.
class Activity
{
public:
  Activity(const Actor& actor, ActivityStep step, std::uint64_t tick);
  ~Activity();
  Activity(const Activity&) = delete;
  Activity& operator=(const Activity&) = delete;

  // Changes to another actor in the same step.
  void Next(const Actor& actor);

private:
  const Actor* outer_actor_;
  ActivityStep outer_step_;
  std::uint64_t outer_tick_;
};

// A process reports by these values why it ended, as far as it can.
enum class EndReason : std::uint32_t
{
  kUnknown,      // the process runs, or could not report
  kDone,         // its work is done
  kFailed,       // the process failed; the cause says how
  kDied,         // the code that ran crashed, ended the process, or did not return
  kInvalid,      // the experiment is wrong
  kOthers,       // the run ended without this process
  kInterrupted,  // a signal from outside ended the process
};

// The report of a process to the process that started it, in memory that both have mapped. Only the reporting process
// writes.
struct ActivityPage
{
  static constexpr std::uint64_t kMagic = 0x31796974'69766963;
  static constexpr std::size_t kCauseSize = 1024;

  std::atomic<std::uint64_t> magic;
  std::atomic<std::uint32_t> taken;   // 1: the process writes here
  std::atomic<std::uint64_t> tick;    // tick of the last activity
  std::atomic<std::uint32_t> kind;    // Actor::Kind
  std::atomic<std::uint32_t> number;  // Actor::number
  std::atomic<std::uint32_t> step;
  std::atomic<std::uint32_t> end;       // EndReason, written after the rest
  std::atomic<std::uint64_t> ended_ns;  // steady clock
  std::atomic<std::uint32_t> complete;  // 1: the cause already names the actor
  char cause[kCauseSize];
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free && std::atomic<const Actor*>::is_always_lock_free);

// Returns the page of this process: the one that descriptor SWARMANOID_ACTIVITY_FD of the environment names, or a
// private one.
ActivityPage& OwnActivityPage();
inline constexpr const char* kActivityVariable = "SWARMANOID_ACTIVITY_FD";

}  // namespace swarmanoid
