// A tick of a host is: copy what the engines sensed, update all sensors, run the controllers, commit the actuators.
// Devices work in batches over the robots of one controller entry, because a batch reads memory in order and is called
// once. Big sensors are split among threads by robots; controllers that declare it are run by several threads as well.
//
// Invariants: the result does not depend on the number of threads or hosts. Each robot draws from its own streams;
// attributes are applied in a fixed order (AttributeOrder); of several failures the one of the first robot is reported.
// A command or attribute that is not finite ends the run with the robot, its controller and the device, before an
// engine or the space gets it.
//
// Controllers with a guard (on_failure, time_budget_ms) run one after the other, behind the others. What happened to
// them is part of the commands, so that a process that repeats these ticks (recovery) takes the same decisions from the
// record instead of measuring again: processor time would differ.
#include "controller_host/controller_host.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <exception>
#include <map>
#include <sstream>

#include "common/activity/shared_activity.h"
#include "common/checkpoint/host_state.h"
#include "common/configuration/shown_text.h"
#include "common/control_interface/init_controller.h"
#include "common/experiment/actors.h"
#include "common/logging/log.h"
#include "common/math/finite.h"
#include "common/messages/attribute_changes.h"
#include "common/space/attributes.h"
#include "common/space/collision_models.h"
#include "common/space/shape.h"
#include "common/space/space.h"
#include "common/space/state_checks.h"
#include "common/threads/worker_pool.h"
#include "controller_host/battery_reports.h"
#include "controller_host/device.h"
#include "controller_host/device_faults.h"
#include "controller_host/on_demand_sensor.h"
#include "controller_host/split_sensor.h"

namespace swarmanoid
{

// The slice of a host's channel values that belongs to the robots of one batch.
struct ChannelSlice
{
  std::vector<std::size_t> offsets;  // of each robot within the values of the message
  int width = 0;
};

// The devices of the host: each is a batch over all robots of a controller.
struct ControllerHost::Batches
{
  static constexpr int kWhole = -1;

  struct Sensor
  {
    std::unique_ptr<SensorBatch> batch;
    ChannelSlice slice;
    Actor actor;
    int part = kWhole;                                 // of a device that is split among threads: which one it is
    std::pair<std::uint32_t, std::uint32_t> number{};  // of the controller, and of its sensor
    std::vector<std::size_t> robots{};                 // places in robots_
    OnDemandSensor* on_demand = nullptr;               // the batch, if its readings are made so
  };
  struct Actuator
  {
    std::unique_ptr<ActuatorBatch> batch;
    ChannelSlice slice;
    Actor actor;
    const DeviceConfiguration* device = nullptr;
    std::vector<std::uint32_t> robots;
    std::vector<std::size_t> places{};  // in robots_
  };
  struct Failure
  {
    std::exception_ptr what;
    Actor actor;
  };

  std::vector<Sensor> sensors;
  std::vector<Actuator> actuators;
  AttributeOrder order;
  WorkerPool* pool = nullptr;               // none: one thread does it all
  bool split = false;                       // some sensor is
  std::vector<Failure> failures;            // of sensors, by part
  std::vector<std::exception_ptr> stopped;  // what stopped the controllers of a part

