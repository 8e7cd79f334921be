#include "controller_host/controller_host.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "common/space/attribute_changes.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint32_t kControllerStream = StreamName("controller");

// The slice of a host's channel values that belongs to the robots of one batch.
struct ChannelSlice
{
  std::vector<std::size_t> offsets;  // of each robot within the values of the message
  int width = 0;
};

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

}  // namespace

struct ControllerHost::Batches
{
  struct Sensor
  {
    std::unique_ptr<SensorBatch> batch;
    ChannelSlice slice;
  };
  struct Actuator
  {
    std::unique_ptr<ActuatorBatch> batch;
    ChannelSlice slice;
  };
  std::vector<Sensor> sensors;
  std::vector<Actuator> actuators;
  AttributeOrder order;
};

ControllerHost::ControllerHost(const CSwarmanoidSpace& space, const Assignment& assignment, std::size_t host)
    : space_(space), layout_(assignment.hosts[host]), batches_(std::make_unique<Batches>())
{
  const Experiment& experiment = space.GetExperiment();
  commands_.host = static_cast<std::uint32_t>(host);
  commands_.values.resize(layout_.command_size);
  sensor_values_.resize(layout_.sensor_size);

  std::vector<std::vector<std::size_t>> robots_of(experiment.controllers.size());
  robots_.resize(layout_.robots.size());
  for (std::size_t k = 0; k < robots_.size(); ++k)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(layout_.robots[k]);
    const ControllerConfiguration* configuration = experiment.FindController(entity.GetConfiguration().controller);
    robots_of[static_cast<std::size_t>(configuration - experiment.controllers.data())].push_back(k);
    robots_[k].entity = layout_.robots[k];
    robots_[k].interface = std::make_unique<CCI_Robot>(entity.GetId(), std::string(TagName(entity.GetKind())));
  }

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
                                 RandomStream(experiment.seed, robot.entity, kControllerStream, 0));
      robot.controller = entry->create();
      robot.controller->SetRobot(robot.interface.get());
    }
  }

  // Init in entity order, whatever the controllers.
  for (Robot& robot : robots_)
  {
    const std::string& id = robot.interface->GetId();
    const ControllerConfiguration& configuration =
        *experiment.FindController(space.GetEntity(robot.entity).GetConfiguration().controller);
    running_robot_ = id.c_str();
    int result = CCI_Controller::RETURN_OK;
    try
    {
      result = robot.controller->Init(configuration.parameters);
    }
    catch (const std::exception& error)
    {
      throw ControllerError("robot '" + id + "': Init of controller '" + configuration.id +
                            "' failed: " + error.what());
    }
    if (result != CCI_Controller::RETURN_OK)
      throw ControllerError("robot '" + id + "': Init of controller '" + configuration.id + "' returned " +
                            std::to_string(result));
  }
  running_robot_ = "";
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

  const auto setup_of = [&](const DeviceConfiguration& device, const PluginDescription& description) {
    return DeviceSetup{Parameters(device.tree, description.parameters), space_, entities, StreamName(device.type)};
  };
  const auto unknown = [&](const DeviceConfiguration& device)
  {
    return ConfigurationError(device.tree.Location(), "no implementation '" + device.implementation + "' of <" +
                                                          device.type + "> is registered");
  };

  for (const DeviceConfiguration& device : configuration.sensors)
  {
    const auto* entry = PluginRegistry<SensorBatch>::Instance().Find(device.type, device.implementation);
    if (entry == nullptr) throw unknown(device);
    Batches::Sensor sensor{entry->create(), SliceOf(layout_.sensors, entry->description.channel, entities)};
    sensor.batch->Init(setup_of(device, entry->description));
    for (std::size_t n = 0; n < robots.size(); ++n)
      robots_[robots[n]].interface->AddSensor(device.type, sensor.batch->Sensor(n));
    batches_->sensors.push_back(std::move(sensor));
  }
  for (const DeviceConfiguration& device : configuration.actuators)
  {
    const auto* entry = PluginRegistry<ActuatorBatch>::Instance().Find(device.type, device.implementation);
    if (entry == nullptr) throw unknown(device);
    Batches::Actuator actuator{entry->create(), SliceOf(layout_.commands, entry->description.channel, entities)};
    actuator.batch->Init(setup_of(device, entry->description));
    for (std::size_t n = 0; n < robots.size(); ++n)
      robots_[robots[n]].interface->AddActuator(device.type, actuator.batch->Actuator(n));
    batches_->actuators.push_back(std::move(actuator));
  }
}

