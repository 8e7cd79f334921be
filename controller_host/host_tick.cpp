// What a controller host does at each tick: sensors, control steps, commands.
#include <algorithm>
#include <exception>

#include "common/messages/attribute_changes.h"
#include "common/space/attributes.h"
#include "common/space/space.h"
#include "common/space/state_checks.h"
#include "controller_host/batches.h"
#include "controller_host/controller_host.h"
#include "controller_host/split_sensor.h"

namespace swarmanoid
{

void ControllerHost::Sense(std::span<const SensorFrame* const> frames)
{
  const std::uint64_t tick = space_.GetTick();
  if (sensed_tick_ == tick) return;
  sensed_tick_ = tick;
  // What the engines sensed.
  if (!frames.empty())
    for (const ValueCopy& copy : layout_.sensor_copies)
    {
      const auto source = std::find(layout_.frames_from.begin(), layout_.frames_from.end(), copy.source);
      const SensorFrame& frame = *frames[static_cast<std::size_t>(source - layout_.frames_from.begin())];
      std::copy_n(frame.values.begin() + static_cast<std::ptrdiff_t>(copy.from), copy.count,
                  sensor_values_.begin() + static_cast<std::ptrdiff_t>(copy.to));
    }
  UpdateSensors(tick);
}

const ControlCommands& ControllerHost::Tick(std::span<const SensorFrame* const> frames)
{
  const std::uint64_t tick = space_.GetTick();
  Due();
  Sense(frames);
  RunControllers(tick);
  for (const Batches::Sensor& sensor : batches_->sensors)
    if (sensor.on_demand != nullptr) sensor.on_demand->EndSteps();

  stepped_tick_ = tick;
  commands_.tick = tick + ahead_;
  CommitActuators();
  return Commands();
}

const ControlCommands* ControllerHost::Due()
{
  if (ahead_ == 0) return nullptr;
  const std::uint64_t tick = space_.GetTick();
  if (due_tick_ == tick) return &due_;
  due_tick_ = tick;
  due_ = commands_;
  due_.tick = tick;
  return &due_;
}

void ControllerHost::UpdateSensors(std::uint64_t tick)
{
  for (Batches::Sensor& sensor : batches_->sensors)
    if (sensor.part == Batches::kWhole)
      RunCodeOf(sensor.actor, ActivityStep::kUpdate, tick,
                [&] {
                  sensor.batch->Update({sensor_values_, sensor.slice.offsets, sensor.slice.width});
                });
  if (batches_->split) UpdateParts(tick);
}

void ControllerHost::UpdateParts(std::uint64_t tick)
{
  std::vector<Batches::Failure>& failures = batches_->failures;
  WorkerPool& pool = *batches_->pool;
  failures.assign(pool.Threads(), {});
  const auto update = [&](unsigned part)
  {
    for (Batches::Sensor& sensor : batches_->sensors)
    {
      if (sensor.part != static_cast<int>(part)) continue;
      try
      {
        sensor.batch->Update({sensor_values_, sensor.slice.offsets, sensor.slice.width});
      }
      catch (...)
      {
        failures[part] = {std::current_exception(), sensor.actor};
        return;
      }
    }
  };
  const auto refresh = [&](WorkerPool* by)
  {
    for (Batches::Sensor& sensor : batches_->sensors)
      if (sensor.part != Batches::kWhole)
        RunCodeOf(sensor.actor, ActivityStep::kUpdate, tick,
                  [&] { dynamic_cast<SplitSensor&>(*sensor.batch).RefreshShared(by); });
  };
  refresh(IfItShares(&pool));
  if (pool.Shares())
    pool.Run(update);
  else
    for (unsigned part = 0; part < pool.Threads(); ++part) update(part);
  // The first of the robots, whichever thread was first.
  for (const Batches::Failure& failure : failures)
    if (failure.what != nullptr)
      RunCodeOf(failure.actor, ActivityStep::kUpdate, tick, [&] { std::rethrow_exception(failure.what); });
}

void ControllerHost::CommitActuators()
{
  commands_.attributes.Clear();
  for (Batches::Actuator& actuator : batches_->actuators)
  {
    const std::size_t first = commands_.attributes.slots.size();
    RunCodeOf(actuator.actor, ActivityStep::kUpdate, stepped_tick_,
              [&] {
                actuator.batch->Commit({commands_.values, actuator.slice.offsets, actuator.slice.width},
                                       commands_.attributes);
              });
    // Nobody would hear them: commands of channels go to the engines alone.
    if (actuator.slice.width > 0 && commands_.attributes.slots.size() > first)
      throw ControllerError("actuator '" + actuator.device->type + "' (" + actuator.device->implementation +
                            "): it has a channel, so it must not change attributes");
    CheckAttributesOf(*actuator.device, actuator.robots, first);
  }
  if (!silence_.robots.empty()) SilenceStopped();
  batches_->order.Apply(commands_.attributes);
  CheckCommands();
}

// What a device has just added, from `first` on.
void ControllerHost::CheckAttributesOf(const DeviceConfiguration& device, std::span<const std::uint32_t> robots,
                                       std::size_t first) const
{
  const AttributeChanges& changes = commands_.attributes;
  for (std::size_t k = first; k < changes.slots.size(); ++k)
  {
    try
    {
      CheckAttribute(space_, changes.slots[k], changes.values[k]);
      CheckIsNoHold(space_, changes.slots[k]);
    }
    catch (const StateError& error)
    {
      const std::uint32_t entity = EntityOfSlot(space_, changes.slots[k]);
      if (!AllFinite({&changes.values[k], 1}) && std::binary_search(robots.begin(), robots.end(), entity))
        FailCommand(entity, device, changes.values[k]);
      throw ControllerError("actuator '" + device.type + "' (" + device.implementation + ") at tick " +
                            std::to_string(stepped_tick_) + ": " + error.what());
    }
  }
}

void ControllerHost::CheckCommands()
{
  if (AllFinite(commands_.values)) return;
  // Devices may share a channel: the one that does it again is the one.
  for (Batches::Actuator& actuator : batches_->actuators)
    for (std::size_t k = 0; k < actuator.slice.offsets.size(); ++k)
      for (int i = 0; i < actuator.slice.width; ++i)
      {
        double& value = commands_.values[actuator.slice.offsets[k] + static_cast<std::size_t>(i)];
        if (AllFinite({&value, 1})) continue;
        const double found = value;
        value = 0;
        AttributeChanges again;
        actuator.batch->Commit({commands_.values, actuator.slice.offsets, actuator.slice.width}, again);
        if (!AllFinite({&value, 1})) FailCommand(actuator.robots[k], *actuator.device, found);
        value = found;
      }
  throw ControllerError("the commands at tick " + std::to_string(stepped_tick_) + " are not finite");
}

void ControllerHost::FailCommand(std::uint32_t robot, const DeviceConfiguration& device, double value) const
{
  const CSwarmanoidSpaceEntity& entity = space_.GetEntity(robot);
  throw ControllerError("robot '" + entity.GetId() + "': its controller '" + entity.GetConfiguration().controller +
                        "' commanded " + std::to_string(value) + " to the actuator '" + device.type + "' at tick " +
                        std::to_string(stepped_tick_) + "; commands must be finite numbers");
}

// Those that may step in parallel come first, however many threads there are, and those with a guard last.
void ControllerHost::RunControllers(std::uint64_t tick)
{
  if (IfItShares(batches_->pool) != nullptr && parallel_.size() > 1)
    StepInParallel(tick);
  else
    StepInTurn(parallel_, tick);
  StepInTurn(in_turn_, tick);
  if (!guarded_.empty()) StepGuarded(tick);
}

void ControllerHost::StepInTurn(std::span<const std::uint32_t> robots, std::uint64_t tick)
{
  if (robots.empty()) return;
  Activity activity(robots_[robots.front()].actor, ActivityStep::kControlStep, tick);
  ControlSteps(robots, tick, activity);
}

void ControllerHost::StepInParallel(std::uint64_t tick)
{
  const SharedActivity activity(ActivityStep::kControlStep, tick);
  const std::size_t threads = batches_->pool->Threads();
  batches_->stopped.assign(threads, nullptr);
  batches_->pool->Run(
      [&](unsigned k)
      {
        const std::size_t begin = parallel_.size() * k / threads;
        const std::size_t end = parallel_.size() * (k + 1) / threads;
        SharedActivity::Thread of_thread(k);
        try
        {
          ControlSteps(std::span(parallel_).subspan(begin, end - begin), tick, of_thread);
        }
        catch (...)
        {
          batches_->stopped[k] = std::current_exception();
        }
      });
  // The first of the robots, whichever thread was first.
  for (const std::exception_ptr& stopped : batches_->stopped)
    if (stopped != nullptr) std::rethrow_exception(stopped);
}

template <class ActivityOfThread>
void ControllerHost::ControlSteps(std::span<const std::uint32_t> robots, std::uint64_t tick, ActivityOfThread& activity)
{
  const Actor* running = nullptr;
  try
  {
    for (const std::uint32_t k : robots)
    {
      Robot& robot = robots_[k];
      if (!space_.IsPresent(robot.entity)) continue;
      robot.interface->BeginControlStep(tick, space_.StreamTick());
      running = &robot.actor;
      activity.Next(*running);
      robot.controller->ControlStep();
    }
  }
  catch (...)
  {
    RethrowFor(*running, ActivityStep::kControlStep, tick);
  }
}

}  // namespace swarmanoid
