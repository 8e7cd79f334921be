#include "common/experiment/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace swarmanoid
{
namespace
{

constexpr double kMostMetres = 1e6;
constexpr double kMostDegrees = 1e5;

ParameterSpec Required(ParameterType type, std::string name, std::string unit, std::string description)
{
  ParameterSpec spec;
  spec.name = std::move(name);
  spec.type = type;
  spec.unit = std::move(unit);
  spec.description = std::move(description);
  return spec;
}

ParameterSpec Optional(ParameterType type, std::string name, std::string unit, std::string default_value,
                       std::string description)
{
  ParameterSpec spec = Required(type, std::move(name), std::move(unit), std::move(description));
  spec.default_value = std::move(default_value);
  return spec;
}

ParameterSpec InRange(ParameterSpec spec, double minimum, double maximum)
{
  spec.minimum = minimum;
  spec.maximum = maximum;
  return spec;
}

ParameterSpec OneOf(ParameterSpec spec, std::vector<std::string> choices)
{
  spec.choices = std::move(choices);
  return spec;
}

ParameterSpec Id(std::string description)
{
  return Required(ParameterType::kText, "id", "", std::move(description) + " Letters, digits and _ . : -");
}

ParameterSpec Place(ParameterSpec spec) { return InRange(std::move(spec), -kMostMetres, kMostMetres); }

// The trigonometric functions lose accuracy with large angles.
ParameterSpec Angles(ParameterSpec spec) { return InRange(std::move(spec), -kMostDegrees, kMostDegrees); }

ParameterSpec Size(ParameterSpec spec) { return InRange(std::move(spec), kLeastSize, kMostMetres); }

ElementSpec Framework()
{
  using enum ParameterType;
  ElementSpec element;
  element.tags = {"framework"};
  element.description = "Settings of the run as a whole. It lasts clocktick times maxclock milliseconds.";
  element.parameters = {
      InRange(Optional(kInteger, "clocktick", "ms", "100",
                       "The simulated time of one clock tick: the robots' control steps run once each tick."),
              1, 3'600'000),
      InRange(Optional(kInteger, "maxclock", "ticks", "0",
                       "The number of clock ticks after which the experiment ends; 0: it runs until it is stopped."),
              0, 1e15),
      Optional(kText, "controller_path", "", "",
               "Folders of controller libraries, separated by colons; a backslash at the end of a line continues it. "
               "Relative ones start at the folder of the experiment."),
      Optional(kText, "plugin_path", "", "",
               "Folders of the libraries of other plug-ins, written like controller_path."),
      InRange(Optional(kInteger, "seed", "", "1",
                       "The seed of all random numbers: the same seed gives the same run, bit by bit."),
              0, 9e18),
      InRange(Optional(kInteger, "canonical_period", "ticks", "100",
                       "Ticks between two moments at which every engine drops what a saved state does not hold; "
                       "checkpoints are possible at these. It is part of the result."),
              1, 1e9),
      Optional(kText, "name", "", "", "The name of the experiment; empty: the name of the file without its extension."),
      Optional(kText, "folder", "", "",
               "The folder at which relative paths start; empty: the folder of the experiment file."),
  };
  return element;
}

ElementSpec DeviceList(const char* tag, PluginKind kind, const char* description)
{
  using enum ParameterType;
  ElementSpec element;
  element.tags = {tag};
  element.description = description;
  element.plugins = kind;
  ElementSpec device;
  device.description = fmt::format(
      "One {}: its tag is the type. Its implementation decides which further parameters it has.", PluginKindName(kind));
  device.parameters = {
      Required(kText, "implementation", "", "The label of the implementation to use."),
      Optional(kText, "library", "", "",
               "The library that registers it, looked for in plugin_path; empty: it is built in."),
  };
  element.plugin_element = {device};
  return element;
}

ElementSpec Controllers()
{
  using enum ParameterType;
  ElementSpec element;
  element.tags = {"controllers"};
  element.description =
      "The controllers of the robots. The same controller may stand here several times with different ids and "
      "parameters.";
  element.plugins = PluginKind::kController;
  ElementSpec controller;
  controller.description = "One controller: its tag is the label under which REGISTER_CONTROLLER made it known.";
  controller.parameters = {
      Id("The name by which robots refer to it; unique among the controllers."),
      Optional(kText, "library", "", "",
               "The library that holds it: x stands for libx.so or x.so in one of the folders of controller_path, or "
               "in .libs "
               "within it. Empty: the program itself holds it."),
      Optional(kTree, "parameters", "", "", "Free content for the controller: it is given to its Init."),
  };
  controller.children = {
      DeviceList("actuators", PluginKind::kActuator, "The actuators that the controller may use; no other ones exist."),
      DeviceList("sensors", PluginKind::kSensor, "The sensors that the controller may use; no other ones exist."),
  };
  element.plugin_element = {controller};
  return element;
}

ElementSpec Entity(EntityKind kind, std::vector<std::string> further_tags, const char* description,
                   std::vector<ParameterSpec> parameters)
{
  using enum ParameterType;
  ElementSpec element;
  element.tags = {std::string(TagName(kind))};
  element.tags.insert(element.tags.end(), further_tags.begin(), further_tags.end());
  element.description = description;
  element.entity = kind;
  element.repeatable = true;
  element.parameters = {
      Id("The name of the entity; unique in the arena."),
      Place(Required(kVector3, "position", "m",
                     "Where it is; within the arena, which reaches from 0, 0, 0 to its size.")),
      Angles(Optional(
          kVector3, "orientation", "degrees", "0, 0, 0",
          "Rotations about the fixed axes x, y and z, in this order. The heading of a robot is the last one.")),
  };
  element.parameters.insert(element.parameters.end(), parameters.begin(), parameters.end());
  return element;
}

ElementSpec Robot(EntityKind kind, const char* description)
{
  return Entity(kind, {}, description,
                {Optional(ParameterType::kText, "controller", "", "",
                          "The id of its controller; empty: it has none and does nothing by itself.")});
}

std::vector<ElementSpec> MakeEntities()
{
  using enum ParameterType;
  const auto mass =
      InRange(Optional(kNumber, "mass", "kg", "0", "Its mass; 0: what the engine takes for its kind."), 0, 1e9);
  const auto contact = [](const char* name, const char* description, double maximum)
  { return InRange(Optional(kNumber, name, "", "", description), 0, maximum); };
  const auto friction =
      contact("friction", "Coulomb coefficient where others touch it; by default that of the engine.", 100);
  const auto restitution =
      contact("restitution",
              "Part of the approach speed that a collision with it gives back; by default that of the engine.", 1);
  const auto ground_friction =
      contact("ground_friction", "Coulomb coefficient of its base on the ground; by default that of the engine.", 100);
  const auto colour = [](const char* value) { return Optional(kColour, "colour", "", value, "Its colour."); };
  const auto intensity =
      InRange(Optional(kNumber, "intensity", "", "1", "Its strength; sensors scale their readings with it."), 0, 1e9);
  const auto box = Size(Required(kVector3, "size", "m", "Its extent along its own axes; the position is its centre."));
  const auto area = Size(Optional(kVector2, "size", "m", "", "The sides of a rectangle around the position."));
  const auto disc =
      Size(Optional(kNumber, "radius", "m", "", "The radius of a disc around the position, instead of a size."));

  std::vector<ElementSpec> entities = {
      Robot(EntityKind::kFootbot, "A footbot: a wheeled robot with a gripper. The position is the centre of its base."),
      Robot(EntityKind::kEyebot, "An eyebot: a flying robot with a camera. The position is the centre of its base."),
      Robot(EntityKind::kHandbot,
            "A handbot: a climbing robot with two hands. The position is the centre of its base."),
      Entity(EntityKind::kBlock, {}, "A brick, for obstacles, furniture and walls.",
             {box, Optional(kBoolean, "movable", "", "false", "Whether physics can move it."), mass, friction,
              restitution, ground_friction, colour("silver")}),
      Entity(EntityKind::kCylindricPrey, {"cyllindric_prej"},
             "A cylinder that robots can grip and carry. The position is the centre of its base.",
             {Size(Optional(kNumber, "radius", "m", "0.1", "The radius of the cylinder.")),
              Size(Optional(kNumber, "height", "m", "0.1", "The height of the cylinder.")), mass, friction, restitution,
              ground_friction, colour("red")}),
      Entity(EntityKind::kLightBulb, {}, "A light. It has no body.", {intensity, colour("yellow")}),
      Entity(EntityKind::kSoundSource, {}, "A source of sound. It has no body.", {intensity}),
      Entity(EntityKind::kGroundPatch, {"nest"},
             "A coloured area of the floor, such as the nest. Either size or radius is given.",
             {area, disc, colour("green")}),
      Entity(EntityKind::kHole, {}, "An area without floor. Either size or radius is given.", {area, disc}),
      Entity(EntityKind::kWall, {}, "A box that never moves.", {box, friction, restitution, colour("silver")}),
  };
  ElementSpec terrain =
      Entity(EntityKind::kTerrain, {},
             "Uneven ground, from a file; walls for two-dimensional engines, at the height of their planes.",
             {Optional(kTree, "octomap", "", "", "An OctoMap: the occupied cells are solid."),
              Optional(kTree, "heightmap", "", "", "An image whose brightness is the height.")});
  for (ParameterSpec& parameter : terrain.parameters)
  {
    if (parameter.name == "position") parameter.default_value = "0, 0, 0";
  }
  entities.push_back(std::move(terrain));
  return entities;
}

std::vector<ElementSpec> MakeDistributedEntities()
{
  std::vector<ElementSpec> entities = MakeEntities();
  for (ElementSpec& entity : entities)
  {
    std::erase_if(entity.parameters, [](const ParameterSpec& parameter)
                  { return parameter.name == "position" || parameter.name == "orientation"; });
    entity.parameters.front().description =
        "The entities are called by it and a number: fb gives fb_0, fb_1 and so on.";
  }
  return entities;
}

// What never moves in the engines cannot come and go.
bool CanWait(EntityKind kind)
{
  return kind != EntityKind::kHole && kind != EntityKind::kWall && kind != EntityKind::kTerrain;
}

ElementSpec Distribute()
{
  using enum ParameterType;
  ElementSpec position;
  position.tags = {"position"};
  position.description = "How the positions are chosen. Absent: uniform over the floor of the arena.";
  position.parameters = {
      OneOf(Optional(kChoice, "method", "", "uniform",
                     "uniform in a box, gaussian about a point, or the points of a grid one after the other."),
            {"uniform", "gaussian", "grid"}),
      Place(Optional(kVector3, "min", "m", "",
                     "uniform: the lower corner of the box; empty: that of the floor, less the body.")),
      Place(Optional(kVector3, "max", "m", "",
                     "uniform: the upper corner of the box; empty: that of the floor, less the body.")),
      Place(Optional(kVector3, "mean", "m", "", "gaussian: the point; empty: the middle of the floor.")),
      InRange(Optional(kVector3, "deviation", "m", "1, 1, 0", "gaussian: the standard deviation along each axis."), 0,
              kMostMetres),
      Place(Optional(kVector3, "centre", "m", "", "grid: its middle; empty: the middle of the floor.")),
      InRange(Optional(kVector3, "spacing", "m", "",
                       "grid: the distance of neighbours along each axis; empty: as the arena allows."),
              0, kMostMetres),
      InRange(Optional(
                  kVector3, "layout", "", "",
                  "grid: the number of points along x, y and z, filled in this order; empty: a square that holds all."),
              1, 1e6),
  };
  ElementSpec orientation;
  orientation.tags = {"orientation"};
  orientation.description = "How the orientations are chosen. Absent: a uniform heading.";
  orientation.parameters = {
      OneOf(
          Optional(kChoice, "method", "", "uniform", "uniform between two bounds, gaussian about a mean, or constant."),
          {"uniform", "gaussian", "constant"}),
      Angles(Optional(kVector3, "min", "degrees", "0, 0, 0", "uniform: the lower bounds.")),
      Angles(Optional(kVector3, "max", "degrees", "0, 0, 360", "uniform: the upper bounds.")),
      Angles(Optional(kVector3, "mean", "degrees", "0, 0, 0", "gaussian: the mean.")),
      InRange(Optional(kVector3, "deviation", "degrees", "0, 0, 0", "gaussian: the standard deviation of each angle."),
              0, kMostDegrees),
      Angles(Optional(kVector3, "value", "degrees", "0, 0, 0", "constant: the orientation of all.")),
  };

  ElementSpec element;
  element.tags = {"distribute"};
  element.description =
      "Many entities of one kind, placed at random or on a grid so that no two bodies overlap. Holds one entity "
      "element "
      "without position and orientation. The places follow from the seed alone.";
  element.repeatable = true;
  element.parameters = {
      InRange(Required(kInteger, "quantity", "", "How many."), 1, static_cast<double>(kMostEntities)),
      InRange(Optional(kInteger, "max_trials", "", "100",
                       "How often a place is drawn for an entity before the experiment is refused as too crowded."),
              1, 1e6),
  };
  element.children = {position, orientation};
  for (const ElementSpec& entity : DistributedEntityElements()) element.children.push_back(entity);
  return element;
}

ElementSpec Reserve()
{
  using enum ParameterType;
  ElementSpec element;
  element.tags = {"reserve"};
  element.description =
      "Entities that are not in the arena at the start: experiment functions add them while the experiment runs. Holds "
      "one entity element without position and orientation.";
  element.repeatable = true;
  element.parameters = {InRange(Required(kInteger, "quantity", "", "How many; never more are in the arena at a time."),
                                1, static_cast<double>(kMostEntities))};
  for (const ElementSpec& entity : DistributedEntityElements())
    if (CanWait(*entity.entity)) element.children.push_back(entity);
  return element;
}

ElementSpec Arena()
{
  using enum ParameterType;
  ElementSpec element;
  element.tags = {"arena"};
  element.description = "The space and the entities in it.";
  element.required = true;
  element.parameters = {
      Size(Required(kVector3, "size", "m", "The extent of the arena along x, y and z; it starts at 0, 0, 0.")),
      OneOf(Required(kChoice, "optimization", "",
                     "How positions are indexed: 2D where most robots are in 2D engines, 3D otherwise; "
                     "octree asks for the oct-tree by name. It changes speed, never results."),
            {"2D", "3D", "octree"}),
  };
  element.children = EntityElements();
  element.children.push_back(Distribute());
  element.children.push_back(Reserve());
  return element;
}

ElementSpec Engines()
{
  using enum ParameterType;
  ElementSpec element;
  element.tags = {"engines"};
  element.description = "The physics engines. Each is a closed world and, in a cluster, a process.";
  element.plugins = PluginKind::kEngine;
  ElementSpec engine;
  engine.description = "One engine: its tag is its type, which decides which further parameters it has.";
  engine.parameters = {
      Id("The name by which <arena_physics> refers to it; unique among the engines."),
      InRange(Optional(kInteger, "subclock", "", "1",
                       "Steps of the engine in each clock tick: more find collisions more exactly and take longer."),
              1, 10'000),
      Optional(kText, "library", "", "",
               "The library that registers it, looked for in plugin_path; empty: it is built in."),
  };
  element.plugin_element = {engine};
  return element;
}

ElementSpec ArenaPhysics()
{
  using enum ParameterType;
  ElementSpec entity;
  entity.tags = {"entity"};
  entity.description = "Entities of the engine, by id.";
  entity.repeatable = true;
  entity.parameters = {
      Required(kText, "id", "",
               "An id, or a pattern: * stands for any characters, ? for one. fb_* are all that start with fb_."),
  };
  ElementSpec all;
  all.tags = {"all"};
  all.description = "All entities that the engine can simulate, or those of one kind.";
  all.repeatable = true;
  all.parameters = {
      Optional(kText, "kind", "", "",
               "The tag of a kind (footbot, block …): only these; empty: all kinds that the engine knows."),
  };
  ElementSpec engine;
  engine.tags = {"engine"};
  engine.description = "The entities of one engine.";
  engine.repeatable = true;
  engine.parameters = {Required(kText, "id", "", "The id of the engine.")};
  engine.children = {entity, all};

  ElementSpec element;
  element.tags = {"arena_physics"};
  element.description =
      "Which entities are in which engines. An entity may be in any number, zero included: the first engine of "
      "<engines> that "
      "lists it moves it, in the others it follows.";
  element.children = {engine};
  return element;
}

ElementSpec Visualisations()
{
  using enum ParameterType;
  ElementSpec element;
  element.tags = {"visualisations"};
  element.description = "What shows or records the experiment. The run waits for each of them at every tick.";
  element.plugins = PluginKind::kRenderer;
  ElementSpec render;
  render.description = "One visualisation: its tag is its type, which decides which further parameters it has.";
  render.parameters = {
      Id("The name of the visualisation; unique among them."),
      Optional(kText, "library", "", "",
               "The library that registers it, looked for in plugin_path; empty: it is built in."),
  };
  element.plugin_element = {render};
  return element;
}

ElementSpec ExperimentFunctions()
{
  using enum ParameterType;
  ElementSpec element;
  element.tags = {"experiment_functions"};
  element.description =
      "Code around the steps of the experiment, run by the space server: it measures, changes the world, and decides "
      "when the experiment is over.";
  element.plugins = PluginKind::kExperimentFunctions;
  ElementSpec functions;
  functions.description = "One set of functions: its tag is the one they are registered with.";
  functions.parameters = {
      Id("The name of the functions; unique among them."),
      Optional(kText, "library", "", "", "The library that registers them, looked for in plugin_path."),
  };
  element.plugin_element = {functions};
  return element;
}

}  // namespace

bool ElementSpec::HasTag(const std::string& tag) const
{
  return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

const ElementSpec* ElementSpec::FindChild(const std::string& tag) const
{
  for (const ElementSpec& child : children)
  {
    if (child.HasTag(tag)) return &child;
  }
  return nullptr;
}

const ElementSpec& ElementSpec::Child(const std::string& tag) const
{
  if (const ElementSpec* child = FindChild(tag)) return *child;
  throw std::logic_error("no element <" + tag + "> in the table of <" + (tags.empty() ? "a plug-in" : Name()) + ">");
}

const ElementSpec& ExperimentSchema()
{
  static const ElementSpec schema = []
  {
    ElementSpec root;
    root.tags = {"ahss-config"};
    root.description = "An experiment.";
    root.required = true;
    root.children = {Framework(),      Controllers(),        Arena(), Engines(), ArenaPhysics(),
                     Visualisations(), ExperimentFunctions()};
    return root;
  }();
  return schema;
}

const std::vector<ElementSpec>& EntityElements()
{
  static const std::vector<ElementSpec> entities = MakeEntities();
  return entities;
}

const std::vector<ElementSpec>& DistributedEntityElements()
{
  static const std::vector<ElementSpec> entities = MakeDistributedEntities();
  return entities;
}

std::optional<EntityKind> KindOfTag(const std::string& tag)
{
  for (const ElementSpec& element : EntityElements())
  {
    if (element.HasTag(tag)) return element.entity;
  }
  return std::nullopt;
}

}  // namespace swarmanoid
