// Experiments that a test makes without a file, entity by entity.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/experiment/entity_kind.h"
#include "common/experiment/experiment.h"
#include "common/math/elementary.h"

namespace swarmanoid::test
{

using TestParameters = std::vector<std::pair<std::string, std::string>>;

// Returns the element of a plug-in with these parameters.
inline TConfigurationTree TreeOf(const TestParameters& parameters)
{
  auto element = std::make_shared<ConfigurationNode>();
  for (const auto& [name, value] : parameters) element->attributes.push_back({name, value, {}});
  return TConfigurationTree(element);
}

// Returns <terrain><MAP …/></terrain>.
inline TConfigurationTree TerrainTree(const std::string& map, const TestParameters& attributes)
{
  auto source = std::make_shared<ConfigurationNode>();
  source->name = map;
  for (const auto& [name, value] : attributes) source->attributes.push_back({name, value, {}});
  auto terrain = std::make_shared<ConfigurationNode>();
  terrain->children.push_back(source);
  return TConfigurationTree(terrain);
}

// Returns an entity. Robots have the size of their kind. Robots and preys can move. `yaw` is in radians.
inline EntityConfiguration Entity(EntityKind kind, const std::string& id, const Vector3& position = Vector3::Zero(),
                                  double yaw = 0)
{
  EntityConfiguration entity;
  entity.kind = kind;
  entity.id = id;
  entity.pose = {position, QuaternionFromYaw(yaw)};
  entity.movable = IsRobot(kind) || kind == EntityKind::kCylindricPrey;
  if (IsRobot(kind)) entity.size = DescriptionOf(kind).size;
  return entity;
}
inline EntityConfiguration Entity(EntityKind kind, const std::string& id, const Vector3& position, const Vector3& size,
                                  bool movable)
{
  EntityConfiguration entity = Entity(kind, id, position);
  entity.size = size;
  entity.movable = movable;
  return entity;
}

// Adds an entity to an experiment and to one of its engines (made if it has none), or to no engine if that is -1.
// Returns its number.
inline std::uint32_t Add(Experiment& experiment, EntityConfiguration entity, int engine = 0)
{
  const auto number = static_cast<std::uint32_t>(experiment.entities.size());
  experiment.entities.push_back(std::move(entity));
  if (engine < 0) return number;
  if (experiment.engines.empty()) experiment.engines.resize(1);
  experiment.engines[static_cast<std::size_t>(engine)].entities.push_back(number);
  return number;
}

// Returns a device, which is named by its implementation. The type is the implementation without its first word.
inline DeviceConfiguration Device(const std::string& implementation)
{
  DeviceConfiguration device;
  device.type = implementation.substr(implementation.find('_') + 1);
  device.implementation = implementation;
  return device;
}

inline ControllerConfiguration& AddController(Experiment& experiment, const std::string& tag, const std::string& id,
                                              const std::vector<std::string>& actuators = {},
                                              const std::vector<std::string>& sensors = {})
{
  ControllerConfiguration& controller = experiment.controllers.emplace_back();
  controller.tag = tag;
  controller.id = id;
  for (const std::string& device : actuators) controller.actuators.push_back(Device(device));
  for (const std::string& device : sensors) controller.sensors.push_back(Device(device));
  return controller;
}

// Returns an experiment with robots a metre apart, with a controller "c", in an arena of 10 m.
inline Experiment RobotsOf(const std::string& controller_tag, const std::vector<std::string>& ids,
                           const std::vector<std::string>& actuators = {}, const std::vector<std::string>& sensors = {},
                           EntityKind kind = EntityKind::kFootbot)
{
  Experiment experiment;
  experiment.arena_size = {10, 10, 2};
  AddController(experiment, controller_tag, "c", actuators, sensors);
  for (const std::string& id : ids)
  {
    EntityConfiguration robot = Entity(kind, id, {1.0 + static_cast<double>(experiment.entities.size()), 1, 0});
    robot.controller = "c";
    Add(experiment, robot);
  }
  return experiment;
}

}  // namespace swarmanoid::test
