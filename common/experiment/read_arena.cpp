#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "common/configuration/regular_file.h"
#include "common/configuration/wording.h"
#include "common/experiment/body.h"
#include "common/experiment/element_reader.h"
#include "common/experiment/entity_hull.h"
#include "common/experiment/mesh_files.h"
#include "common/experiment/sections.h"
#include "common/experiment/unique_ids.h"
#include "common/math/elementary.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

SpaceOptimization OptimizationOf(const std::string& text)
{
  if (text == "octree") return SpaceOptimization::kOctree;
  return text == "3D" ? SpaceOptimization::k3D : SpaceOptimization::k2D;
}

BeyondLimit BeyondLimitOf(const std::string& text)
{
  if (text == "hold") return BeyondLimit::kHold;
  return text == "remove" ? BeyondLimit::kRemove : BeyondLimit::kStop;
}

Quaternion OrientationOf(const Vector3& degrees)
{
  return QuaternionFromEuler(
      {DegreesToRadians(degrees.x()), DegreesToRadians(degrees.y()), DegreesToRadians(degrees.z())});
}

// Returns the size of a patch or hole: a rectangle (x, y, 0) or a disc (radius, 0, 0).
Vector3 AreaSize(const ElementReader& reader, Reading& reading)
{
  const TConfigurationTree& tree = reader.Tree();
  const bool rectangle = reader.IsGiven("size");
  const bool disc = reader.IsGiven("radius");
  if (rectangle && disc)
  {
    reading.diagnostics.Add(tree.ValueLocation("radius"),
                            fmt::format("<{}> has a size and a radius; keep one", tree.Name()));
  }
  if (!rectangle && !disc)
  {
    reading.diagnostics.Add(
        tree.Location(),
        fmt::format("<{}> lacks its extent: give 'size' (\"x, y\" in m) or 'radius' (m)", tree.Name()));
  }
  return rectangle ? reader.Vector("size") : Vector3(reader.Number("radius"), 0, 0);
}

void CheckFile(const ElementReader& reader, std::string_view parameter, Reading& reading,
               std::string (*mistake_of)(const std::string& path) = FileMistake)
{
  if (!reading.options.check_files || !reader.IsGood(parameter)) return;
  const fs::path path = fs::path(reading.experiment.folder) / reader.Text(parameter);
  if (const std::string mistake = mistake_of(path); !mistake.empty())
    reading.diagnostics.Add(reader.Place(parameter),
                            fmt::format("{}: {}", Quoted(path.lexically_normal().string()), mistake));
}

// Checks that a terrain holds exactly one map.
void CheckTerrain(const TConfigurationTree& tree, const ElementSpec& spec, Reading& reading)
{
  int maps = 0;
  for (const TConfigurationTree& child : tree.Children())
  {
    const ElementSpec* element = spec.FindChild(child.Name());
    if (element == nullptr) continue;  // reported already, or not an element
    ++maps;
    CheckFile(ElementReader(child, *element, reading.diagnostics), "file", reading);
  }
  if (maps != 1)
    reading.diagnostics.Add(tree.Location(),
                            fmt::format("<{}> must hold one map, <octomap file=\"…\"/> or <heightmap file=\"…\" "
                                        "size=\"…\" height=\"…\"/>; it holds {}",
                                        tree.Name(), maps));
}

Vector3 BodySize(const ElementReader& reader, const EntityKindDescription& kind)
{
  if (kind.form == BodyForm::kNone || !kind.size.isZero()) return kind.size;
  if (kind.form == BodyForm::kBox) return reader.Vector("size");
  return {reader.Number("radius"), reader.Number("radius"), reader.Number("height")};
}

// Another experiment of this process may have loaded the library of the kind. The other processes of this experiment
// would not have it.
void CheckKindIsListed(const TConfigurationTree& tree, EntityKind kind, Reading& reading)
{
  const auto& listed = reading.experiment.entity_kinds;
  const auto is_it = [&](const EntityKindConfiguration& one) { return KindOfTag(one.tag) == kind; };
  if (IsBuiltIn(kind) || std::any_of(listed.begin(), listed.end(), is_it)) return;
  reading.diagnostics.Add(tree.Location(), fmt::format("the kind <{0}> is of a user's library; name it as "
                                                       "<entity_kinds><{0} library=\"…\"/></entity_kinds>",
                                                       TagName(kind)));
}

