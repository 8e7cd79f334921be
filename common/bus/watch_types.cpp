// Conversion of the messages by which visualisers watch a run.
#include <utility>

#include "common/bus/cold_types.h"

namespace swarmanoid
{
namespace
{

constexpr std::pair<RunStatus::Phase, std::uint32_t> kPhases[] = {{RunStatus::Phase::kWaiting, wire::PHASE_WAITING},
                                                                  {RunStatus::Phase::kRunning, wire::PHASE_RUNNING},
                                                                  {RunStatus::Phase::kPaused, wire::PHASE_PAUSED},
                                                                  {RunStatus::Phase::kFinished, wire::PHASE_FINISHED}};

void ToWire(const std::vector<DeviceStatus>& devices, std::vector<wire::Device>& wire)
{
  wire.resize(devices.size());
  for (std::size_t d = 0; d < devices.size(); ++d)
  {
    wire[d].type(devices[d].type);
    const auto& readings = devices[d].readings;
    wire[d].readings().resize(readings.size());
    for (std::size_t i = 0; i < readings.size(); ++i)
    {
      wire[d].readings()[i].name(readings[i].name);
      wire[d].readings()[i].unit(readings[i].unit);
      wire[d].readings()[i].value(readings[i].value);
    }
  }
}

void FromWire(std::vector<wire::Device>& wire, std::vector<DeviceStatus>& devices)
{
  devices.clear();
  for (wire::Device& device : wire)
  {
    devices.push_back({std::move(device.type()), {}});
    for (wire::Reading& reading : device.readings())
      devices.back().readings.push_back({std::move(reading.name()), std::move(reading.unit()), reading.value()});
  }
}

}  // namespace

void ToWire(const WishesMessage& message, wire::Wishes& wire)
{
  wire.client(message.client);
  wire.run(message.run);
  wire.views(message.views);
  wire.every_tick(message.every_tick);
  wire.robots(message.robots);
}

void FromWire(wire::Wishes& wire, WishesMessage& message)
{
  message.client = std::move(wire.client());
  message.run = wire.run();
  message.views = wire.views();
  message.every_tick = wire.every_tick();
  message.robots = std::move(wire.robots());
}

void ToWire(const RunStatusMessage& message, wire::RunStatus& wire)
{
  const RunStatus& status = message.status;
  wire.run(message.run);
  wire.tick(status.tick);
  wire.phase(0);
  for (const auto& [phase, number] : kPhases)
    if (phase == status.phase) wire.phase(number);
  wire.speed_wanted(status.speed_wanted);
  wire.real_time_factor(status.real_time_factor);
  wire.ticks_per_second(status.ticks_per_second);
  wire.ended(status.ended);
  wire.processes().resize(status.processes.size());
  for (std::size_t i = 0; i < status.processes.size(); ++i)
  {
    wire::ProcessState& process = wire.processes()[i];
    process.name(status.processes[i].name);
    process.process(status.processes[i].process);
    process.tick(status.processes[i].tick);
    process.late_s(status.processes[i].late_s);
    process.doing(status.processes[i].doing);
  }
}

void FromWire(wire::RunStatus& wire, RunStatusMessage& message)
{
  RunStatus& status = message.status;
  message.run = wire.run();
  status.tick = wire.tick();
  status.phase = RunStatus::Phase::kUnknown;
  for (const auto& [phase, number] : kPhases)
    if (number == wire.phase()) status.phase = phase;
  status.speed_wanted = wire.speed_wanted();
  status.real_time_factor = wire.real_time_factor();
  status.ticks_per_second = wire.ticks_per_second();
  status.ended = std::move(wire.ended());
  status.processes.clear();
  for (wire::ProcessState& process : wire.processes())
    status.processes.push_back({std::move(process.name()), std::move(process.process()), process.tick(),
                                process.late_s(), std::move(process.doing())});
}

void ToWire(const RobotStatusMessage& message, wire::RobotStatus& wire)
{
  wire.run(message.run);
  wire.tick(message.tick);
  wire.source(message.source);
  wire.robots().resize(message.robots.size());
  for (std::size_t i = 0; i < message.robots.size(); ++i)
  {
    const RobotStatus& robot = message.robots[i];
    wire::Robot& its = wire.robots()[i];
    its.entity(robot.entity);
    its.controller(robot.controller);
    its.text(robot.text);
    its.state(robot.state);
    ToWire(robot.sensors, its.sensors());
    ToWire(robot.actuators, its.actuators());
  }
}

void FromWire(wire::RobotStatus& wire, RobotStatusMessage& message)
{
  message.run = wire.run();
  message.tick = wire.tick();
  message.source = wire.source();
  message.robots.resize(wire.robots().size());
  for (std::size_t i = 0; i < message.robots.size(); ++i)
  {
    wire::Robot& its = wire.robots()[i];
    RobotStatus& robot = message.robots[i];
    robot.entity = its.entity();
    robot.tick = wire.tick();
    robot.controller = std::move(its.controller());
    robot.text = std::move(its.text());
    robot.state = std::move(its.state());
    FromWire(its.sensors(), robot.sensors);
    FromWire(its.actuators(), robot.actuators);
  }
}

}  // namespace swarmanoid
