// Activity: whose code a process runs now, in which step and at which tick. The roles say so around every call of a
// plug-in, so that a process that fails, dies, hangs or is killed can be told by what it did (failure_report.h), from
// within or, if a launcher gave it a page, from outside after its death. One activity at a time in a process.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

namespace swarmanoid
{

// Somebody whose code may run. Made by the roles and by the launcher from the experiment (common/experiment/actors.h),
// whose texts it shows.
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
    kWatcher  // of a program of a user: the function that looks at each tick
  };
  Kind kind = kNobody;
  std::uint32_t number = 0;  // of the entity, or in the list of the experiment
  const char* id = "";       // of a device: its type
  const char* type = "";     // the id of a robot's or device's controller; the tag of others
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

// "ControlStep"; of several functions of an engine, the one that users know.
const char* NameOf(ActivityStep step);

// "robot 'fb_3', controller 'diffusion': ControlStep at tick 17", or empty for nobody.
std::string ActivityText(const Actor& actor, ActivityStep step, std::uint64_t tick);
// Of this process, from any thread.
std::string CurrentActivity();

// While an object lives, this thread runs the code of `actor`. They nest.
class Activity
{
public:
  Activity(const Actor& actor, ActivityStep step, std::uint64_t tick);
  ~Activity();
  Activity(const Activity&) = delete;
  Activity& operator=(const Activity&) = delete;

  // Another one's turn in the same step.
  void Next(const Actor& actor);

private:
  const Actor* outer_actor_;
  ActivityStep outer_step_;
  std::uint64_t outer_tick_;
};

// How a process ended, as far as it could say.
enum class EndReason : std::uint32_t
{
  kUnknown,      // it runs, or could not say
  kDone,         // its work is done
  kFailed,       // by itself: the cause says how
  kDied,         // of what the code that ran did: it crashed, ended the process, or did not return
  kInvalid,      // it found the experiment wrong
  kOthers,       // since the run ended without it
  kInterrupted,  // by a signal from outside
};

// What a process tells whoever started it: memory that both have mapped. Only the process writes.
struct ActivityPage
{
  static constexpr std::uint64_t kMagic = 0x31796974'69766963;
  static constexpr std::size_t kCauseSize = 1024;

  std::atomic<std::uint64_t> magic;
  std::atomic<std::uint32_t> taken;   // 1: the process writes here
  std::atomic<std::uint64_t> tick;    // of the last activity
  std::atomic<std::uint32_t> kind;    // Actor::Kind
  std::atomic<std::uint32_t> number;  // Actor::number
  std::atomic<std::uint32_t> step;
  std::atomic<std::uint32_t> end;       // EndReason, written after the rest
  std::atomic<std::uint64_t> ended_ns;  // steady clock
  std::atomic<std::uint32_t> complete;  // 1: the cause says by itself whom it is about
  char cause[kCauseSize];
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free && std::atomic<const Actor*>::is_always_lock_free);

// The page of this process: the one that descriptor SWARMANOID_ACTIVITY_FD of the environment stands for, or one that
// nobody else sees.
ActivityPage& OwnActivityPage();
inline constexpr const char* kActivityVariable = "SWARMANOID_ACTIVITY_FD";

}  // namespace swarmanoid
