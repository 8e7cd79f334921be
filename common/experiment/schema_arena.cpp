#include <algorithm>

#include "common/experiment/schema_parts.h"

namespace swarmanoid
{
namespace
{

constexpr double kMostWind = 100;  // m/s

ElementSpec OctoMap()
{
  ElementSpec octomap;
  octomap.tags = {"octomap"};
  octomap.description = "An OctoMap: the occupied cells are solid.";
  octomap.parameters = {{"file", ParameterType::kText, "", std::nullopt,
                         "A .bt or .ot file; a relative path starts at the folder of the experiment file."}};
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
      {"file", kText, "", std::nullopt, "A PNG; a relative path starts at the folder of the experiment file."},
      Size({"size", kVector2, "m", std::nullopt, "What the picture spans."}),
      Size({"height", kNumber, "m", std::nullopt, "Of white; black is 0, greys are between in proportion."}),
  };
  return heightmap;
}

ElementSpec Entity(EntityKind kind)
{
  using enum ParameterType;
  const EntityKindDescription& row = DescriptionOf(kind);
  ElementSpec element;
  element.tags = {row.tag};
  element.tags.insert(element.tags.end(), row.further_tags.begin(), row.further_tags.end());
  element.description = row.description;
  element.entity = kind;
  element.repeatable = true;
  element.parameters = {
      Id("The name of the entity; unique in the arena."),
      Place({"position", kVector3, "m", std::nullopt,
             "Where it is; within the arena, which reaches from 0, 0, 0 to its size."}),
      Angles({"orientation", kVector3, "degrees", "0, 0, 0",
              "Rotations about the fixed axes x, y and z, in this order. The heading of a robot is the last one."}),
  };
  element.parameters.insert(element.parameters.end(), row.parameters.begin(), row.parameters.end());
  if (row.role != EntityRole::kTerrain) return element;
  element.children = {OctoMap(), HeightMap()};
  for (ParameterSpec& parameter : element.parameters)
    if (parameter.name == "position") parameter.default_value = "0, 0, 0";
  return element;
}

std::vector<ElementSpec> MakeEntities()
{
  std::vector<ElementSpec> entities;
  for (std::size_t kind = 0; kind < EntityKindCount(); ++kind)
    entities.push_back(Entity(static_cast<EntityKind>(kind)));
  // The reference pages and messages name the robots in this order.
  const auto place = [&](const char* tag) { return std::ranges::find(entities, tag, &ElementSpec::Name); };
  std::iter_swap(place("eyebot"), place("handbot"));
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

ElementSpec Distribute()
{
  using enum ParameterType;
  ElementSpec position;
  position.tags = {"position"};
  position.description = "How the positions are chosen. Absent: uniform over the floor of the arena.";
  position.parameters = {
      OneOf({"method", kChoice, "", "uniform",
             "uniform in a box, gaussian about a point, or the points of a grid one after the other."},
            {"uniform", "gaussian", "grid"}),
      Place(
          {"min", kVector3, "m", "", "uniform: the lower corner of the box; empty: that of the floor, less the body."}),
      Place(
          {"max", kVector3, "m", "", "uniform: the upper corner of the box; empty: that of the floor, less the body."}),
      Place({"mean", kVector3, "m", "", "gaussian: the point; empty: the middle of the floor."}),
      {"deviation", kVector3, "m", "1, 1, 0", "gaussian: the standard deviation along each axis.", 0, kMostMetres},
      Place({"centre", kVector3, "m", "", "grid: its middle; empty: the middle of the floor."}),
      {"spacing", kVector3, "m", "",
       "grid: the distance of neighbours along each axis, negative: it is filled from the largest coordinate on; "
       "empty: "
       "as the arena allows.",
       -kMostMetres, kMostMetres},
      {"layout", kVector3, "", "",
       "grid: the number of points along x, y and z, filled in this order; empty: a square that holds all.", 1, 1e6},
      Place({"drop_from", kNumber, "m", "",
             "Height from which each is let down onto the terrain of its engines, so that no part of its base is in "
             "it; empty: the height of the drawn position stays."}),
  };
  ElementSpec orientation;
  orientation.tags = {"orientation"};
  orientation.description = "How the orientations are chosen. Absent: a uniform heading.";
  orientation.parameters = {
      OneOf(
          {"method", kChoice, "", "uniform",
           "uniform between two bounds, gaussian about a mean, constant, or the points of a grid one after the other."},
          {"uniform", "gaussian", "constant", "grid"}),
      OneOf({"axes", kChoice, "", "xyz",
             "xyz: angles about the fixed axes x, y and z, one after the other. zyx: angles about z, y and x, turned "
             "about in this order."},
            {"xyz", "zyx"}),
      Angles({"min", kVector3, "degrees", "0, 0, 0", "uniform: the lower bounds."}),
      Angles({"max", kVector3, "degrees", "0, 0, 360", "uniform: the upper bounds."}),
      Angles({"mean", kVector3, "degrees", "0, 0, 0", "gaussian: the mean."}),
      {"deviation", kVector3, "degrees", "0, 0, 0", "gaussian: the standard deviation of each angle.", 0, kMostDegrees},
      Angles({"value", kVector3, "degrees", "0, 0, 0", "constant: the orientation of all."}),
      Angles({"centre", kVector3, "degrees", "0, 0, 0", "grid: its middle."}),
      Angles({"spacing", kVector3, "degrees", "0, 0, 0",
              "grid: the difference of neighbours in each angle, negative: it begins at the largest angle."}),
      {"layout", kVector3, "", "1, 1, 1",
       "grid: the number of angles about each axis, filled in the order of axes and then again.", 1, 1e6},
  };

  ElementSpec element;
  element.tags = {"distribute"};
  element.description =
      "Many entities of one kind, placed at random or on a grid so that no two bodies overlap. Holds one entity "
      "element "
      "without position and orientation. The places follow from the seed alone.";
  element.repeatable = true;
  element.parameters = {
      {"quantity", kInteger, "", std::nullopt, "How many; 0 for none.", 0, static_cast<double>(kMostEntities)},
      {"max_trials", kInteger, "", "100",
       "How often a place is drawn for an entity before the experiment is refused as too crowded.", 1, 1e6},
      OneOf({"order", kChoice, "", "number",
             "number: fb_0, fb_1, fb_2 ... one after the other in memory, tables and arrays. place: those that start "
             "near one another, which makes ticks of 10,000 entities and more faster. Ids and places are the same."},
            {"number", "place"}),
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
  element.parameters = {{"quantity", kInteger, "", std::nullopt, "How many; never more are in the arena at a time.", 1,
                         static_cast<double>(kMostEntities)}};
  for (const ElementSpec& entity : DistributedEntityElements())
    if (CanWait(*entity.entity)) element.children.push_back(entity);
  return element;
}

ElementSpec FloorField()
{
  using enum ParameterType;
  ElementSpec element;
  element.tags = {"floor_field"};
  element.description =
      "A field on the floor, such as a virtual pheromone: an amount per m² in square cells over the whole arena. "
      "Robots "
      "deposit with the actuator floor_field and read with the sensor floor_field.";
  element.repeatable = true;
  element.parameters = {
      Id("The name of the field; unique among the fields."),
      Size({"cell", kNumber, "m", "0.05", "The edge of a cell."}),
      {"evaporation", kNumber, "1/s", "0", "Rate of the exponential by which the field vanishes.", 0, 1e6},
      {"diffusion", kNumber, "m²/s", "0",
       "Diffusion constant; at most cell² / (4 · step), where a step lasts `period` ticks.", 0, 1e6},
      {"period", kInteger, "ticks", "1",
       "Ticks between two steps of evaporation and diffusion. Deposits count at every tick.", 1, 1e6},
      {"least", kNumber, "1/m²", "1e-6",
       "Values that are smaller after a step become 0, so that empty parts of the floor cost no time.", 0, 1e6},
      {"colour", kColour, "", "#00a050", "In pictures."},
      {"full", kNumber, "1/m²", "0", "Value that pictures show in full colour; 0: the largest one of the moment.", 0,
       1e12},
  };
  return element;
}

ElementSpec Wind()
{
  using enum ParameterType;
  ElementSpec element;
  element.tags = {"wind"};
  element.description = "Wind that acts on flying robots: a constant velocity, and gusts by Dryden's model.";
  element.parameters = {
      {"velocity", kVector3, "m/s", "0, 0, 0", "The constant velocity of the air.", -kMostWind, kMostWind},
      {"gusts", kNumber, "m/s", "0",
       "Scales the gusts: the speed of the wind 20 feet (6.1 m) above the ground. The velocity carries them along.", 0,
       kMostWind},
      {"height", kNumber, "m", "3",
       "The height whose gusts blow everywhere in the arena; taken as 3.048 m if it is lower.", 0, 304.8},
  };
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
      Size({"size", kVector3, "m", std::nullopt, "The extent of the arena along x, y and z; it starts at 0, 0, 0."}),
      OneOf({"optimization", kChoice, "", std::nullopt,
             "How positions are indexed: 2D where most robots are in 2D engines, 3D otherwise; octree asks for the "
             "oct-tree by name. It changes speed, never results."},
            {"2D", "3D", "octree"}),
      {"limit", kNumber, "m", "0",
       "How far outside the arena an entity may get, along each axis, in all directions; 0: ten times the longest side "
       "of the arena, and at least 100 m.",
       0, kMostMetres},
      OneOf({"beyond_limit", kChoice, "", "stop",
             "What happens to an entity that physics takes farther than that: stop ends the run with an error that "
             "names it, hold puts it back to where it was one tick before, remove takes it out of the arena."},
            {"stop", "hold", "remove"}),
  };
  element.children = EntityElements();
  element.children.push_back(Distribute());
  element.children.push_back(Reserve());
  element.children.push_back(FloorField());
  element.children.push_back(Wind());
  return element;
}

const std::vector<ElementSpec>& EntityElements()
{
  static PerTable<std::vector<ElementSpec>> entities;
  return entities.Get(MakeEntities);
}

const std::vector<ElementSpec>& DistributedEntityElements()
{
  static PerTable<std::vector<ElementSpec>> entities;
  return entities.Get(MakeDistributedEntities);
}

}  // namespace swarmanoid
