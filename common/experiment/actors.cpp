#include "common/experiment/actors.h"

namespace swarmanoid
{
namespace
{

// A device's number holds the number of its controller and its own number in that controller's list.
constexpr std::uint32_t kDeviceBits = 12;

Actor DeviceActor(Actor::Kind kind, const Experiment& experiment, std::size_t controller, std::size_t device,
                  const std::string& type)
{
  return {kind, static_cast<std::uint32_t>(controller << kDeviceBits | device), type.c_str(),
          experiment.controllers[controller].id.c_str()};
}

template <class Configuration>
Actor ActorIn(Actor::Kind kind, const std::vector<Configuration>& list, std::size_t number)
{
  return {kind, static_cast<std::uint32_t>(number), list[number].id.c_str(), list[number].tag.c_str()};
}

}  // namespace

Actor RobotActor(const Experiment& experiment, std::size_t entity)
{
  const EntityConfiguration& robot = experiment.entities[entity];
  return {Actor::kRobot, static_cast<std::uint32_t>(entity), robot.id.c_str(), robot.controller.c_str()};
}

Actor FunctionsActor(const Experiment& experiment, std::size_t functions)
{
  return ActorIn(Actor::kFunctions, experiment.functions, functions);
}

Actor EngineActor(const Experiment& experiment, std::size_t engine)
{
  return ActorIn(Actor::kEngine, experiment.engines, engine);
}

Actor VisualisationActor(const RenderConfiguration& visualisation, std::size_t number)
{
  return {Actor::kVisualisation, static_cast<std::uint32_t>(number), visualisation.id.c_str(),
          visualisation.tag.c_str()};
}

Actor SensorActor(const Experiment& experiment, std::size_t controller, std::size_t sensor)
{
  return DeviceActor(Actor::kSensor, experiment, controller, sensor,
                     experiment.controllers[controller].sensors[sensor].type);
}

Actor ActuatorActor(const Experiment& experiment, std::size_t controller, std::size_t actuator)
{
  return DeviceActor(Actor::kActuator, experiment, controller, actuator,
                     experiment.controllers[controller].actuators[actuator].type);
}

Actor ActorOf(const Experiment& experiment, Actor::Kind kind, std::uint32_t number)
{
  const std::size_t controller = number >> kDeviceBits;
  const std::size_t device = number & ((1U << kDeviceBits) - 1);
  switch (kind)
  {
    case Actor::kRobot:
      if (number < experiment.entities.size()) return RobotActor(experiment, number);
      break;
    case Actor::kFunctions:
      if (number < experiment.functions.size()) return FunctionsActor(experiment, number);
      break;
    case Actor::kEngine:
      if (number < experiment.engines.size()) return EngineActor(experiment, number);
      break;
    case Actor::kVisualisation:
      if (number < experiment.visualisations.size())
        return VisualisationActor(experiment.visualisations[number], number);
      break;
    case Actor::kSensor:
      if (controller < experiment.controllers.size() && device < experiment.controllers[controller].sensors.size())
        return SensorActor(experiment, controller, device);
      break;
    case Actor::kActuator:
      if (controller < experiment.controllers.size() && device < experiment.controllers[controller].actuators.size())
        return ActuatorActor(experiment, controller, device);
      break;
    case Actor::kWatcher:
      return {Actor::kWatcher};
    case Actor::kNobody:
      break;
  }
  return {};
}

}  // namespace swarmanoid
