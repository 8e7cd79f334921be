// The experiment as read from its XML file: plain values, checked and complete. Every role builds its part of the world
// from it, so equal files give equal worlds. Immutable after loading.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/configuration/configuration_tree.h"
#include "common/experiment/engine_volumes.h"
#include "common/experiment/entity_kind.h"

namespace swarmanoid
{

struct ConvexHull;  // common/mesh/convex_hull.h

// It holds one entry of a controller: <footbot_proximity><implementation>…</implementation>…</footbot_proximity>.
struct DeviceConfiguration
{
  std::string type;
  std::string implementation;
  TConfigurationTree tree;  // the element of the device: its parameters
};

// It holds one entry of <entity_kinds>: a kind that a user's library adds to the table.
struct EntityKindConfiguration
{
  std::string tag;
  std::string library;
};

// The reaction to a controller that throws, crashes, or exceeds its time budget.
enum class OnFailure : std::uint8_t
{
  kAbort,      // the run ends with an error that names the robot
  kStopRobot,  // the robot stands still and is dark from then on
  kRestart     // the controller is made again, with its state of the last canonical tick
};

// One entry of <controllers>.
struct ControllerConfiguration
{
  std::string tag;  // the label that the controller class registered
  std::string id;
  std::string library;
  std::vector<DeviceConfiguration> actuators;
  std::vector<DeviceConfiguration> sensors;
  // The <parameters> element, given to CCI_Controller::Init. It has all defaults if the controller declared its
  // parameters.
  TConfigurationTree parameters;
  OnFailure on_failure = OnFailure::kAbort;
  double time_budget_ms = 0;  // processor time for one control step; 0: unlimited
  SourceLocation location;

  // Returns whether the run continues after a failure of this controller.
  bool MayFail() const { return on_failure != OnFailure::kAbort; }
  bool IsGuarded() const { return MayFail() || time_budget_ms > 0; }
};

// It holds one entity of the arena. Each entity of a <distribute> has its own.
struct EntityConfiguration
{
  EntityKind kind = EntityKind::kBlock;
  std::string id;
  Pose pose;
  std::string controller;  // the id of the controller of a robot; empty for none
  // The size of the body is in metres. Boxes (blocks, walls, handbots) have x, y, z. Cylinders (preys, footbots,
  // eyebots) have radius, radius, height. Areas of the floor have x, y, 0 for a rectangle, or radius, 0, 0 for a disc.
  // It is zero for entities without a body.
  Vector3 size = Vector3::Zero();
  // This convex hull collides instead of the body, in the frame of the entity. The body of `size` is the box around it.
  std::shared_ptr<const ConvexHull> hull{};
  double mass_kg = 0;    // 0: the default of the kind
  bool movable = false;  // always true for robots and preys; for blocks only if requested
  std::uint32_t colour = 0xc0c0c0;
  double intensity = 1;     // for lights and sounds
  std::string reserve;      // the id of the entity's <reserve>; empty for none
  bool waits = false;       // it is not in the arena at the start
  TConfigurationTree tree;  // the element that defines the entity
  SourceLocation location;
};

// The number of regions into which an engine's world is cut. A separate process computes each region.
struct EngineSplit
{
  static constexpr unsigned kMostRegions = 32;

  unsigned regions = 1;
  unsigned columns = 0;  // columns of a grid of regions; 0: the engine chooses the cut

  // Reads "4" or "2x2" (columns x rows); nullopt for any other text.
  static std::optional<EngineSplit> Parse(std::string_view text);
};

struct EngineConfiguration
{
  std::string tag;
  std::string id;
  int subclock = 1;  // steps of the engine in each clock tick
  EngineSplit split{};
  TConfigurationTree tree;
  std::vector<std::uint32_t> entities;  // indices into Experiment::entities, in ascending order
  EngineVolume volume{};                // an entity that leaves it is handed over to another engine
  SourceLocation location;
};

struct RenderConfiguration
{
  std::string tag;
  std::string id;
  TConfigurationTree tree;
  SourceLocation location;
};

enum class SpaceOptimization : std::uint8_t
{
  k2D,
  k3D,
  kOctree
};

// The reaction to an entity that physics moves farther from the arena than the limit.
enum class BeyondLimit : std::uint8_t
{
  kStop,   // the run ends with an error that names the entity
  kHold,   // the entity is put back to its pose of the tick before, at rest
  kRemove  // the entity leaves the arena, as by SpaceEditor::RemoveEntity
};

// The reaction to an entity that leaves the volumes of all engines that can move it.
enum class OutsideVolumes : std::uint8_t
{
  kStop,  // the run ends with an error that names the entity
  kKeep   // its engine keeps it
};

// One entry of <experiment_functions>.
struct FunctionsConfiguration
{
  std::string tag;
  std::string id;
  TConfigurationTree tree;  // with the defaults of all parameters
  SourceLocation location;
};

// How a fault changes the values of a device.
enum class DeviceFaultKind : std::uint8_t
{
  kDead,   // readings and settings are 0, and lists are empty
  kStuck,  // they stay as they were in the first tick of the fault
  kScale,  // times `value`
  kBias,   // plus `value`
  kNoise,  // plus a normal number with the deviation `value`
  kDelay,  // `value` ticks late
  kDrop,   // lost with the probability `value`: the last ones stay, and entries of lists are missing
  kOff     // the whole robot is switched off: its actuators are dead, and its controller is not called
};

// One entry of <faults>.
struct FaultConfiguration
{
  std::string id;
  DeviceFaultKind kind = DeviceFaultKind::kDead;
  std::string kind_name;
  double value = 0;
  std::string device;  // a tag; empty: all devices of the robots
  bool of_sensors = true;
  bool of_actuators = true;
  std::uint64_t from = 0;               // its first tick
  std::uint64_t to = 0;                 // the first tick after it; 0: it never ends
  std::vector<std::uint32_t> entities;  // its robots, which all have the device, ascending
  SourceLocation location;

