// What the controllers and devices of a host remember, robot by robot, so that another number of hosts can go on with
// it.
#include <algorithm>
#include <sstream>

#include "common/checkpoint/host_state.h"
#include "common/space/space.h"
#include "common/space/state_checks.h"
#include "controller_host/batches.h"

namespace swarmanoid
{

// What is set of others than the robots is of the first one.
std::vector<AttributeChanges> ControllerHost::ChangesByRobot() const
{
  std::vector<AttributeChanges> by_robot(robots_.size());
  const AttributeChanges& changes = commands_.attributes;
  for (std::size_t k = 0; k < changes.slots.size(); ++k)
  {
    const std::uint32_t entity = EntityOfSlot(space_, changes.slots[k]);
    const auto place = std::ranges::lower_bound(layout_.robots, entity);
    const bool ours = place != layout_.robots.end() && *place == entity;
    by_robot[ours ? static_cast<std::size_t>(place - layout_.robots.begin()) : 0].Add(changes.slots[k],
                                                                                      changes.values[k]);
  }
  return by_robot;
}

// Of a robot, so that another host can go on with it.
void ControllerHost::SaveCommands(std::uint32_t entity, const AttributeChanges& changes, ByteWriter& bytes) const
{
  ForEachCommand(entity,
                 [&](std::size_t first, std::size_t behind)
                 {
                   for (std::size_t k = first; k < behind; ++k) bytes.Put(commands_.values[k]);
                 });
  bytes.PutArray(changes.slots);
  bytes.PutArray(changes.values);
  const auto& failed = commands_.faults.robots;
  const auto fault = std::ranges::lower_bound(failed, entity);
  const bool has_failed = fault != failed.end() && *fault == entity;
  bytes.Put(has_failed);
  if (has_failed) bytes.Put(commands_.faults.kinds[static_cast<std::size_t>(fault - failed.begin())]);
}

void ControllerHost::LoadCommands(std::uint32_t entity, ByteReader& bytes)
{
  ForEachCommand(entity,
                 [&](std::size_t first, std::size_t behind)
                 {
                   for (std::size_t k = first; k < behind; ++k) commands_.values[k] = bytes.Get<double>();
                 });
  const auto slots = bytes.GetArray<std::uint32_t>();
  const auto values = bytes.GetArray<double>();
  if (slots.size() != values.size()) throw StateError("there are other attributes than values of them");
  for (std::size_t k = 0; k < slots.size(); ++k) commands_.attributes.Add(slots[k], values[k]);
  if (!bytes.Get<bool>()) return;
  commands_.faults.Add(entity, bytes.Get<FaultKind>(), "");
}

void ControllerHost::SaveState(ByteWriter& state) const
{
  std::vector<ByteWriter> of_robot(robots_.size());
  const std::vector<AttributeChanges> changes = ahead_ > 0 ? ChangesByRobot() : std::vector<AttributeChanges>();
  for (std::size_t k = 0; k < robots_.size(); ++k)
  {
    const Robot& robot = robots_[k];
    ByteWriter& bytes = of_robot[k];
    if (ahead_ > 0) SaveCommands(robot.entity, changes[k], bytes);
    if (const Guard* guard = robot.guard.get())
    {
      bytes.Put(guard->stopped);
      bytes.Put(guard->kind);
      bytes.Put(guard->failed_at);
      bytes.Put(guard->restarts);
      if (guard->stopped) continue;
    }
    if (!robot.controller->HasState())
      throw ControllerError("robot '" + robot.interface->GetId() +
                            "': its controller cannot be saved; it must override HasState, " +
                            "SaveState and LoadState");
    std::ostringstream text;
    RunCodeOf(robot.actor, ActivityStep::kSaveState, space_.GetTick(), [&] { robot.controller->SaveState(text); });
    bytes.PutText(text.str());
  }
  HostState all;
  for (const Batches::Sensor& sensor : batches_->sensors)
  {
    ByteWriter common;
    sensor.batch->SaveCommon(common);
    if (!common.Bytes().empty()) all.sensors[sensor.number].assign(common.Bytes().begin(), common.Bytes().end());
    for (std::size_t n = 0; n < sensor.robots.size(); ++n) sensor.batch->SaveState(n, of_robot[sensor.robots[n]]);
  }
  for (const Batches::Actuator& actuator : batches_->actuators)
    for (std::size_t n = 0; n < actuator.robots.size(); ++n) actuator.batch->SaveState(n, of_robot[actuator.places[n]]);
  for (std::size_t k = 0; k < robots_.size(); ++k)
    all.robots[robots_[k].entity].assign(of_robot[k].Bytes().begin(), of_robot[k].Bytes().end());
  Write(all, state);
}

void ControllerHost::LoadState(ByteReader& state)
{
  sensed_tick_.reset();
  due_tick_.reset();
  silence_ = {};
  commands_.attributes.Clear();
  commands_.faults.Clear();
  const HostState all = ReadHostState(state);
  std::vector<ByteReader> of_robot;
  for (const Robot& robot : robots_)
  {
    const auto found = all.robots.find(robot.entity);
    if (found == all.robots.end() || all.robots.size() != robots_.size())
      throw std::runtime_error("saved state: a controller host has other robots");
    of_robot.emplace_back(std::span<const char>(found->second));
  }
  for (std::size_t k = 0; k < robots_.size(); ++k)
  {
    Robot& robot = robots_[k];
    ByteReader& bytes = of_robot[k];
    if (ahead_ > 0) LoadCommands(robot.entity, bytes);
    if (Guard* guard = robot.guard.get())
    {
      guard->stopped = bytes.Get<bool>();
      guard->kind = bytes.Get<FaultKind>();
      guard->failed_at = bytes.Get<std::uint64_t>();
      guard->restarts = bytes.Get<std::uint32_t>();
      if (guard->stopped)
      {
        Stop(robot);
        continue;
      }
    }
    const std::string saved = bytes.GetText();
    if (robot.guard != nullptr) robot.guard->state = saved;
    std::istringstream text(saved);
    RunCodeOf(robot.actor, ActivityStep::kLoadState, space_.GetTick(), [&] { robot.controller->LoadState(text); });
  }
  for (Batches::Sensor& sensor : batches_->sensors)
  {
    const auto common = all.sensors.find(sensor.number);
    ByteReader bytes(common == all.sensors.end() ? std::span<const char>() : std::span<const char>(common->second));
    sensor.batch->LoadCommon(bytes);
    for (std::size_t n = 0; n < sensor.robots.size(); ++n) sensor.batch->LoadState(n, of_robot[sensor.robots[n]]);
  }
  for (Batches::Actuator& actuator : batches_->actuators)
    for (std::size_t n = 0; n < actuator.robots.size(); ++n) actuator.batch->LoadState(n, of_robot[actuator.places[n]]);
  batches_->order.Apply(commands_.attributes);
  for (const ByteReader& bytes : of_robot)
    if (!bytes.AtEnd()) throw std::runtime_error("saved state: what a robot saved is longer than what it loads");
}

}  // namespace swarmanoid