  // Makes the control steps of all parts in the threads of the pool: steps(part, activity of the thread). The failure
  // of the first part that failed is thrown, whichever thread was first.
  template <class Steps>
  void StepInThreads(std::size_t parts, std::uint64_t tick, const Steps& steps)
  {
    const SharedActivity activity(ActivityStep::kControlStep, tick);
    stopped.assign(parts, nullptr);
    pool->Run(static_cast<unsigned>(parts),
              [&](unsigned k, unsigned thread)
              {
                SharedActivity::Thread of_thread(thread);
                try
                {
                  steps(k, of_thread);
                }
                catch (...)
                {
                  stopped[k] = std::current_exception();
                }
              });
    for (const std::exception_ptr& one : stopped)
      if (one != nullptr) std::rethrow_exception(one);
  }
};

template <class Do>
void ControllerHost::ForEachCommand(std::uint32_t entity, Do use) const
{
  for (const ChannelBlock& block : layout_.commands)
  {
    const auto place = std::lower_bound(block.entities.begin(), block.entities.end(), entity);
    if (place == block.entities.end() || *place != entity) continue;
    const auto width = static_cast<std::size_t>(block.width);
    const std::size_t first = block.offset + static_cast<std::size_t>(place - block.entities.begin()) * width;
    use(first, first + width);
  }
}

namespace
{

ChannelSlice SliceOf(const std::vector<ChannelBlock>& blocks, const std::string& channel,
                     std::span<const std::uint32_t> robots)
{
  ChannelSlice slice;
  if (channel.empty()) return slice;
  const auto block =
      std::find_if(blocks.begin(), blocks.end(), [&](const ChannelBlock& b) { return b.name == channel; });
  slice.offsets.resize(robots.size());
  slice.width = block->width;
  for (std::size_t k = 0; k < robots.size(); ++k)
  {
    const auto place = std::lower_bound(block->entities.begin(), block->entities.end(), robots[k]);
    slice.offsets[k] = block->offset + static_cast<std::size_t>(place - block->entities.begin()) * slice.width;
  }
  return slice;
}

// Returns the number of parts into which a sensor of `robots` is split. Each part has a small cost of its own.
std::size_t PartsOf(std::size_t robots, const WorkerPool* pool)
{
  constexpr std::size_t kLeast = 128;  // robots of a part
  return pool == nullptr ? 1 : std::clamp<std::size_t>(robots / kLeast, 1, pool->Parts());
}

// A controller that fails more often, never with more ticks between, is not started again.
constexpr std::uint32_t kMostRestarts = 3;
constexpr std::uint64_t kRestartMemory = 100;
constexpr std::size_t kLongestFault = 200;  // bytes of the text of an exception that the run is told

// The attributes of a robot that others can see or hear. They become 0; other attributes, such as angles, stay.
constexpr std::string_view kSilenced[] = {"led", "beacon", "laser", "message", "radio", "report"};

double ThreadMilliseconds()
{
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

}  // namespace

ControllerHost::ControllerHost(const CSwarmanoidSpace& space, const Assignment& assignment, std::size_t host,
                               WorkerPool* pool)
    : space_(space),
      layout_(assignment.hosts[host]),
      batches_(std::make_unique<Batches>()),
      ahead_(space.GetExperiment().ahead)
{
  batches_->pool = pool;
  const Experiment& experiment = space.GetExperiment();
  commands_.host = static_cast<std::uint32_t>(host);
  commands_.values.resize(layout_.command_size);
  sensor_values_.resize(layout_.sensor_size);

  std::vector<std::vector<std::size_t>> robots_of(experiment.controllers.size());
  robots_.reserve(layout_.robots.size());
  for (std::size_t k = 0; k < layout_.robots.size(); ++k)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(layout_.robots[k]);
    const ControllerConfiguration* configuration = experiment.FindController(entity.GetConfiguration().controller);
    robots_of[static_cast<std::size_t>(configuration - experiment.controllers.data())].push_back(k);
    robots_.push_back({layout_.robots[k], RobotActor(experiment, layout_.robots[k]),
                       std::make_unique<CCI_Robot>(entity.GetId(), std::string(TagName(entity.GetKind()))), nullptr,
                       configuration->IsGuarded() ? std::make_unique<Guard>(Guard{configuration}) : nullptr});
  }

  for (const Robot& robot : robots_)
    robot.interface->SetControlStepKey({experiment.seed, StreamName(robot.interface->GetId()), kControlStepStream});
  for (const Robot& robot : robots_)
    robot.interface->SetLog([](const CCI_Robot& of, std::string_view text)
                            { LogInfo("robot '{}' at tick {}: {}", of.GetId(), of.GetTick(), text); });