  bool IsActive(std::uint64_t tick) const { return tick >= from && (to == 0 || tick < to); }
};

// One <floor_field> of the arena: a number per m² on the floor, which robots write and read (docs/floor_fields.md).
struct FloorFieldConfiguration
{
  std::string id;
  double cell_m = 0.05;             // the edge of a square cell
  std::size_t columns = 0;          // cells along x, from x = 0
  std::size_t rows = 0;             // cells along y, from y = 0
  double evaporation_per_s = 0;     // the share that a second takes, as the rate of an exponential
  double diffusion_m2_per_s = 0;    // its constant
  std::uint32_t period = 1;         // ticks between two steps of evaporation and diffusion
  double least = 1e-6;              // per m²; a step sets smaller values to 0
  std::uint32_t colour = 0x00a050;  // 0xRRGGBB, of pictures
  double full = 0;                  // per m²: pictures show this value opaque; 0: the largest value of the moment
  SourceLocation location;

  std::size_t Cells() const { return columns * rows; }
};

// The <wind> of the arena (docs/flying.md).
struct WindConfiguration
{
  Vector3 velocity_m_s = Vector3::Zero();
  double gusts_m_s = 0;  // the speed of the wind at a height of 6.1 m that scales the gusts; 0: none
  double height_m = 0;   // the height whose gusts blow everywhere

  bool operator==(const WindConfiguration&) const = default;
};

struct Experiment
{
  std::string name;    // the file's name without folder and extension, unless <framework><name> says otherwise
  std::string folder;  // the experiment file's folder, where relative paths start
  std::uint32_t clock_tick_ms = 100;
  std::uint32_t ticks_per_second = 0;  // 0: a tick lasts clock_tick_ms; otherwise it lasts 1/ticks_per_second s
  std::uint64_t max_clock = 0;         // ticks; 0: until stopped
  std::uint64_t seed = 1;
  std::uint32_t canonical_period = 100;  // ticks between two canonicalisations of every engine
  std::uint32_t ahead = 0;               // ticks from a control step to the one in which its commands act
  std::vector<std::string> controller_path;
  std::vector<std::string> plugin_path;
  Vector3 arena_size = Vector3::Zero();
  SpaceOptimization optimization = SpaceOptimization::k2D;
  double limit_m = 1e4;  // the largest distance of an entity outside the arena, along each axis
  BeyondLimit beyond_limit = BeyondLimit::kStop;
  std::vector<EntityKindConfiguration> entity_kinds;
  std::vector<ControllerConfiguration> controllers;
  std::vector<EntityConfiguration> entities;
  std::vector<EngineConfiguration> engines;
  EngineChoices engine_choices;  // from the volumes of the engines
  OutsideVolumes outside_volumes = OutsideVolumes::kStop;
  std::vector<RenderConfiguration> visualisations;
  std::vector<FunctionsConfiguration> functions;
  std::vector<FaultConfiguration> faults;
  std::string effective_xml;  // a text that gives this experiment again, with --set and --seed applied
  std::vector<FloorFieldConfiguration> floor_fields;
  std::optional<WindConfiguration> wind;

  double TickSeconds() const { return ticks_per_second == 0 ? clock_tick_ms * 1e-3 : 1.0 / ticks_per_second; }
  // Returns the controller with that id; nullptr if it does not exist.
  const ControllerConfiguration* FindController(const std::string& id) const;
  // Returns whether some controller has a guard (IsGuarded).
  bool HasGuards() const;
};

// Returns the limit if the file gives none: ten times the longest side of the arena, and at least 100 m.
double UsualLimit(const Vector3& arena_size);
// Returns the pose of an entity that is not in the arena. It is some 100 km away and differs for each entity, so that
// engines without a notion of absence let it touch nothing.
Pose WaitingPose(const EntityConfiguration& entity, std::size_t index);

}  // namespace swarmanoid