const ControlCommands& ControllerHost::Step(std::span<const SensorFrame* const> frames)
{
  const std::uint64_t tick = space_.GetTick();
  const std::uint64_t seed = space_.GetExperiment().seed;

  // What the engines sensed.
  if (!frames.empty())
    for (const ValueCopy& copy : layout_.sensor_copies)
    {
      const auto source = std::find(layout_.frames_from.begin(), layout_.frames_from.end(), copy.source);
      const SensorFrame& frame = *frames[static_cast<std::size_t>(source - layout_.frames_from.begin())];
      std::copy_n(frame.values.begin() + static_cast<std::ptrdiff_t>(copy.from), copy.count,
                  sensor_values_.begin() + static_cast<std::ptrdiff_t>(copy.to));
    }
  for (Batches::Sensor& sensor : batches_->sensors)
    sensor.batch->Update({sensor_values_, sensor.slice.offsets, sensor.slice.width});

  for (Robot& robot : robots_)
  {
    if (!space_.IsPresent(robot.entity)) continue;
    robot.interface->BeginStep(tick, space_.GetTickSeconds(),
                               RandomStream(seed, robot.entity, kControllerStream, static_cast<std::uint32_t>(tick)));
    running_robot_ = robot.interface->GetId().c_str();
    try
    {
      robot.controller->ControlStep();
    }
    catch (const std::exception& error)
    {
      throw ControllerError("robot '" + robot.interface->GetId() + "': ControlStep at tick " + std::to_string(tick) +
                            " failed: " + error.what());
    }
  }
  running_robot_ = "";

  commands_.tick = tick;
  commands_.attributes.Clear();
  for (Batches::Actuator& actuator : batches_->actuators)
    actuator.batch->Commit({commands_.values, actuator.slice.offsets, actuator.slice.width}, commands_.attributes);
  batches_->order.Apply(commands_.attributes);
  StillAbsent();
  return commands_;
}

bool ControllerHost::Describe(std::uint32_t entity, RobotStatus& status) const
{
  const auto place = std::lower_bound(layout_.robots.begin(), layout_.robots.end(), entity);
  if (place == layout_.robots.end() || *place != entity) return false;
  const Robot& robot = robots_[static_cast<std::size_t>(place - layout_.robots.begin())];
  const ControllerConfiguration& configuration =
      *space_.GetExperiment().FindController(space_.GetEntity(entity).GetConfiguration().controller);
  status = {entity, commands_.tick, configuration.id, {}, {}, {}, {}};
  try
  {
    status.text = robot.controller->StatusText();
    status.state = robot.controller->StateName();
  }
  catch (const std::exception& error)
  {
    status.text = std::string("its status is unknown: ") + error.what();
  }
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

// Robots that are not in the arena do nothing, whatever they were told last.
void ControllerHost::StillAbsent()
{
  for (const ChannelBlock& block : layout_.commands)
    for (std::size_t k = 0; k < block.entities.size(); ++k)
      if (!space_.IsPresent(block.entities[k]))
        std::fill_n(commands_.values.begin() + static_cast<std::ptrdiff_t>(block.offset + k * block.width), block.width,
                    0.0);
}

void ControllerHost::SaveState(ByteWriter& state) const
{
  for (const Robot& robot : robots_)
  {
    if (!robot.controller->HasState())
      throw ControllerError("robot '" + robot.interface->GetId() +
                            "': its controller cannot be saved; it must override HasState, " +
                            "SaveState and LoadState");
    std::ostringstream text;
    robot.controller->SaveState(text);
    state.PutText(text.str());
  }
  for (const Batches::Sensor& sensor : batches_->sensors) sensor.batch->SaveState(state);
  for (const Batches::Actuator& actuator : batches_->actuators) actuator.batch->SaveState(state);
}

void ControllerHost::LoadState(ByteReader& state)
{
  for (Robot& robot : robots_)
  {
    std::istringstream text(state.GetText());
    robot.controller->LoadState(text);
  }
  for (Batches::Sensor& sensor : batches_->sensors) sensor.batch->LoadState(state);
  for (Batches::Actuator& actuator : batches_->actuators) actuator.batch->LoadState(state);
}

void ControllerHost::Destroy()
{
  if (destroyed_) return;
  destroyed_ = true;
  for (Robot& robot : robots_)
  {
    if (robot.controller == nullptr) continue;
    try
    {
      robot.controller->Destroy();
    }
    catch (const std::exception& error)
    {
      throw ControllerError("robot '" + robot.interface->GetId() + "': Destroy failed: " + error.what());
    }
  }
}

}  // namespace swarmanoid