  for (std::size_t c = 0; c < experiment.controllers.size(); ++c)
  {
    if (robots_of[c].empty()) continue;
    const ControllerConfiguration& configuration = experiment.controllers[c];
    MakeBatches(configuration, robots_of[c]);
    const auto* entry = PluginRegistry<CCI_Controller>::Instance().Find(configuration.tag);
    if (entry == nullptr)
      throw ConfigurationError(configuration.location, "library '" + configuration.library +
                                                           "' registers no controller '" + configuration.tag + "'");
    for (const std::size_t k : robots_of[c])
    {
      Robot& robot = robots_[k];
      robot.interface->BeginStep(0, space.GetTickSeconds(),
                                 {experiment.seed, StreamName(robot.interface->GetId()), kInitStream, 0});
      RunCodeOf(robot.actor, ActivityStep::kInit, 0, [&] { robot.controller = entry->create(); });
      robot.controller->SetRobot(robot.interface.get());
    }
  }

  MakeBatteries();
  MakeFaults();
  // Init is called in entity order, whatever the controllers are.
  for (Robot& robot : robots_)
  {
    const ControllerConfiguration& configuration =
        *experiment.FindController(space.GetEntity(robot.entity).GetConfiguration().controller);
    int result = CCI_Controller::RETURN_OK;
    const auto* entry = PluginRegistry<CCI_Controller>::Instance().Find(configuration.tag);
    RunCodeOf<ConfigurationError>(robot.actor, ActivityStep::kInit, 0,
                                  [&] {
                                    result = InitController(*robot.controller, entry->description, configuration.id,
                                                            configuration.parameters);
                                  });
    if (result != CCI_Controller::RETURN_OK)
      throw ControllerError(ActivityText(robot.actor, ActivityStep::kInit, 0) + " failed: it returned " +
                            std::to_string(result));
  }

