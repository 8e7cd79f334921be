#include "controller_host/controller_host.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "common/control_interface/init_controller.h"
#include "common/experiment/actors.h"
#include "common/logging/log.h"
#include "common/space/collision_models.h"
#include "common/space/shape.h"
#include "common/space/space.h"
#include "controller_host/batches.h"
#include "controller_host/split_sensor.h"

namespace swarmanoid
{
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

// In how many parts a sensor of so many robots is split: each costs a little by itself.
std::size_t PartsOf(std::size_t robots, unsigned threads)
{
  constexpr std::size_t kLeast = 400;  // robots of a part
  return std::clamp<std::size_t>(robots / kLeast, 1, threads);
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

  // Init in entity order, whatever the controllers.
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

  for (std::uint32_t k = 0; k < robots_.size(); ++k)
    if (robots_[k].guard != nullptr)
      guarded_.push_back(k);
    else
      (robots_[k].controller->StepsInParallel() ? parallel_ : in_turn_).push_back(k);
  SaveLastStates(0);
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
    // Already reported by whoever called Destroy first, or the run has failed before.
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
    const std::size_t parts =
        may_split && batches_->pool != nullptr ? PartsOf(entities.size(), batches_->pool->Threads()) : 1;
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
    // Of the last control step: whether the last state still reaches a host depends on how it is started.
    const std::uint64_t tick = stepped_tick_;
    robot.interface->BeginStep(
        tick, space_.GetTickSeconds(),
        {space_.GetExperiment().seed, StreamName(robot.interface->GetId()), kDestroyStream, tick});
    RunCodeOf(robot.actor, ActivityStep::kDestroy, tick, [&] { robot.controller->Destroy(); });
  }
}

}  // namespace swarmanoid
