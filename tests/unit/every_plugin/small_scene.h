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

// The position of the robot of a scene, and the positions beside it (m).
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
  std::string functions{};  // the elements in <experiment_functions>
  std::string renderers{};  // the elements in <visualisations>
  std::string framework{};  // the elements in <framework>
  std::string faults{};     // the elements in <faults>
  std::string controller = kProbe;
  std::uint64_t ticks = kTicks;
};

// Registers all plug-ins of the simulator, and the controllers, kinds of entities and functions that it ships.
void RegisterEverything();

// Returns all kinds except terrain, whose element has no position.
std::vector<EntityKind> AllKinds();
std::vector<EntityKind> AllRobots();

// Returns all engines except the older name of kinematics2d.
std::vector<const PluginDescription*> AllEngines();
bool Simulates(const PluginDescription& engine, EntityKind kind);
// Returns all devices that a robot can have in an engine, one implementation of each at a time: the first
// implementation of all devices, then the second one of all devices that have it, and so on.
std::vector<Devices> DeviceSets(EntityKind robot, const PluginDescription& engine);

// Returns <device implementation="…"/>. Fails the test if the table has no default for a parameter.
std::string DeviceElement(const PluginDescription& device);
// Returns the element of an entity on the floor at x, y. Fails the test for a kind whose table has no default for a
// parameter.
std::string EntityElement(EntityKind kind, const std::string& id, double x, double y,
                          const std::string& controller = "");
// Returns the height of an entity's position above the floor on which it stands, m.
double HeightOf(EntityKind kind);
// Returns a <reserve> with one entity of a kind.
std::string Waiting(EntityKind kind, const std::string& id, const std::string& controller = "");
// Returns the distance (m) between the middles of an entity and of the robot if 8 cm are between them.
double NearDistance(EntityKind robot, EntityKind other);

std::unique_ptr<Experiment> Read(const SmallScene& scene);
// Runs a scene to its end and returns the hash of its last state. `change` is called before each tick. Mistakes in the
// readings and columns of the probes fail the test.
std::uint64_t RunScene(const Experiment& experiment, const SimulatorOptions& options = {},
                       const std::function<void(CSimulator&)>& change = {});
std::uint64_t RunScene(const SmallScene& scene, const std::function<void(CSimulator&)>& change = {});

}  // namespace swarmanoid
