#include "common/activity/activity.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <new>

#include "common/activity/current_activity.h"
#include "common/activity/shared_activity.h"
#include "common/activity/signal_stack.h"

namespace swarmanoid
{
namespace
{

constexpr std::array kSteps{"",          "loading", "Init",    "ControlStep", "StatusText", "SaveState",
                            "LoadState", "Destroy", "PreStep", "PostStep",    "IsFinished", "Update",
                            "Draw",      "Idle",    "Finish",  "Watch",       "Input"};

std::atomic<const Actor*> current_actor = nullptr;
std::atomic<ActivityStep> current_step = ActivityStep::kNone;
std::atomic<std::uint64_t> current_tick = 0;
// The depth is set before any handler can read it, and never changes in a handler.
__attribute__((tls_model("initial-exec"))) thread_local int depth = 0;

// The actor whose code each thread of a shared step runs, on a cache line of its own.
struct alignas(64) ActorOfThread
{
  std::atomic<const Actor*> actor = nullptr;
};
std::array<ActorOfThread, SharedActivity::kMostThreads> sharing;
__attribute__((tls_model("initial-exec"))) thread_local const std::atomic<const Actor*>* own_place = nullptr;

const Actor* SharingActor()
{
  if (own_place != nullptr) return own_place->load(std::memory_order_acquire);
  for (const ActorOfThread& thread : sharing)
    if (const Actor* actor = thread.actor.load(std::memory_order_acquire)) return actor;
  return nullptr;
}

// The variable is trusted only if the launcher set it for this process, since a descriptor of that number may be any
// file.
ActivityPage* PageOfLauncher()
{
  const char* text = std::getenv(kActivityVariable);
  if (text == nullptr) return nullptr;
  const int descriptor = std::atoi(text);
  // Processes that this process starts get no page.
  unsetenv(kActivityVariable);
  struct stat status
  {
  };
  if (descriptor < 3 || fstat(descriptor, &status) != 0 || status.st_size != static_cast<off_t>(sizeof(ActivityPage)))
    return nullptr;
  void* memory = mmap(nullptr, sizeof(ActivityPage), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  if (memory == MAP_FAILED) return nullptr;
  auto* page = static_cast<ActivityPage*>(memory);
  if (page->magic != ActivityPage::kMagic)
  {
    munmap(memory, sizeof(ActivityPage));
    return nullptr;
  }
  close(descriptor);
  page->taken = 1;
  return page;
}

void Publish(const Actor* actor)
{
  // The release order lets a reader of the pointer also see the object that it points to.
  current_actor.store(actor, std::memory_order_release);
  ActivityPage& page = OwnActivityPage();
  page.number.store(actor == nullptr ? 0 : actor->number, std::memory_order_relaxed);
}

void Publish(const Actor* actor, ActivityStep step, std::uint64_t tick)
{
  current_step.store(step, std::memory_order_relaxed);
  current_tick.store(tick, std::memory_order_relaxed);
  ActivityPage& page = OwnActivityPage();
  page.kind.store(actor == nullptr ? Actor::kNobody : actor->kind, std::memory_order_relaxed);
  page.step.store(static_cast<std::uint32_t>(step), std::memory_order_relaxed);
  if (actor != nullptr) page.tick.store(tick, std::memory_order_relaxed);
  Publish(actor);
}

}  // namespace

const char* NameOf(ActivityStep step) { return kSteps[static_cast<std::size_t>(step)]; }

ActivityPage& OwnActivityPage()
{
  static ActivityPage own{};
  static ActivityPage* const page = []
  {
    ActivityPage* of_launcher = PageOfLauncher();
    return of_launcher == nullptr ? &own : of_launcher;
  }();
  return *page;
}

Activity::Activity(const Actor& actor, ActivityStep step, std::uint64_t tick)
    : outer_actor_(current_actor.load(std::memory_order_relaxed)),
      outer_step_(current_step.load(std::memory_order_relaxed)),
      outer_tick_(current_tick.load(std::memory_order_relaxed))
{
  EnsureSignalStack();
  ++depth;
  Publish(&actor, step, tick);
}

Activity::~Activity()
{
  Publish(outer_actor_, outer_step_, outer_tick_);
  --depth;
}

void Activity::Next(const Actor& actor) { Publish(&actor); }

SharedActivity::SharedActivity(ActivityStep step, std::uint64_t tick)
    : outer_actor_(current_actor.load(std::memory_order_relaxed)),
      outer_step_(current_step.load(std::memory_order_relaxed)),
      outer_tick_(current_tick.load(std::memory_order_relaxed))
{
  Publish(nullptr, step, tick);
  OwnActivityPage().tick.store(tick, std::memory_order_relaxed);
}

SharedActivity::~SharedActivity() { Publish(outer_actor_, outer_step_, outer_tick_); }

SharedActivity::Thread::Thread(unsigned number) : place_(&sharing[number].actor)
{
  EnsureSignalStack();
  own_place = place_;
  ++depth;
}

SharedActivity::Thread::~Thread()
{
  --depth;
  own_place = nullptr;
  place_->store(nullptr, std::memory_order_relaxed);
}

namespace activity
{

Current Now()
{
  const Actor* actor = current_actor.load(std::memory_order_acquire);
  return {actor != nullptr ? actor : SharingActor(), current_step.load(std::memory_order_relaxed),
          current_tick.load(std::memory_order_relaxed)};
}

bool IsMine() { return depth > 0; }

void Write(LineWriter& line, const Actor& actor, ActivityStep step, std::uint64_t tick)
{
  constexpr std::array kKinds{"",
                              "robot '",
                              "experiment functions '",
                              "engine '",
                              "visualisation '",
                              "sensor '",
                              "actuator '",
                              "the function that looks at each tick"};
  line.Add(kKinds[actor.kind]).Add(actor.id);
  if (actor.kind == Actor::kRobot)
    line.Add("', controller '").Add(actor.type).Add("': ");
  else if (actor.kind == Actor::kWatcher)
    line.Add(": ");
  else if (actor.kind == Actor::kSensor || actor.kind == Actor::kActuator)
    line.Add("' of controller '").Add(actor.type).Add("': ");
  else
    line.Add("' (").Add(actor.type).Add("): ");
  line.Add(NameOf(step)).Add(" at tick ").Add(tick);
}

}  // namespace activity

std::string ActivityText(const Actor& actor, ActivityStep step, std::uint64_t tick)
{
  if (actor.kind == Actor::kNobody) return {};
  LineWriter line;
  activity::Write(line, actor, step, tick);
  return std::string(line.Text());
}

std::string CurrentActivity()
{
  const activity::Current now = activity::Now();
  return now.actor == nullptr ? std::string() : ActivityText(*now.actor, now.step, now.tick);
}

}  // namespace swarmanoid
