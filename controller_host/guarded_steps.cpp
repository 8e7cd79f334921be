// Controllers that may fail, or have a time budget: their steps, and what comes of a failure (docs/recovery.md).
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <exception>
#include <sstream>

#include "common/configuration/shown_text.h"
#include "common/control_interface/init_controller.h"
#include "common/logging/log.h"
#include "common/messages/attribute_changes.h"
#include "common/space/attributes.h"
#include "common/space/space.h"
#include "common/space/state_checks.h"
#include "controller_host/batches.h"

namespace swarmanoid
{
namespace
{

// A controller that fails more often, never with more ticks between, is not started again.
constexpr std::uint32_t kMostRestarts = 3;
constexpr std::uint64_t kRestartMemory = 100;
constexpr std::size_t kLongestFault = 200;  // bytes of the text of an exception that the run is told

// What shows, or is heard, of a robot. Others, such as angles, stay.
constexpr std::string_view kSilenced[] = {"led", "beacon", "laser", "message", "radio", "report"};

double ThreadMilliseconds()
{
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

}  // namespace

void ControllerHost::StepGuarded(std::uint64_t tick)
{
  commands_.faults.Clear();
  Activity activity(robots_[guarded_.front()].actor, ActivityStep::kControlStep, tick);
  for (const std::uint32_t k : guarded_)
  {
    Robot& guarded = robots_[k];
    if (!space_.IsPresent(guarded.entity) || guarded.guard->stopped) continue;
    guarded.interface->BeginControlStep(tick, space_.StreamTick());
    activity.Next(guarded.actor);
    TryStep(guarded, tick);
  }
  SaveLastStates(tick + 1);
}

void ControllerHost::TryStep(Robot& robot, std::uint64_t tick)
{
  const ControllerConfiguration& configuration = *robot.guard->configuration;
  const std::optional<FaultKind> known = Known(tick, robot.entity);
  if (known == FaultKind::kDied) return TakeFault(robot, FaultKind::kDied, tick, "died", "");
  const bool is_restarted = configuration.on_failure == OnFailure::kRestart;
  if (is_restarted) SaveDevices(robot);
  SetCureOfStep(configuration.MayFail() ? cure_of_death_ : "");
  bool in_time = true;
  std::optional<std::string> thrown;
  try
  {
    in_time = StepInTime(robot, tick);
  }
  catch (...)
  {
    if (!configuration.MayFail()) RethrowFor(robot.actor, ActivityStep::kControlStep, tick);
    thrown = CurrentExceptionText();
  }
  SetCureOfStep("");
  // A process that died in this step has told the devices nothing. An exception must leave the same.
  if (thrown && is_restarted) LoadDevices(robot);
  if (thrown) return TakeFault(robot, FaultKind::kThrew, tick, "failed: " + *thrown, *thrown);
  if (in_time && known != FaultKind::kTooSlow) return;
  TakeFault(robot, FaultKind::kTooSlow, tick,
            fmt::format("took more processor time than its {:g} ms (time_budget_ms)", configuration.time_budget_ms),
            "");
}

template <class Do>
void ControllerHost::ForEachDevice(const Robot& robot, Do use)
{
  const auto k = static_cast<std::size_t>(&robot - robots_.data());
  const auto use_if_its = [&](auto& batch, const std::vector<std::size_t>& robots)
  {
    const auto place = std::lower_bound(robots.begin(), robots.end(), k);
    if (place != robots.end() && *place == k) use(batch, static_cast<std::size_t>(place - robots.begin()));
  };
  for (const Batches::Sensor& sensor : batches_->sensors) use_if_its(*sensor.batch, sensor.robots);
  for (const Batches::Actuator& actuator : batches_->actuators) use_if_its(*actuator.batch, actuator.places);
}

void ControllerHost::SaveDevices(const Robot& robot)
{
  before_step_.Clear();
  ForEachDevice(robot, [&](const auto& batch, std::size_t n) { batch.SaveState(n, before_step_); });
}

void ControllerHost::LoadDevices(const Robot& robot)
{
  ByteReader before(before_step_.Bytes());
  ForEachDevice(robot, [&](auto& batch, std::size_t n) { batch.LoadState(n, before); });
}

bool ControllerHost::StepInTime(Robot& robot, std::uint64_t tick)
{
  const double budget_ms = robot.guard->configuration->time_budget_ms;
  const bool measures = budget_ms > 0 && tick >= known_.until && tick != known_tick_;
  const double before = measures ? ThreadMilliseconds() : 0;
  robot.controller->ControlStep();
  return !measures || ThreadMilliseconds() - before <= budget_ms;
}

void ControllerHost::Know(RecordedFaults known)
{
  known_ = std::move(known);
  std::sort(known_.faults.begin(), known_.faults.end());
}

void ControllerHost::KnowTick(std::uint64_t tick, const ControllerFaults& faults)
{
  known_tick_ = tick;
  faults_of_tick_ = faults;
}

std::optional<FaultKind> ControllerHost::Known(std::uint64_t tick, std::uint32_t robot) const
{
  if (known_tick_ == tick)
  {
    const auto& robots = faults_of_tick_.robots;
    const auto place = std::lower_bound(robots.begin(), robots.end(), robot);
    if (place == robots.end() || *place != robot) return std::nullopt;
    return faults_of_tick_.kinds[static_cast<std::size_t>(place - robots.begin())];
  }
  const auto place = std::lower_bound(known_.faults.begin(), known_.faults.end(), std::pair(tick, robot),
                                      [](const RecordedFault& fault, const auto& of)
                                      { return std::pair(fault.tick, fault.robot) < of; });
  if (place == known_.faults.end() || place->tick != tick || place->robot != robot) return std::nullopt;
  return place->kind;
}

void ControllerHost::TakeFault(Robot& robot, FaultKind kind, std::uint64_t tick, const std::string& text,
                               const std::string& thrown)
{
  Guard& guard = *robot.guard;
  const std::string what = ActivityText(robot.actor, ActivityStep::kControlStep, tick) + " " + text;
  if (!guard.configuration->MayFail()) throw ControllerError(what);
  commands_.faults.Add(robot.entity, kind, ShowableLine(thrown, kLongestFault));
  if (tick - guard.failed_at > kRestartMemory) guard.restarts = 0;
  guard.kind = kind;
  guard.failed_at = tick;
  if (guard.configuration->on_failure != OnFailure::kRestart || guard.restarts >= kMostRestarts)
  {
    LogWarning("{}; the robot is stopped", what);
    return Stop(robot);
  }
  LogWarning("{}; the controller starts again", what);
  ++guard.restarts;
  try
  {
    Restart(robot, tick);
  }
  catch (const ActivityError& error)
  {
    LogWarning("{}; the robot is stopped", error.what());
    Stop(robot);
  }
}

void ControllerHost::Restart(Robot& robot, std::uint64_t tick)
{
  const Guard& guard = *robot.guard;
  const auto* entry = PluginRegistry<CCI_Controller>::Instance().Find(guard.configuration->tag);
  robot.interface->BeginStep(
      tick, space_.GetTickSeconds(),
      {space_.GetExperiment().seed, StreamName(robot.interface->GetId()), kInitStream, space_.StreamTick()});
  RunCodeOf(robot.actor, ActivityStep::kInit, tick,
            [&]
            {
              robot.controller = entry->create();
              robot.controller->SetRobot(robot.interface.get());
              const int result = InitController(*robot.controller, entry->description, guard.configuration->id,
                                                guard.configuration->parameters);
              if (result != CCI_Controller::RETURN_OK) throw std::runtime_error(fmt::format("it returned {}", result));
            });
  if (!robot.controller->HasState() || guard.state.empty()) return;
  std::istringstream text(guard.state);
  RunCodeOf(robot.actor, ActivityStep::kLoadState, tick, [&] { robot.controller->LoadState(text); });
}

void ControllerHost::SaveLastStates(std::uint64_t tick)
{
  if (tick % space_.GetExperiment().canonical_period != 0) return;
  for (const std::uint32_t k : guarded_)
  {
    const Robot& robot = robots_[k];
    Guard& guard = *robot.guard;
    if (guard.configuration->on_failure != OnFailure::kRestart || guard.stopped || !robot.controller->HasState())
      continue;
    std::ostringstream text;
    RunCodeOf(robot.actor, ActivityStep::kSaveState, tick, [&] { robot.controller->SaveState(text); });
    guard.state = text.str();
  }
}

void ControllerHost::Stop(const Robot& robot)
{
  robot.guard->stopped = true;
  silence_.robots.insert(std::lower_bound(silence_.robots.begin(), silence_.robots.end(), robot.entity), robot.entity);
  const CSwarmanoidSpaceEntity& entity = space_.GetEntity(robot.entity);
  for (const AttributeSpec& spec : AttributesOf(entity.GetKind()))
    if (std::find(std::begin(kSilenced), std::end(kSilenced), spec.name) != std::end(kSilenced))
      for (int element = 0; element < spec.count; ++element)
        silence_.slots.push_back(entity.SlotOf(spec.name, element));
  ForEachCommand(robot.entity,
                 [&](std::size_t first, std::size_t behind) { silence_.commands.emplace_back(first, behind); });
}

void ControllerHost::SilenceStopped()
{
  AttributeChanges& changes = commands_.attributes;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < changes.slots.size(); ++k)
  {
    const std::uint32_t entity = EntityOfSlot(space_, changes.slots[k]);
    if (std::binary_search(silence_.robots.begin(), silence_.robots.end(), entity)) continue;
    changes.slots[kept] = changes.slots[k];
    changes.values[kept++] = changes.values[k];
  }
  changes.slots.resize(kept);
  changes.values.resize(kept);
  for (const std::uint32_t slot : silence_.slots)
    if (space_.Attributes()[slot] != 0) changes.Add(slot, 0);
  for (const auto& [first, behind] : silence_.commands)
    std::fill(commands_.values.begin() + static_cast<std::ptrdiff_t>(first),
              commands_.values.begin() + static_cast<std::ptrdiff_t>(behind), 0.0);
}

std::unique_ptr<StepTimeout> WatchTimeBudgets(const Experiment& experiment, const HostLayout& layout)
{
  constexpr double kLeast_s = 10;
  constexpr double kBudgets = 100;
  double limit_s = 0;
  for (const std::uint32_t robot : layout.robots)
  {
    const double budget_ms = experiment.FindController(experiment.entities[robot].controller)->time_budget_ms;
    if (budget_ms > 0) limit_s = std::max({limit_s, kLeast_s, kBudgets * budget_ms / 1000});
  }
  if (limit_s == 0) return nullptr;
  return std::make_unique<StepTimeout>(
      StepTimeout::Settings{std::chrono::milliseconds(static_cast<std::int64_t>(limit_s * 1000)),
                            {},
                            "time_budget_ms",
                            ActivityStep::kControlStep});
}

}  // namespace swarmanoid
