// The smallest experiments, made from the tables of plug-ins and kinds, and run in this process.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/experiment/entity_kind.h"
#include "common/plugins/catalogue.h"
#include "simulation/simulator.h"

namespace swarmanoid
{

// Where the robot of a scene stands, and the places beside it (m).
inline constexpr double kArena_m = 20, kRobotX_m = 4, kRobotY_m = 4, kFarX_m = 16;
inline constexpr std::uint64_t kTicks = 8;
inline constexpr const char* kProbe = "simplest_scenes_probe";

// The devices of a controller.
struct Devices
{
  std::vector<const PluginDescription*> sensors, actuators;
};

struct SmallScene
{
  std::string engine = "kinematics2d";
  Devices devices;
  std::string arena;        // the elements in <arena>
  std::string functions{};  // in <experiment_functions>
  std::string renderers{};  // in <visualisations>
  std::string framework{};  // in <framework>
  std::string controller = kProbe;
  std::uint64_t ticks = kTicks;
};

// Registers all plug-ins of the simulator, and the controllers, kinds of entities and functions that it ships.
void RegisterEverything();

// Kinds, without terrain, which is no element with a position.
std::vector<EntityKind> AllKinds();
std::vector<EntityKind> AllRobots();

// All but the older name of kinematics2d.
std::vector<const PluginDescription*> AllEngines();
bool Simulates(const PluginDescription& engine, EntityKind kind);
// All devices that a robot can have in an engine, one implementation of each at a time: the first of all, the second
// of those that have one, and so on.
std::vector<Devices> DeviceSets(EntityKind robot, const PluginDescription& engine);

// <device implementation="…"/>. Fails the test if the table has no default for a parameter.
std::string DeviceElement(const PluginDescription& device);
// The element of an entity that stands on the floor at x, y. Fails the test for a kind whose table has no default for a
// parameter.
std::string EntityElement(EntityKind kind, const std::string& id, double x, double y,
                          const std::string& controller = "");
// Where the position of an entity is above the floor that it stands on, m.
double HeightOf(EntityKind kind);
// A <reserve> of one of a kind.
std::string Waiting(EntityKind kind, const std::string& id, const std::string& controller = "");
// How far the middle of an entity is from the robot's if 8 cm are between them, m.
double NearDistance(EntityKind robot, EntityKind other);

std::unique_ptr<Experiment> Read(const SmallScene& scene);
// Runs it to its end and returns the hash of its last state. `change` is called before each tick. The readings and
// columns of the probes are checked; what is wrong with them fails the test.
std::uint64_t RunScene(const Experiment& experiment, const SimulatorOptions& options = {},
                       const std::function<void(CSimulator&)>& change = {});
std::uint64_t RunScene(const SmallScene& scene, const std::function<void(CSimulator&)>& change = {});

}  // namespace swarmanoid
