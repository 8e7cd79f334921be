// The experiment as read from its XML file: plain values, checked and complete. Every role builds its part of the world
// from it, so equal files give equal worlds. Immutable after loading.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/configuration/configuration_tree.h"
#include "common/experiment/entity_kind.h"

namespace swarmanoid
{

struct ConvexHull;  // common/mesh/convex_hull.h

// One <footbot_proximity><implementation>…</implementation>…</footbot_proximity> entry of a controller.
struct DeviceConfiguration
{
  std::string type;
  std::string implementation;
  TConfigurationTree tree;  // the element of the device: its parameters
};

// One entry of <entity_kinds>: a kind that a user's library adds to the table.
struct EntityKindConfiguration
{
  std::string tag;
  std::string library;
};

// What comes of a robot whose controller throws, crashes, or takes longer than it may.
enum class OnFailure : std::uint8_t
{
  kAbort,      // the run ends with an error that names it
  kStopRobot,  // the robot stands still and is dark from then on
  kRestart     // the controller is made anew, with the state that it had last at a canonical tick
};

// One entry of <controllers>.
struct ControllerConfiguration
{
  std::string tag;  // the label that the controller class registered
  std::string id;
  std::string library;
  std::vector<DeviceConfiguration> actuators;
  std::vector<DeviceConfiguration> sensors;
  // <parameters>, given to CCI_Controller::Init: with all defaults if the controller declared them.
  TConfigurationTree parameters;
  OnFailure on_failure = OnFailure::kAbort;
  double time_budget_ms = 0;  // of processor time, for one control step; 0: any
  SourceLocation location;

  // Whether the run goes on if it fails.
  bool MayFail() const { return on_failure != OnFailure::kAbort; }
  bool IsGuarded() const { return MayFail() || time_budget_ms > 0; }
};

// One entity of the arena; those of a <distribute> are expanded.
struct EntityConfiguration
{
  EntityKind kind = EntityKind::kBlock;
  std::string id;
  Pose pose;
  std::string controller;  // robots: the id of the controller; empty for none
  // The size of the body in metres. Boxes (blocks, walls, handbots): x, y, z. Cylinders (preys, footbots, eyebots):
  // radius, radius, height. Areas of the floor: x, y, 0 of a rectangle or radius, 0, 0 of a disc. Zero for what has no
  // body.
  Vector3 size = Vector3::Zero();
  // What collides instead of the body of this size, which is the box about it; in the frame of the entity.
  std::shared_ptr<const ConvexHull> hull{};
  double mass_kg = 0;    // 0: the default of the kind
  bool movable = false;  // robots and preys always; blocks only if asked
  std::uint32_t colour = 0xc0c0c0;
  double intensity = 1;     // lights and sounds
  std::string reserve;      // the id of the <reserve> that it is of; empty for none
  bool waits = false;       // it is not in the arena at the start
  TConfigurationTree tree;  // the element it came from
  SourceLocation location;
};

// Into how many regions an engine's world is cut, each of which a process of its own computes.
struct EngineSplit
{
  static constexpr unsigned kMostRegions = 32;

  unsigned regions = 1;
  unsigned columns = 0;  // of a grid of regions; 0: cut as it comes

  // "4", "2x2" (columns x rows); nullopt for anything else.
  static std::optional<EngineSplit> Parse(std::string_view text);
};

struct EngineConfiguration
{
  std::string tag;
  std::string id;
  int subclock = 1;  // steps of the engine in each clock tick
  EngineSplit split{};
  TConfigurationTree tree;
  std::vector<std::uint32_t> entities;  // indices into Experiment::entities, ascending
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

// What happens to an entity that physics takes farther from the arena than the limit.
enum class BeyondLimit : std::uint8_t
{
  kStop,   // the run ends with an error that names it
  kHold,   // it is put back to where it was one tick before, at rest
  kRemove  // it leaves the arena, as by SpaceEditor::RemoveEntity
};

// One entry of <experiment_functions>.
struct FunctionsConfiguration
{
  std::string tag;
  std::string id;
  TConfigurationTree tree;  // with the defaults of all parameters
  SourceLocation location;
};

struct Experiment
{
  std::string name;    // the file's name without folder and extension, unless <framework><name> says otherwise
  std::string folder;  // of the experiment file: relative paths start here
  std::uint32_t clock_tick_ms = 100;
  std::uint64_t max_clock = 0;  // ticks; 0: until stopped
  std::uint64_t seed = 1;
  std::uint32_t canonical_period = 100;  // ticks between two canonicalisations of every engine
  std::uint32_t ahead = 0;               // ticks from a control step to the one in which its commands act
  std::vector<std::string> controller_path;
  std::vector<std::string> plugin_path;
  Vector3 arena_size = Vector3::Zero();
  SpaceOptimization optimization = SpaceOptimization::k2D;
  double limit_m = 1e4;  // how far outside the arena an entity may be, along each axis
  BeyondLimit beyond_limit = BeyondLimit::kStop;
  std::vector<EntityKindConfiguration> entity_kinds;
  std::vector<ControllerConfiguration> controllers;
  std::vector<EntityConfiguration> entities;
  std::vector<EngineConfiguration> engines;
  std::vector<RenderConfiguration> visualisations;
  std::vector<FunctionsConfiguration> functions;
  std::string effective_xml;  // the text that gives this experiment again, --set and --seed applied

  double TickSeconds() const { return clock_tick_ms * 1e-3; }
  const ControllerConfiguration* FindController(const std::string& id) const;
  // Whether some controller IsGuarded.
  bool HasGuards() const;
};

// The limit if the file gives none: ten times the longest side of the arena, and at least 100 m.
double UsualLimit(const Vector3& arena_size);
// Where an entity stands that is not in the arena: some 100 km away and at a place of its own, so that engines that
// know nothing of absence let it touch nothing.
Pose WaitingPose(const EntityConfiguration& entity, std::size_t index);

}  // namespace swarmanoid
