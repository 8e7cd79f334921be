#include "common/experiment/schema_parts.h"

namespace swarmanoid
{
namespace
{

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

ElementSpec OctoMap()
{
  ElementSpec octomap;
  octomap.tags = {"octomap"};
  octomap.description = "An OctoMap: the occupied cells are solid.";
  octomap.parameters = {Required(ParameterType::kText, "file", "",
                                 "A .bt or .ot file; a relative path starts at the folder of the experiment file.")};
  return octomap;
}

ElementSpec HeightMap()
{
  using enum ParameterType;
  ElementSpec heightmap;
  heightmap.tags = {"heightmap"};
  heightmap.description =
      "A picture of heights. It spans its size along x and y from the position; its upper edge is at the largest y.";
  heightmap.parameters = {
      Required(kText, "file", "", "A PNG; a relative path starts at the folder of the experiment file."),
      Size(Required(kVector2, "size", "m", "What the picture spans.")),
      Size(Required(kNumber, "height", "m", "Of white; black is 0, greys are between in proportion.")),
  };
  return heightmap;
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
             "Uneven ground, from the one file that it holds; walls for two-dimensional engines, at the height of "
             "their planes.",
             {});
  terrain.children = {OctoMap(), HeightMap()};
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

}  // namespace

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
      InRange(
          Optional(kNumber, "limit", "m", "0",
                   "How far outside the arena an entity may get, along each axis, in all directions; 0: ten times the "
                   "longest side of the arena, and at least 100 m."),
          0, kMostMetres),
      OneOf(Optional(kChoice, "beyond_limit", "", "stop",
                     "What happens to an entity that physics takes farther than that: stop ends the run with an error "
                     "that names it, hold puts it back to where it was one tick before, remove takes it out of the "
                     "arena."),
            {"stop", "hold", "remove"}),
  };
  element.children = EntityElements();
  element.children.push_back(Distribute());
  element.children.push_back(Reserve());
  return element;
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