// Reads all but id and pose.
EntityConfiguration ReadEntityBody(const ElementReader& reader, const ElementSpec& spec, Reading& reading)
{
  EntityConfiguration entity;
  entity.kind = *spec.entity;
  entity.tree = reader.Tree();
  entity.location = reader.Tree().Location();
  CheckKindIsListed(reader.Tree(), entity.kind, reading);
  const EntityKindDescription& kind = DescriptionOf(entity.kind);
  const auto has = [&](std::string_view name)
  { return std::ranges::find(spec.parameters, name, &ParameterSpec::name) != spec.parameters.end(); };
  const bool is_area = kind.role == EntityRole::kPatch || kind.role == EntityRole::kHole;
  entity.size = is_area ? AreaSize(reader, reading) : BodySize(reader, kind);
  if (kind.role == EntityRole::kTerrain)
  {
    const std::size_t mistakes = reading.diagnostics.Count();
    CheckTerrain(entity.tree, spec, reading);
    if (reading.diagnostics.Count() > mistakes) reading.diagnostics.Lose(kTerrainMap);
  }
  if (has("controller")) entity.controller = reader.Text("controller");
  entity.movable = kind.mobility == Mobility::kIfAsked ? reader.Boolean("movable") : kind.mobility == Mobility::kAlways;
  if (has("mass")) entity.mass_kg = reader.Number("mass");
  if (entity.mass_kg == 0) entity.mass_kg = kind.mass_kg;
  entity.colour = has("colour") ? reader.Colour("colour") : kind.colour;
  if (has("picture") && !reader.Text("picture").empty())
  {
    CheckFile(reader, "picture", reading);
    if (is_area && entity.size.y() == 0)
      reading.diagnostics.Add(reader.Place("picture"), "a picture lies on a rectangle: give 'size', not 'radius'");
    if (!reader.IsGiven("colour")) entity.colour = 0xffffff;
  }
  if (has("mesh") && !reader.Text("mesh").empty()) CheckFile(reader, "mesh", reading, MeshFileMistake);
  entity.hull = HullOfEntity(reader, entity, reading);
  if (has("intensity")) entity.intensity = reader.Number("intensity");
  return entity;
}

void CheckInside(const ElementReader& reader, const std::string& id, const Vector3& position, Reading& reading)
{
  const Vector3& size = reading.experiment.arena_size;
  constexpr double kSlack = 1e-9;
  constexpr const char* kAxes[] = {"x", "y", "z"};
  if (size.isZero()) return;  // reported already
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    if (position[axis] >= -kSlack && position[axis] <= size[axis] + kSlack) continue;
    reading.diagnostics.Add(reader.Place("position"),
                            fmt::format("{} is outside the arena: {} is {} m; it must be from 0 to {} m", Quoted(id),
                                        kAxes[axis], position[axis], size[axis]));
    return;
  }
}

class ArenaReader
{
public:
  explicit ArenaReader(Reading& reading) : reading_(reading) {}

  void Read(const TConfigurationTree& tree)
  {
    const ElementSpec& spec = ExperimentSchema().Child("arena");
    const ElementReader reader(tree, spec, reading_.diagnostics);
    Experiment& experiment = reading_.experiment;
    experiment.arena_size = reader.Vector("size");
    experiment.optimization = OptimizationOf(reader.Text("optimization"));
    const double limit_m = reader.Number("limit");
    experiment.limit_m = limit_m > 0 ? limit_m : UsualLimit(experiment.arena_size);
    experiment.beyond_limit = BeyondLimitOf(reader.Text("beyond_limit"));
    for (const TConfigurationTree& child : tree.Children())
    {
      const ElementSpec* element = spec.FindChild(child.Name());
      if (element == nullptr)
      {
        // The mistake is reported already.
        reading_.diagnostics.Lose(child.Value("id").value_or(""));
        continue;
      }
      if (element->entity)
      {
        ReadEntity(child, *element);
      }
      else if (element->HasTag("reserve"))
      {
        ReadReserve(child, *element);
      }
      else if (element->HasTag("floor_field"))
      {
        ReadFloorField(child, *element, reading_);
      }
      else if (element->HasTag("wind"))
      {
        ReadWind(child, *element);
      }
      else
      {
        ReadDistribute(child, *element);
      }
    }
    CheckIds();
  }

private:
  void ReadEntity(const TConfigurationTree& tree, const ElementSpec& spec)
  {
    const ElementReader reader(tree, spec, reading_.diagnostics);
    EntityConfiguration entity = ReadEntityBody(reader, spec, reading_);
    entity.id = reader.Text("id");
    entity.pose.position = reader.Vector("position");
    entity.pose.orientation = OrientationOf(reader.Vector("orientation"));
    if (reader.IsGiven("id")) CheckId(entity.id, reader.Place("id"), reading_.diagnostics);
    if (reader.IsGood("position")) CheckInside(reader, entity.id, entity.pose.position, reading_);
    reading_.experiment.entities.push_back(std::move(entity));
  }

  void ReadWind(const TConfigurationTree& tree, const ElementSpec& spec)
  {
    ElementReader reader(tree, spec, reading_.diagnostics);
    WindConfiguration wind;
    wind.velocity_m_s = reader.Vector("velocity");
    wind.gusts_m_s = reader.Number("gusts");
    wind.height_m = reader.Number("height");
    if (wind.gusts_m_s > 0 && wind.velocity_m_s.head<2>().isZero() && reader.IsGood("gusts"))
      reader.Fail("gusts",
                  "gusts need a wind that carries them along: give <wind> a velocity along x or y, such as "
                  "velocity=\"1, 0, 0\"");
    reading_.experiment.wind = wind;
  }

