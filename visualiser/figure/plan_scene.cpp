// Draws the space from above as areas, lines and words. Bodies have their convex outline, turned and tipped as they
// are; meshes that of their points. Things are drawn from the ground up: floor, trails, objects, robots on the ground,
// flying robots. Small parts state the length from which they can be seen, and PlanPage leaves them out on a page where
// they would be too small.
#include "visualiser/figure/plan_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/experiment/entity_kind.h"
#include "common/math/convex_outline.h"
#include "common/math/elementary.h"
#include "common/space/shape.h"
#include "common/space/space.h"
#include "common/space/terrain/floor_picture.h"
#include "common/space/terrain/terrain.h"
#include "visualiser/figure/plan_drawing.h"
#include "visualiser/led_place.h"
#include "visualiser/scene/kind_model.h"
#include "visualiser/scene/material.h"
#include "visualiser/scene/object_model.h"
#include "visualiser/scene/painted_floor.h"

namespace swarmanoid
{
namespace
{

// Colours that people with any colour vision can distinguish (M. Okabe and K. Ito, Color Universal Design, 2008: blue,
// vermilion, sky blue, bluish green, reddish purple, orange). Robots of the first kinds have the first ones.
constexpr std::array<std::uint32_t, 6> kRobotColours{0x0072b2, 0xd55e00, 0x56b4e9, 0x009e73, 0xcc79a7, 0xe69f00};
constexpr std::uint32_t kHoldColour = 0xe69f00;
constexpr std::uint32_t kTrailOfObjects = 0x8a8f98;
constexpr double kTrailStep = 0.03;  // m between two recorded positions
constexpr double kLeastRobot_mm = 0.2;
constexpr int kImagePixels = 512;  // along the longer side
constexpr int kCirclePoints = 24;

std::uint32_t Darker(std::uint32_t colour) { return ((colour >> 1) & 0x7f7f7f) + ((colour >> 2) & 0x3f3f3f); }

Vector2 Flat(const Vector3& point) { return point.head<2>(); }

Vector2 Across(const Pose& pose, double x, double y) { return Flat(pose.Apply({x, y, 0})); }

bool HasFile(const EntityKindDescription& kind)
{
  return std::ranges::find(kind.mesh, MeshPart::Form::kFile, &MeshPart::form) != kind.mesh.end();
}

std::vector<Vector3> PointsOf(const Model& model)
{
  std::vector<Vector3> points;
  for (const MeshVertex& vertex : model.levels[1].vertices) points.emplace_back(vertex.position.cast<double>());
  return points;
}

// Returns the outline of a body, turned and tipped as it is.
std::vector<Vector2> OutlineOfBody(const Shape& shape, const Pose& pose)
{
  std::vector<Vector2> corners;
  const Vector3& half = shape.half_size;
  for (const double z : {-half.z(), half.z()})
    if (shape.kind == Shape::Kind::kCylinder)
      for (int i = 0; i < kCirclePoints; ++i)
      {
        const double angle = 2 * kPi * i / kCirclePoints;
        corners.push_back(
            Flat(pose.Apply(shape.centre + Vector3(half.x() * std::cos(angle), half.x() * std::sin(angle), z))));
      }
    else
      for (const double x : {-half.x(), half.x()})
        for (const double y : {-half.y(), half.y()})
          corners.push_back(Flat(pose.Apply(shape.centre + Vector3(x, y, z))));
  return ConvexOutline(std::move(corners));
}

PlanShape Disc(const Vector2& centre, double radius, std::optional<PlanColour> fill,
               std::optional<PlanColour> edge = {})
{
  PlanShape disc;
  disc.form = PlanShape::Form::kDisc;
  disc.points = {centre};
  disc.radius = radius;
  disc.fill = fill;
  disc.edge = edge;
  return disc;
}

PlanShape Polygon(std::vector<Vector2> points, std::optional<PlanColour> fill, std::optional<PlanColour> edge = {})
{
  PlanShape polygon;
  polygon.points = std::move(points);
  polygon.fill = fill;
  polygon.edge = edge;
  return polygon;
}

PlanShape Line(std::vector<Vector2> points, const PlanColour& colour, double width_mm)
{
  PlanShape line;
  line.form = PlanShape::Form::kLine;
  line.points = std::move(points);
  line.edge = colour;
  line.edge_mm = width_mm;
  return line;
}

PlanShape Image(const Vector2& low, const Vector2& high, int columns)
{
  PlanShape image;
  image.form = PlanShape::Form::kImage;
  image.points = {{low.x(), high.y()}, high, low};
  image.columns = columns;
  return image;
}

// High ground is light; places without ground are transparent.
PlanShape TerrainImage(const Terrain& terrain)
{
  const Vector3 low = terrain.Low(), high = terrain.High();
  const Vector3 size = high - low;
  const double cell = size.head<2>().maxCoeff() / kImagePixels;
  const int columns = std::max(1, static_cast<int>(size.x() / cell)),
            rows = std::max(1, static_cast<int>(size.y() / cell));
  PlanShape image = Image(Flat(low), Flat(high), columns);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
    {
      const Vector3 above(low.x() + (column + 0.5) * size.x() / columns, high.y() - (row + 0.5) * size.y() / rows,
                          high.z() + 1e-6);
      const auto ground = terrain.GroundBelow(above);
      const double share = ground ? (*ground - low.z()) / std::max(size.z(), 1e-6) : 0;
      const auto grey = static_cast<std::uint32_t>(130 + 110 * share);
      image.pixels.push_back(ground ? 0xff000000U | grey << 16 | grey << 8 | (grey - 14) : 0);
    }
  return image;
}

PlanShape FloorImage(const FloorPicture& picture, const Vector3& size)
{
  const PaintedFloor floor = Simplified(picture, kImagePixels);
  PlanShape image = Image(-Flat(size) / 2, Flat(size) / 2, floor.columns);
  for (const std::uint8_t pixel : floor.pixels) image.pixels.push_back(0xff000000U | floor.palette[pixel]);
  return image;
}

bool IsFlat(EntityRole role)
{
  return role == EntityRole::kPatch || role == EntityRole::kHole || role == EntityRole::kTerrain;
}

std::uint32_t RobotColour(EntityKind kind)
{
  std::size_t number = 0;
  for (std::size_t other = 0; other < static_cast<std::size_t>(kind); ++other)
    if (IsRobot(static_cast<EntityKind>(other))) ++number;
  return kRobotColours[number % kRobotColours.size()];
}

}  // namespace

PlanScene::PlanScene(const CSwarmanoidSpace& space, const PlanOptions& options) : space_(space), options_(options)
{
  for (std::uint32_t e = 0; e < space_.Size(); ++e)
  {
    const CSwarmanoidSpaceEntity& entity = space_.GetEntity(e);
    const std::string& folder = space_.GetExperiment().folder;
    const EntityRole role = DescriptionOf(entity.GetKind()).role;
    if (role == EntityRole::kTerrain) images_[e] = TerrainImage(*LoadTerrain(entity.GetConfiguration(), folder));
    if (role != EntityRole::kPatch) continue;
    if (const auto picture = LoadFloorPicture(entity.GetConfiguration(), folder))
      images_[e] = FloorImage(*picture, entity.GetSize());
  }
  trails_.resize(space_.Movable().size());
  ReadMeshes();
}

void PlanScene::ReadMeshes()
{
  const Experiment& experiment = space_.GetExperiment();
  for (std::uint32_t e = 0; e < space_.Size(); ++e)
  {
    const EntityConfiguration& configuration = space_.GetEntity(e).GetConfiguration();
    const EntityKindDescription& kind = DescriptionOf(configuration.kind);
    const bool is_object = kind.role == EntityRole::kObject;
    const std::string of_object = is_object ? ObjectModelName(configuration, experiment.folder) : std::string();
    if (of_object.empty() && !HasFile(kind)) continue;
    const auto [points, is_new] = mesh_points_.try_emplace(of_object.empty() ? kind.tag : of_object);
    if (is_new)
      points->second =
          PointsOf(of_object.empty() ? KindModel(kind, experiment) : ObjectModel(configuration, experiment.folder));
    meshes_[e] = {&points->second, of_object.empty() ? Vector3::Ones() : configuration.size};
  }
}

std::vector<Vector2> PlanScene::OutlineOf(std::uint32_t entity) const
{
  const Pose pose = space_.GetPose(entity);
  const auto mesh = meshes_.find(entity);
  if (mesh == meshes_.end()) return OutlineOfBody(ShapeOf(space_.GetEntity(entity).GetConfiguration()), pose);
  std::vector<Vector2> corners;
  for (const Vector3& point : *mesh->second.points)
    corners.push_back(Flat(pose.Apply(point.cwiseProduct(mesh->second.scale))));
  return ConvexOutline(std::move(corners));
}

void PlanScene::Track()
{
  if (!options_.trails) return;
  for (std::size_t m = 0; m < trails_.size(); ++m)
  {
    const std::uint32_t e = space_.Movable()[m];
    if (!space_.IsPresent(e)) continue;
    const Vector2 place = Flat(space_.GetPose(e).position);
    if (trails_[m].empty() || (place - trails_[m].back()).norm() >= kTrailStep) trails_[m].push_back(place);
  }
}

std::uint32_t PlanScene::ColourOf(std::uint32_t entity) const
{
  const CSwarmanoidSpaceEntity& of = space_.GetEntity(entity);
  if (IsRobot(of.GetKind())) return RobotColour(of.GetKind());
  if (DescriptionOf(of.GetKind()).role == EntityRole::kHole) return palette::kHole;
  if (FindAttribute(of.GetKind(), "colour") != nullptr)
    return Paint(static_cast<std::uint32_t>(of.GetAttribute("colour")));
  return Paint(of.GetConfiguration().colour);
}

PlanPicture PlanScene::Draw() const
{
  PlanPicture picture;
  const auto each = [&](auto&& wanted, auto add)
  {
    for (std::uint32_t e = 0; e < space_.Size(); ++e)
      if (space_.IsPresent(e) && wanted(DescriptionOf(space_.GetEntity(e).GetKind()))) (this->*add)(e, picture);
  };
  // Shapes are added from the ground up; flying robots come last.
  each([](const auto& kind) { return IsFlat(kind.role); }, &PlanScene::AddFlat);
  AddTrails(picture);
  each([](const auto& kind) { return !IsFlat(kind.role) && kind.role != EntityRole::kRobot; }, &PlanScene::AddBody);
  const auto flies = [](const auto& kind) { return kind.propellers.has_value(); };
  each([&](const auto& kind) { return kind.role == EntityRole::kRobot && !flies(kind); }, &PlanScene::AddRobot);
  AddHolds(picture);
  each([&](const auto& kind) { return kind.role == EntityRole::kRobot && flies(kind); }, &PlanScene::AddRobot);
  AddDrawing(space_, picture);
  if (!options_.ids) return picture;
  for (const std::uint32_t e : space_.Movable())
  {
    if (!space_.IsPresent(e)) continue;
    PlanShape& label = picture.emplace_back();
    label.form = PlanShape::Form::kText;
    const Shape shape = ShapeOf(space_.GetEntity(e).GetConfiguration());
    label.points = {Flat(space_.GetPose(e).Apply(shape.centre))};
    label.radius = shape.half_size.head<2>().maxCoeff();
    label.fill = PlanColour{palette::kLabel};
    label.text = space_.GetEntity(e).GetId();
  }
  return picture;
}

void PlanScene::AddFlat(std::uint32_t entity, PlanPicture& picture) const
{
  const CSwarmanoidSpaceEntity& area = space_.GetEntity(entity);
  const Pose pose = space_.GetPose(entity);
  if (const auto found = images_.find(entity); found != images_.end())
  {
    PlanShape image = found->second;
    for (Vector2& corner : image.points) corner = Across(pose, corner.x(), corner.y());
    if (FindAttribute(area.GetKind(), "colour") != nullptr)
      for (std::uint32_t& pixel : image.pixels)
        pixel =
            (pixel & 0xff000000U) | Tinted(pixel & 0xffffffU, static_cast<std::uint32_t>(area.GetAttribute("colour")));
    picture.push_back(std::move(image));
    return;
  }
  const Vector3& size = area.GetSize();
  const PlanColour colour{ColourOf(entity), DescriptionOf(area.GetKind()).role == EntityRole::kHole ? 1 : 0.6};
  if (size.y() == 0)
    picture.push_back(Disc(Flat(pose.position), size.x(), colour));
  else
    picture.push_back(Polygon({Across(pose, -size.x() / 2, -size.y() / 2), Across(pose, size.x() / 2, -size.y() / 2),
                               Across(pose, size.x() / 2, size.y() / 2), Across(pose, -size.x() / 2, size.y() / 2)},
                              colour));
}

void PlanScene::AddBody(std::uint32_t entity, PlanPicture& picture) const
{
  const CSwarmanoidSpaceEntity& body = space_.GetEntity(entity);
  const Pose pose = space_.GetPose(entity);
  const std::uint32_t colour = ColourOf(entity);
  const PlanColour edge{Darker(colour)};
  const EntityRole role = DescriptionOf(body.GetKind()).role;
  if (role == EntityRole::kLight)
  {
    PlanShape& bulb =
        picture.emplace_back(Disc(Flat(pose.position), 0.03, PlanColour{colour}, PlanColour{palette::kLabel}));
    bulb.least_radius_mm = 0.7;
    PlanShape& shine = picture.emplace_back(Disc(Flat(pose.position), 0.06, {}, PlanColour{colour}));
    shine.least_radius_mm = 1.4;
    shine.dashed = true;
    return;
  }
  if (role == EntityRole::kSound)
  {
    for (const double radius : {0.5, 1.0, 1.5})
    {
      PlanShape& wave = picture.emplace_back(Disc(Flat(pose.position), 0.04 * radius, {}, PlanColour{palette::kLabel}));
      wave.least_radius_mm = radius;
    }
    return;
  }
  if (ShapeOf(body.GetConfiguration()).kind != Shape::Kind::kNone)
    picture.push_back(Polygon(OutlineOf(entity), PlanColour{colour}, edge));
}

void PlanScene::AddRobot(std::uint32_t entity, PlanPicture& picture) const
{
  const CSwarmanoidSpaceEntity& robot = space_.GetEntity(entity);
  const Pose pose = space_.GetPose(entity);
  const EntityKindDescription& kind = DescriptionOf(robot.GetKind());
  const Shape shape = ShapeOf(robot.GetConfiguration());
  const double reach = shape.half_size.x();
  const double opacity = kind.propellers ? 0.45 : 1;
  const PlanColour fill{ColourOf(entity), opacity}, edge{Darker(fill.rgb)};
  const bool stands = (pose.orientation * Vector3::UnitZ()).z() > 0.999;
  if (shape.kind == Shape::Kind::kCylinder && stands && !meshes_.contains(entity))
  {
    PlanShape& body = picture.emplace_back(Disc(Flat(pose.Apply(shape.centre)), reach, fill, edge));
    body.least_radius_mm = kLeastRobot_mm;
  }
  else
    picture.push_back(Polygon(OutlineOf(entity), fill, edge));
  PlanShape& front =
      picture.emplace_back(Line({Across(pose, 0, 0), Across(pose, shape.centre.x() + reach, 0)}, {0xffffff}, 0.25));
  front.detail_m = 2 * reach;
  AddLights(entity, picture);
}

// Adds LEDs and beacons that shine, in their own colours.
void PlanScene::AddLights(std::uint32_t entity, PlanPicture& picture) const
{
  const CSwarmanoidSpaceEntity& robot = space_.GetEntity(entity);
  const EntityKindDescription& kind = DescriptionOf(robot.GetKind());
  const Pose pose = space_.GetPose(entity);
  const double reach = ShapeOf(robot.GetConfiguration()).half_size.x();
  const auto add = [&](const Vector2& place, double attribute)
  {
    const auto colour = static_cast<std::uint32_t>(attribute);
    if (colour == 0) return;
    PlanShape& light =
        picture.emplace_back(Disc(place, 0.16 * reach, PlanColour{colour}, PlanColour{palette::kLabel, 0.6}));
    light.edge_mm = 0.05;
    light.detail_m = 2 * reach;
  };
  for (std::size_t led = 0; led < (kind.leds ? kind.leds->places.size() : 0); ++led)
  {
    const Vector3 place = LedPlace(robot, led);
    add(Across(pose, place.x(), place.y()), robot.GetAttribute("led", static_cast<int>(led)));
  }
  if (FindAttribute(robot.GetKind(), "beacon") != nullptr) add(Across(pose, 0, 0), robot.GetAttribute("beacon"));
}

void PlanScene::AddTrails(PlanPicture& picture) const
{
  if (!options_.trails) return;
  for (std::size_t m = 0; m < trails_.size(); ++m)
  {
    if (trails_[m].size() < 2) continue;
    const bool is_robot = IsRobot(space_.GetEntity(space_.Movable()[m]).GetKind());
    PlanShape& trail = picture.emplace_back(
        Line(trails_[m], {is_robot ? ColourOf(space_.Movable()[m]) : kTrailOfObjects, is_robot ? 0.45 : 0.8}, 0.2));
    trail.dashed = !is_robot;
  }
}

void PlanScene::AddHolds(PlanPicture& picture) const
{
  for (const std::uint32_t e : space_.Movable())
  {
    if (!space_.IsPresent(e)) continue;
    for (const double hand : space_.Hands(e))
      if (hand > 0)
        picture.push_back(
            Line({Flat(space_.GetPose(e).position), Flat(space_.GetPose(static_cast<std::size_t>(hand) - 1).position)},
                 {kHoldColour}, 0.5));
  }
}

std::vector<PlanLegendEntry> PlanScene::Legend() const
{
  // Entries follow the order of the kinds. A kind with several colours has an entry for each of at most three.
  constexpr std::size_t kMostColours = 3;
  std::map<EntityKind, std::map<std::uint32_t, std::size_t>> counts;
  std::map<EntityKind, double> radii;  // of round robots
  for (std::uint32_t e = 0; e < space_.Size(); ++e)
  {
    const EntityKind kind = space_.GetEntity(e).GetKind();
    if (space_.IsPresent(e) && DescriptionOf(kind).role != EntityRole::kTerrain && !images_.contains(e))
      ++counts[kind][ColourOf(e)];
    if (!space_.IsPresent(e) || !IsRobot(kind) || meshes_.contains(e)) continue;
    if (const Shape shape = ShapeOf(space_.GetEntity(e).GetConfiguration()); shape.kind == Shape::Kind::kCylinder)
    {
      const auto [radius, is_first] = radii.try_emplace(kind, shape.half_size.x());
      if (!is_first) radius->second = std::min(radius->second, shape.half_size.x());
    }
  }
  std::vector<PlanLegendEntry> entries;
  for (const auto& [kind, colours] : counts)
  {
    const EntityKindDescription& row = DescriptionOf(kind);
    const bool is_fixed = row.role == EntityRole::kObject && row.mobility == Mobility::kNever;
    const bool is_round = row.form == BodyForm::kCylinder || row.role == EntityRole::kLight;
    const double opacity = row.role == EntityRole::kPatch ? 0.6 : row.propellers ? 0.45 : 1;
    const auto add = [&](std::uint32_t rgb, std::size_t count)
    {
      PlanLegendEntry& entry = entries.emplace_back();
      std::string name = row.tag;
      std::ranges::replace(name, '_', ' ');
      entry.text = row.role == EntityRole::kPatch || row.role == EntityRole::kHole || is_fixed
                       ? name
                       : fmt::format("{} {}{}", count, name, count == 1 ? "" : "s");
      const PlanColour fill{rgb, opacity}, edge{Darker(rgb)};
      const double half = is_fixed ? 0.3 : 0.8;
      entry.sample.push_back(is_round ? Disc({0, 0}, 0.9, fill, edge)
                                      : Polygon({{-1, -half}, {1, -half}, {1, half}, {-1, half}}, fill, edge));
      if (row.role == EntityRole::kRobot) entry.sample.push_back(Line({{0, 0}, {0.9, 0}}, {0xffffff}, 0.25));
      if (!radii.contains(kind)) return;
      entry.radius = radii[kind];
      entry.least_radius_mm = kLeastRobot_mm;
    };
    if (colours.size() <= kMostColours)
      for (const auto& [rgb, count] : colours) add(rgb, count);
    else
    {
      std::size_t sum = 0;
      for (const auto& [rgb, count] : colours) sum += count;
      add(0xffffff, sum);
    }
  }
  return entries;
}

}  // namespace swarmanoid