  ListSteps();
  SaveLastStates(0);
}

void ControllerHost::ListSteps()
{
  for (auto* list : {&parallel_, &in_turn_, &guarded_}) list->clear();
  batches_of_robots_.clear();
  Clear(commands_.faults);
  const Experiment& experiment = space_.GetExperiment();
  std::map<const ControllerConfiguration*, std::vector<std::uint32_t>> together;
  for (std::uint32_t k = 0; k < robots_.size(); ++k)
  {
    if (device_faults_ != nullptr && device_faults_->SwitchedOff(k) != nullptr) continue;
    if (robots_[k].guard != nullptr)
      guarded_.push_back(k);
    else if (dynamic_cast<CCI_BatchController*>(robots_[k].controller.get()) != nullptr)
      together[experiment.FindController(experiment.entities[robots_[k].entity].controller)].push_back(k);
    else
      (robots_[k].controller->StepsInParallel() ? parallel_ : in_turn_).push_back(k);
  }
  for (const auto& [configuration, robots] : together)
  {
    const bool may_share = batches_->pool != nullptr && robots_[robots.front()].controller->StepsInParallel();
    const std::size_t parts = may_share ? std::min<std::size_t>(robots.size(), batches_->pool->Parts()) : 1;
    std::vector<BatchOfRobots>& batches = batches_of_robots_.emplace_back(parts);
    for (std::size_t part = 0; part < parts; ++part)
      batches[part].robots.assign(robots.begin() + static_cast<std::ptrdiff_t>(robots.size() * part / parts),
                                  robots.begin() + static_cast<std::ptrdiff_t>(robots.size() * (part + 1) / parts));
  }
}

void ControllerHost::MakeBatteries()
{
  battery_reports_ = BatteryReports::Of(space_, layout_);
  if (battery_reports_ == nullptr) return;
  for (const Batches::Sensor& sensor : batches_->sensors)
    for (std::size_t n = 0; n < sensor.robots.size(); ++n) battery_reports_->Add(sensor.robots[n], *sensor.batch, n);
  for (const Batches::Actuator& actuator : batches_->actuators)
    for (std::size_t n = 0; n < actuator.places.size(); ++n)
      battery_reports_->Add(actuator.places[n], *actuator.batch, n);
}

void ControllerHost::MakeFaults()
{
  const Experiment& experiment = space_.GetExperiment();
  std::vector<std::uint32_t> stopping;  // robots that an empty battery stops
  for (std::size_t k = 0; k < robots_.size(); ++k)
    if (battery_reports_ != nullptr && battery_reports_->Stops(k)) stopping.push_back(robots_[k].entity);
  if (experiment.faults.empty() && stopping.empty()) return;
  device_faults_ = std::make_unique<DeviceFaults>(space_, robots_.size());
  for (const FaultConfiguration& fault : experiment.faults)
  {
    device_faults_->Begin(fault);
    AddFault(fault, fault.entities);
  }
  if (stopping.empty()) return;
  empty_battery_.id = "empty battery";
  empty_battery_.kind = DeviceFaultKind::kOff;
  empty_battery_.kind_name = "off";
  empty_battery_.location = experiment.FindController(experiment.entities[stopping.front()].controller)->location;
  device_faults_->BeginEmptyBatteries(empty_battery_,
                                      [this](std::size_t robot) { return battery_reports_->IsOff(robot); });
  AddFault(empty_battery_, stopping);
}

void ControllerHost::AddFault(const FaultConfiguration& fault, std::span<const std::uint32_t> entities)
{
  const Experiment& experiment = space_.GetExperiment();
  const auto concerns = [&](const DeviceConfiguration& device)
  { return fault.device.empty() || fault.device == device.type; };
  for (const std::uint32_t entity : entities)
  {
    const auto place = std::ranges::lower_bound(layout_.robots, entity);
    if (place == layout_.robots.end() || *place != entity) continue;
    const auto k = static_cast<std::size_t>(place - layout_.robots.begin());
    const auto number_in = [k](const std::vector<std::size_t>& robots) -> std::optional<std::size_t>
    {
      const auto found = std::ranges::lower_bound(robots, k);
      if (found == robots.end() || *found != k) return std::nullopt;
      return static_cast<std::size_t>(found - robots.begin());
    };
    if (fault.kind == DeviceFaultKind::kOff) device_faults_->AddOff(k);
    if (fault.of_sensors && fault.kind != DeviceFaultKind::kOff)
      for (const Batches::Sensor& sensor : batches_->sensors)
      {
        const DeviceConfiguration& device = experiment.controllers[sensor.number.first].sensors[sensor.number.second];
        if (!concerns(device)) continue;
        if (const auto n = number_in(sensor.robots))
          device_faults_->Add({.sensor = sensor.batch.get(), .on_demand = sensor.on_demand, .k = *n, .robot = k},
                              entity, device);
      }
    if (fault.of_actuators)
      for (const Batches::Actuator& actuator : batches_->actuators)
        if (concerns(*actuator.device))
          if (const auto n = number_in(actuator.places))
            device_faults_->Add({.actuator = actuator.batch.get(), .k = *n, .robot = k}, entity, *actuator.device);
  }
}

void ControllerHost::LogBatteries() const
{
  for (std::size_t k = 0; k < robots_.size(); ++k)
  {
    const bool is_empty = device_faults_->SwitchedOff(k) == &empty_battery_;
    if (is_empty == (device_faults_->SwitchedOffBefore(k) == &empty_battery_)) continue;
    LogInfo("robot '{}' at tick {}: {}", robots_[k].interface->GetId(), space_.GetTick(),
            is_empty ? "its battery is empty, and it is switched off" : "its battery is charged, and it runs again");
  }
}

double ControllerHost::Reach() const
{
  // LEDs, antennas, tags and hands of others stand out from their bodies.
  constexpr double kStandOut = 1;
  double reach = 0;
  for (const Batches::Sensor& sensor : batches_->sensors) reach = std::max(reach, sensor.batch->Reach());
  for (const Batches::Actuator& actuator : batches_->actuators) reach = std::max(reach, actuator.batch->Reach());
  double largest = 0;
  const CollisionModels models(space_);
  std::vector<CollisionBody> bodies;
  for (const std::uint32_t entity : space_.Movable())
  {
    if (models.IsArticulated(entity))
    {
      models.BodiesOf(entity, bodies);
      for (const CollisionBody& body : bodies) largest = std::max(largest, ReachOf(body));
    }
    const Shape shape = ShapeOf(space_.GetEntity(entity).GetConfiguration());
    largest = std::max(largest, shape.centre.norm() + BoundingRadius(shape));
  }
  return reach + largest + kStandOut;
}

ControllerHost::~ControllerHost()
{
  try
  {
    Destroy();
  }
  catch (const std::exception&)
  {
    // The caller of Destroy has reported the first error already, or the run has failed before.
  }
}

void ControllerHost::MakeBatches(const ControllerConfiguration& configuration, const std::vector<std::size_t>& robots)
{
  std::vector<std::uint32_t> entities;
  for (const std::size_t k : robots) entities.push_back(robots_[k].entity);

  const auto setup_of = [&](const DeviceConfiguration& device, const PluginDescription& description,
                            std::uint64_t stream, const std::vector<std::uint32_t>& of) {
    return DeviceSetup{Parameters(device.tree, description.parameters), space_, of, stream};
  };
  const auto unknown = [&](const DeviceConfiguration& device)
  {
    return ConfigurationError(device.tree.Location(), "no implementation '" + device.implementation + "' of <" +
                                                          device.type + "> is registered");
  };

  const Experiment& experiment = space_.GetExperiment();
  const auto number = static_cast<std::size_t>(&configuration - experiment.controllers.data());
  for (std::size_t d = 0; d < configuration.sensors.size(); ++d)
  {
    const DeviceConfiguration& device = configuration.sensors[d];
    const auto* entry = PluginRegistry<SensorBatch>::Instance().Find(device.type, device.implementation);
    if (entry == nullptr) throw unknown(device);
    const bool may_split = dynamic_cast<SplitSensor*>(entry->create().get()) != nullptr;
    const std::size_t parts = may_split ? PartsOf(entities.size(), batches_->pool) : 1;
    for (std::size_t part = 0; part < parts; ++part)
    {
      const std::size_t first = entities.size() * part / parts;
      const std::size_t behind = entities.size() * (part + 1) / parts;
      const std::vector<std::uint32_t> some(entities.begin() + static_cast<std::ptrdiff_t>(first),
                                            entities.begin() + static_cast<std::ptrdiff_t>(behind));
      Batches::Sensor sensor{
          entry->create(),
          SliceOf(layout_.sensors, entry->description.channel, some),
          SensorActor(experiment, number, d),
          parts > 1 ? static_cast<int>(part) : Batches::kWhole,
          {static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(d)},
          {robots.begin() + static_cast<std::ptrdiff_t>(first), robots.begin() + static_cast<std::ptrdiff_t>(behind)}};
      RunCodeOf<ConfigurationError>(
          sensor.actor, ActivityStep::kInit, 0,
          [&] { sensor.batch->Init(setup_of(device, entry->description, SensorStream(device.type), some)); });
      sensor.on_demand = dynamic_cast<OnDemandSensor*>(sensor.batch.get());
      for (std::size_t n = first; n < behind; ++n)
        robots_[robots[n]].interface->AddSensor(device.type, sensor.batch->Sensor(n - first));
      batches_->sensors.push_back(std::move(sensor));
    }
    batches_->split |= parts > 1;
  }
  for (std::size_t d = 0; d < configuration.actuators.size(); ++d)
  {
    const DeviceConfiguration& device = configuration.actuators[d];
    const auto* entry = PluginRegistry<ActuatorBatch>::Instance().Find(device.type, device.implementation);
    if (entry == nullptr) throw unknown(device);
    Batches::Actuator actuator{entry->create(),
                               SliceOf(layout_.commands, entry->description.channel, entities),
                               ActuatorActor(experiment, number, d),
                               &device,
                               entities,
                               robots};
    RunCodeOf<ConfigurationError>(
        actuator.actor, ActivityStep::kInit, 0,
        [&] { actuator.batch->Init(setup_of(device, entry->description, ActuatorStream(device.type), entities)); });
    for (std::size_t n = 0; n < robots.size(); ++n)
      robots_[robots[n]].interface->AddActuator(device.type, actuator.batch->Actuator(n));
    batches_->actuators.push_back(std::move(actuator));
  }
}

void ControllerHost::DescribeController(const Robot& robot, RobotStatus& status) const
{
  if (device_faults_ != nullptr)
    if (const auto* fault = device_faults_->SwitchedOff(static_cast<std::size_t>(&robot - robots_.data())))
    {
      status.state = "off";
      status.text =
          fault == &empty_battery_ ? "its battery is empty" : fmt::format("the fault '{}' switched it off", fault->id);
      return;
    }
  if (robot.IsStopped())
  {
    status.state = "stopped";
    status.text = fmt::format("its controller {} at tick {}", FaultText(robot.guard->kind), robot.guard->failed_at);
    return;
  }
  try
  {
    RunCodeOf(robot.actor, ActivityStep::kStatusText, stepped_tick_,
              [&]
              {
                status.text = robot.controller->StatusText();
                status.state = robot.controller->StateName();
              });
  }
  catch (const ActivityError& error)
  {
    status.text = std::string("its status is unknown: ") + error.what();
  }
}

bool ControllerHost::Describe(std::uint32_t entity, RobotStatus& status) const
{
  const auto place = std::lower_bound(layout_.robots.begin(), layout_.robots.end(), entity);
  if (place == layout_.robots.end() || *place != entity) return false;
  const Robot& robot = robots_[static_cast<std::size_t>(place - layout_.robots.begin())];
  const ControllerConfiguration& configuration =
      *space_.GetExperiment().FindController(space_.GetEntity(entity).GetConfiguration().controller);
  status = {entity, stepped_tick_, configuration.id, {}, {}, {}, {}};
  DescribeController(robot, status);
  for (const DeviceConfiguration& device : configuration.sensors)
  {
    status.sensors.push_back({device.type, {}});
    robot.interface->GetSensor(device.type)->Describe(status.sensors.back().readings);
  }
  for (const DeviceConfiguration& device : configuration.actuators)
  {
    status.actuators.push_back({device.type, {}});
    robot.interface->GetActuator(device.type)->Describe(status.actuators.back().readings);
  }
  return true;
}

void ControllerHost::Destroy()
{
  if (destroyed_) return;
  destroyed_ = true;
  for (Robot& robot : robots_)
  {
    if (robot.controller == nullptr || robot.IsStopped()) continue;
    // The tick is that of the last control step, because the last state may not reach a host.
    const std::uint64_t tick = stepped_tick_;
    robot.interface->BeginStep(
        tick, space_.GetTickSeconds(),
        {space_.GetExperiment().seed, StreamName(robot.interface->GetId()), kDestroyStream, tick});
    RunCodeOf(robot.actor, ActivityStep::kDestroy, tick, [&] { robot.controller->Destroy(); });
  }
}

// The next functions are the tick: sensors, control steps, commands.

void ControllerHost::Sense(std::span<const SensorFrame* const> frames)
{
  const std::uint64_t tick = space_.GetTick();
  if (sensed_tick_ == tick) return;
  sensed_tick_ = tick;
  // Copies the values that the engines sensed.
  const auto take = [&](const ValueCopy& copy)
  {
    const auto source = std::find(layout_.frames_from.begin(), layout_.frames_from.end(), copy.source);
    const SensorFrame& frame = *frames[static_cast<std::size_t>(source - layout_.frames_from.begin())];
    std::copy_n(frame.values.begin() + static_cast<std::ptrdiff_t>(copy.from), copy.count,
                sensor_values_.begin() + static_cast<std::ptrdiff_t>(copy.to));
  };
  if (!frames.empty())
  {
    for (const ValueCopy& copy : layout_.sensor_copies) take(copy);
    for (const RobotCopy& choice : layout_.sensor_choices)
      if (space_.EngineBefore(choice.robot) == choice.copy.source) take(choice.copy);
  }
  UpdateSensors(tick);
  if (device_faults_ != nullptr) device_faults_->ChangeReadings();
  if (battery_reports_ != nullptr) battery_reports_->ReadReceivers();
}

const ControlCommands& ControllerHost::Tick(std::span<const SensorFrame* const> frames)
{
  const std::uint64_t tick = space_.GetTick();
  Due();
  Sense(frames);
  if (device_faults_ != nullptr && device_faults_->SwitchRobots())
  {
    ListSteps();
    if (battery_reports_ != nullptr) LogBatteries();
  }
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
  due_.attributes.pending = nullptr;
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
  failures.assign(pool.Parts(), {});
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
    pool.Run(pool.Parts(), update);
  else
    for (unsigned part = 0; part < pool.Parts(); ++part) update(part);
  // The failure of the first robot is reported, whichever thread was first.
  for (const Batches::Failure& failure : failures)
    if (failure.what != nullptr)
      RunCodeOf(failure.actor, ActivityStep::kUpdate, tick, [&] { std::rethrow_exception(failure.what); });
}

void ControllerHost::CommitActuators()
{
  commands_.attributes.Clear();
  commands_.attributes.pending = ahead_ > 0 ? &due_.attributes : nullptr;
  if (device_faults_ != nullptr) device_faults_->ChangeSettings();
  for (Batches::Actuator& actuator : batches_->actuators)
  {
    const std::size_t first = commands_.attributes.slots.size();
    RunCodeOf(actuator.actor, ActivityStep::kUpdate, stepped_tick_,
              [&] {
                actuator.batch->Commit({commands_.values, actuator.slice.offsets, actuator.slice.width},
                                       commands_.attributes);
              });
    // Commands of channels go to the engines only, so the server would miss these attributes.
    if (actuator.slice.width > 0 && commands_.attributes.slots.size() > first)
      throw ControllerError("actuator '" + actuator.device->type + "' (" + actuator.device->implementation +
                            "): it has a channel, so it must not change attributes");
    CheckAttributesOf(*actuator.device, actuator.robots, first);
  }
  if (device_faults_ != nullptr) device_faults_->RestoreSettings();
  if (!silence_.robots.empty()) SilenceStopped();
  if (battery_reports_ != nullptr)
    battery_reports_->Report(commands_.values, device_faults_.get(), commands_.attributes);
  batches_->order.Apply(commands_.attributes);
  CheckCommands();
}

// Checks the attributes that a device has just added, from `first` on.
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
  // Several devices may share a channel. The last one that sets a value has set it.
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

// Controllers that may step in parallel come first, with any number of threads, and controllers with a guard come last.
void ControllerHost::RunControllers(std::uint64_t tick)
{
  if (IfItShares(batches_->pool) != nullptr && parallel_.size() > 1)
    StepInParallel(tick);
  else
    StepInTurn(parallel_, tick);
  StepInTurn(in_turn_, tick);
  if (!batches_of_robots_.empty()) StepBatches(tick);
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
  const std::size_t parts = batches_->pool->Parts();
  batches_->StepInThreads(parts, tick,
                          [&](std::size_t k, SharedActivity::Thread& of_thread)
                          {
                            const std::size_t begin = parallel_.size() * k / parts;
                            const std::size_t end = parallel_.size() * (k + 1) / parts;
                            ControlSteps(std::span(parallel_).subspan(begin, end - begin), tick, of_thread);
                          });
}

template <class ActivityOfThread>
void ControllerHost::ControlSteps(std::span<const std::uint32_t> robots, std::uint64_t tick, ActivityOfThread& activity)
{
  const Actor* running = nullptr;
  const std::uint64_t stream_tick = space_.StreamTick();
  const bool all_are_present = space_.Absent().empty();
  try
  {
    for (const std::uint32_t k : robots)
    {
      Robot& robot = robots_[k];
      if (!all_are_present && !space_.IsPresent(robot.entity)) continue;
      robot.interface->BeginControlStep(tick, stream_tick);
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

void ControllerHost::StepBatches(std::uint64_t tick)
{
  for (std::vector<BatchOfRobots>& parts : batches_of_robots_)
  {
    if (parts.size() == 1 || IfItShares(batches_->pool) == nullptr)
    {
      Activity activity(robots_[parts.front().robots.front()].actor, ActivityStep::kControlStep, tick);
      for (BatchOfRobots& part : parts) StepBatch(part, tick, activity);
      continue;
    }
    batches_->StepInThreads(parts.size(), tick,
                            [&](std::size_t k, SharedActivity::Thread& of_thread)
                            { StepBatch(parts[k], tick, of_thread); });
  }
}

template <class ActivityOfThread>
void ControllerHost::StepBatch(BatchOfRobots& robots, std::uint64_t tick, ActivityOfThread& activity)
{
  CCI_Batch& batch = robots.batch;
  const std::uint64_t stream_tick = space_.StreamTick();
  const bool all_are_present = space_.Absent().empty();
  if (all_are_present && batch.Size() == robots.robots.size())
  {
    // The batch has them from the last tick.
    for (std::size_t k = 0; k < batch.Size(); ++k) batch.Robot(k).BeginControlStep(tick, stream_tick);
  }
  else
  {
    batch.Clear();
    for (const std::uint32_t k : robots.robots)
    {
      const Robot& robot = robots_[k];
      if (!all_are_present && !space_.IsPresent(robot.entity)) continue;
      robot.interface->BeginControlStep(tick, stream_tick);
      batch.Add(*robot.controller);
    }
  }
  batch.Begin();
  if (batch.Size() == 0) return;
  const auto actor_of = [&](std::size_t place) -> const Actor&
  {
    const auto is_it = [&](std::uint32_t k) { return robots_[k].interface.get() == &batch.Robot(place); };
    return robots_[*std::ranges::find_if(robots.robots, is_it)].actor;
  };
  activity.Next(actor_of(0));
  try
  {
    batch.Of<CCI_BatchController>(0).ControlSteps(batch);
    batch.SetCommands();
  }
  catch (...)
  {
    RethrowFor(actor_of(batch.FailedRobot()), ActivityStep::kControlStep, tick);
  }
}

// The next functions run controllers that may fail or have a time budget (docs/recovery.md).

void ControllerHost::StepGuarded(std::uint64_t tick)
{
  Clear(commands_.faults);
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
  // After an exception, devices must be as before the step, since a replaced process would not have run it either.
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
  Add(commands_.faults, robot.entity, kind, ShowableLine(thrown, kLongestFault));
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
  std::ranges::sort(silence_.slots);  // ReportChanges takes ascending slots
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
  ReportChanges(silence_.slots, std::vector<double>(silence_.slots.size()), space_.Attributes(), changes);
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

// The next functions save and load the state of controllers and devices robot by robot, so that another number of hosts
// can continue.

// Changes of entities other than the robots belong to the first robot.
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
  Add(commands_.faults, entity, bytes.Get<FaultKind>(), "");
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
  if (device_faults_ != nullptr) device_faults_->SaveState(of_robot);
  for (std::size_t k = 0; k < robots_.size(); ++k)
    all.robots[robots_[k].entity].assign(of_robot[k].Bytes().begin(), of_robot[k].Bytes().end());
  WriteFields(state, all);
}

void ControllerHost::LoadState(ByteReader& state)
{
  sensed_tick_.reset();
  due_tick_.reset();
  silence_ = {};
  commands_.attributes.Clear();
  Clear(commands_.faults);
  const auto all = ReadFields<HostState>(state);
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
  if (device_faults_ != nullptr) device_faults_->LoadState(of_robot);
  batches_->order.Apply(commands_.attributes);
  for (const ByteReader& bytes : of_robot)
    if (!bytes.AtEnd()) throw std::runtime_error("saved state: what a robot saved is longer than what it loads");
}

}  // namespace swarmanoid