  // Loses the ids of all elements of a <distribute> or <reserve>. Returns true if an element is of an unknown kind,
  // which is reported already.
  bool LoseEntities(const TConfigurationTree& tree, const ElementSpec& spec)
  {
    bool is_unknown = false;
    for (const TConfigurationTree& child : tree.Children())
      if (const auto id = child.Value("id"))
      {
        reading_.diagnostics.Lose(*id);
        is_unknown |= spec.FindChild(child.Name()) == nullptr;
      }
    return is_unknown;
  }

  // Reads the entities of a <distribute> or <reserve>, which differ only in their ids; their poses are not set yet.
  // Returns their number, or 0 if the element is wrong.
  std::size_t ReadAlike(const ElementReader& reader, const ElementSpec& spec, bool waiting)
  {
    const TConfigurationTree& tree = reader.Tree();
    std::vector<TConfigurationTree> entities;
    for (const TConfigurationTree& child : tree.Children())
    {
      const ElementSpec* element = spec.FindChild(child.Name());
      if (element != nullptr && element->entity) entities.push_back(child);
    }
    if (entities.size() != 1)
    {
      const bool is_consequence = LoseEntities(tree, spec);
      if (!entities.empty() || !is_consequence)
        reading_.diagnostics.Add(tree.Location(), fmt::format("<{}> must hold one entity element such as <footbot "
                                                              "id=\"fb\"/>; it holds {}",
                                                              tree.Name(), entities.size()));
      return 0;
    }

    const TConfigurationTree& entity_tree = entities.front();
    const ElementSpec& entity_spec = *spec.FindChild(entity_tree.Name());
    const ElementReader entity_reader(entity_tree, entity_spec, reading_.diagnostics);
    EntityConfiguration entity = ReadEntityBody(entity_reader, entity_spec, reading_);
    const std::string id = entity_reader.Text("id");
    if (entity_reader.IsGiven("id")) CheckId(id, entity_reader.Place("id"), reading_.diagnostics);

    auto& all = reading_.experiment.entities;
    const auto count = static_cast<std::size_t>(reader.Integer("quantity"));
    if (count == 0 || (reader.IsGiven("quantity") && !reader.IsGood("quantity"))) reading_.diagnostics.Lose(id);
    if (all.size() + count > kMostEntities)
    {
      reading_.diagnostics.Add(reader.Place("quantity"),
                               fmt::format("more than {} entities; lower the quantity", kMostEntities));
      reading_.diagnostics.Lose(id);
      return 0;
    }
    if (waiting && DescriptionOf(entity.kind).mobility == Mobility::kIfAsked && !entity.movable)
    {
      reading_.diagnostics.Add(entity_tree.Location(),
                               fmt::format("the {} {} cannot come and go while it cannot move; give it "
                                           "movable=\"true\"",
                                           TagName(entity.kind), Quoted(id)));
      reading_.diagnostics.Lose(id);
      return 0;
    }
    // Lights and patches have no body, so engines ignore their positions.
    entity.movable |= waiting;
    all.reserve(all.size() + count);
    for (std::size_t i = 0; i < count; ++i)
    {
      all.push_back(entity);
      all.back().id = id + "_" + std::to_string(i);
      if (!waiting) continue;
      all.back().reserve = id;
      all.back().waits = true;
      all.back().pose = WaitingPose(all.back(), all.size() - 1);
    }
    return count;
  }

  void ReadDistribute(const TConfigurationTree& tree, const ElementSpec& spec)
  {
    const ElementReader reader(tree, spec, reading_.diagnostics);
    const std::size_t first = reading_.experiment.entities.size();
    const std::size_t count = ReadAlike(reader, spec, false);
    if (count > 0)
      reading_.distributions.push_back(
          {tree, first, count, reader.Integer("max_trials"), reader.Text("order") == "place"});
  }

  void ReadReserve(const TConfigurationTree& tree, const ElementSpec& spec)
  {
    const ElementReader reader(tree, spec, reading_.diagnostics);
    ReadAlike(reader, spec, true);
  }

  void CheckIds()
  {
    const auto& entities = reading_.experiment.entities;
    UniqueIds ids("entities", entities.size());
    for (const EntityConfiguration& entity : entities)
      if (const std::string mistake = ids.Add(entity.id, entity.location.line); !mistake.empty())
        reading_.diagnostics.Add(entity.tree.ValueLocation("id"), mistake);
  }

  Reading& reading_;
};

}  // namespace

void ReadArena(const TConfigurationTree& tree, Reading& reading)
{
  if (tree.Exists()) ArenaReader(reading).Read(tree);
}

}  // namespace swarmanoid
