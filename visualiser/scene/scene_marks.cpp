// The marks of a scene beside bodies: beams, ropes, grips, rays, outlines, trails.
#include <cmath>
#include <numbers>

#include "common/math/elementary.h"
#include "common/mesh/convex_hull.h"
#include "common/space/attributes.h"
#include "common/space/space.h"
#include "visualiser/scene/scene.h"
#include "visualiser/scene/trail.h"

namespace swarmanoid
{
namespace
{

constexpr double kLongestBeam = 30;  // m, equal to that of cameras that see the spot

Colour TrailColour(EntityKind kind)
{
  switch (DescriptionOf(kind).mechanism)
  {
    case Mechanism::kTurretGripper:
      return LookOf(Material::kFootbot).colour;
    case Mechanism::kPropellers:
      return LookOf(Material::kEyebot).colour;
    case Mechanism::kArms:
      return LookOf(Material::kHandbot).colour;
    case Mechanism::kNone:
      break;
  }
  return IsRobot(kind) ? DescriptionOf(kind).colour : palette::kSelection;
}

}  // namespace

void Scene::AddLine(const Vector3& from, const Vector3& to, Colour colour, float width, float opacity, bool on_top)
{
  lines_.push_back({from.cast<float>(), to.cast<float>(), colour, width, opacity, opacity, on_top});
}

double Scene::FirstHit(const Vector3& from, const Vector3& to, std::uint32_t without)
{
  if (query_ == nullptr) query_ = std::make_unique<SpaceQuery>(space_);
  double first = 1;
  const auto test = [&](std::uint32_t entity)
  {
    if (entity == without) return;
    const auto hit = SegmentHit(query_->ShapeOfEntity(entity), space_.GetPose(entity), from, to);
    if (hit) first = std::min(first, *hit);
  };
  const Vector3 margin = Vector3::Constant(search_radius_);
  for (const std::uint32_t entity : query_->FindInBox(from.cwiseMin(to) - margin, from.cwiseMax(to) + margin))
    test(entity);
  for (const std::uint32_t entity : large_) test(entity);
  for (const auto& [entity, terrain] : terrains_)
  {
    const Pose inverse = space_.GetPose(entity).Inverse();
    if (const auto hit = terrain->SegmentHit(inverse.Apply(from), inverse.Apply(to))) first = std::min(first, *hit);
  }
  return first;
}

// Adds a beam from the middle of the eyebot's base to the first body, or the floor. Tilt 0 is straight down.
void Scene::AddBeam(const Body& eyebot)
{
  const int laser = SlotsOf(eyebot).laser;
  if (Attribute(eyebot, laser) == 0) return;
  const auto colour = static_cast<Colour>(Attribute(eyebot, laser + 1));
  if (colour == 0) return;
  const double pan = Attribute(eyebot, laser + 2);
  const double tilt = Attribute(eyebot, laser + 3);
  const Pose pose = space_.GetPose(eyebot.entity);
  const Vector3 beam =
      pose.orientation * Vector3(std::sin(tilt) * std::cos(pan), std::sin(tilt) * std::sin(pan), -std::cos(tilt));
  const bool reaches_floor = beam.z() < 0 && pose.position.z() + kLongestBeam * beam.z() <= 0;
  const double length = reaches_floor ? std::max(pose.position.z() / -beam.z(), 0.0) : kLongestBeam;
  const Vector3 to = pose.position + length * beam;
  const double hit = FirstHit(pose.position, to, eyebot.entity);
  const Vector3 end = pose.position + hit * (to - pose.position);
  lines_.push_back({pose.position.cast<float>(), end.cast<float>(), colour, 2.5F, 0.35F, 0.8F});
  if (hit < 1 || reaches_floor) glows_.push_back({end.cast<float>(), 0.09F, colour, true});
}

void Scene::AddRope(const Body& handbot)
{
  if (Attribute(handbot, SlotsOf(handbot).rope) == 0) return;
  const Vector3 from = space_.GetPose(handbot.entity).Apply({RobotJoints::kHandbotRopeForward, 0, 0.16});
  // The magnet is on the ceiling, straight above the robot.
  AddLine(from, {from.x(), from.y(), std::max(ArenaSize().z(), from.z())}, LookOf(Material::kRope).colour, 2, 1);
}

void Scene::AddGrips(const Body& robot)
{
  const bool has_arms = robot.mechanism == Mechanism::kArms;
  const int grippers = DescriptionOf(robot.kind).grippers;
  const int gripped = SlotsOf(robot).gripped;
  for (int gripper = 0; gripper < grippers; ++gripper)
  {
    const double held = Attribute(robot, gripped + gripper);
    if (held < 1 || held > static_cast<double>(space_.Size())) continue;
    const auto other = static_cast<std::uint32_t>(held) - 1;
    // The line starts at the jaws (the third part of a footbot), or at the finger of a hand, and ends in the held body.
    const std::uint32_t part = has_arms ? 3 + 3 * static_cast<std::uint32_t>(gripper) : 2;
    const Eigen::Vector3f from = items_[robot.first_item + part].position;
    Eigen::Vector3f to = space_.GetPose(other).position.cast<float>();
    if (!has_arms) to.z() = from.z();
    const Eigen::Vector3f way = to - from;
    const float reach = std::min(way.norm(), 0.035F);
    if (reach > 0) to = from + way.normalized() * reach;
    lines_.push_back({from, to, palette::kSelection, 4, 1, 1});
  }
}

void Scene::AddRays(std::uint32_t robot)
{
  if (query_ == nullptr) query_ = std::make_unique<SpaceQuery>(space_);
  FindProximityRays(space_, *query_, robot, rays_);
  scanner_rays_.Find(*query_, robot, rays_);
  for (const auto& [from, to, hit] : rays_)
    AddLine(from, from + hit * (to - from), hit < 1 ? palette::kRayHit : palette::kRayFree, 1.5F, hit < 1 ? 1 : 0.7F);
}

// Adds, for each lit LED, lines from the LED along the border of its cone, and the circle at their ends.
void Scene::AddLedCones(const Body& robot)
{
  constexpr double kLength = 0.12;  // m
  constexpr int kSides = 16;
  const LedCones& cones = led_cones_[static_cast<std::size_t>(robot.cones)];
  const Slots& slots = SlotsOf(robot);
  const LedLayout& ring = *DescriptionOf(robot.kind).leds;
  const Pose pose = space_.GetPose(robot.entity);
  const Quaternion turret = QuaternionFromYaw(ring.on_turret ? Attribute(robot, slots.turret) : 0);
  const SinCos border = SinCosOf(cones.observable_angle);
  for (std::size_t led = 0; led < ring.places.size(); ++led)
  {
    const auto colour = static_cast<Colour>(Attribute(robot, slots.led + static_cast<int>(led)));
    if (colour == 0) continue;
    const Vector3 place = turret * Vector3(ring.places[led].x(), ring.places[led].y(), ring.height_m);
    const Vector3 axis = turret * cones.axes[led];
    const Vector3 across = axis.unitOrthogonal();
    const Vector3 other = axis.cross(across);
    const auto at = [&](int side)
    {
      const SinCos around = SinCosOf(side * (2 * kPi / kSides));
      const Vector3 aside = around.cos * across + around.sin * other;
      return pose.Apply(place + kLength * (border.cos * axis + border.sin * aside));
    };
    for (int side = 0; side < kSides; ++side)
    {
      AddLine(at(side), at(side + 1), colour, 1.5F, 0.9F);
      if (side % 4 == 0) AddLine(pose.Apply(place), at(side), colour, 1, 0.7F);
    }
  }
}

void Scene::AddOutline(std::uint32_t entity, Colour colour, float width)
{
  const Shape shape = ShapeOf(space_.GetEntity(entity).GetConfiguration());
  if (shape.kind == Shape::Kind::kNone) return;
  const Pose centre{shape.centre, Quaternion::Identity()};
  AddOutline(shape.kind == Shape::Kind::kCylinder, space_.GetPose(entity).Compose(centre), shape.half_size, colour,
             width);
}

void Scene::AddCollisionModel(std::uint32_t entity)
{
  if (collision_models_ == nullptr) collision_models_ = std::make_unique<CollisionModels>(space_);
  collision_models_->BodiesOf(entity, collision_bodies_);
  for (const CollisionBody& body : collision_bodies_)
  {
    if (body.hull == nullptr)
    {
      AddOutline(body.is_cylinder, space_.GetPose(entity).Compose(body.pose), body.half_size, palette::kCollision,
                 1.5F);
      continue;
    }
    const Pose& pose = space_.GetPose(entity);
    for (const ConvexHull::Edge& edge : body.hull->edges)
      AddLine(pose.Apply(body.hull->corners[edge.corners[0]]), pose.Apply(body.hull->corners[edge.corners[1]]),
              palette::kCollision, 1.5F, 0.9F, true);
  }
}

void Scene::AddOutline(bool is_cylinder, const Pose& centre, const Vector3& half_size, Colour colour, float width)
{
  const auto at = [&](double x, double y, double z) { return centre.Apply(Vector3(x, y, z).cwiseProduct(half_size)); };
  const auto line = [&](const Vector3& from, const Vector3& to) { AddLine(from, to, colour, width, 0.9F, true); };
  if (!is_cylinder)
  {
    for (const double a : {-1.0, 1.0})
      for (const double b : {-1.0, 1.0})
      {
        line(at(-1, a, b), at(1, a, b));
        line(at(a, -1, b), at(a, 1, b));
        line(at(a, b, -1), at(a, b, 1));
      }
  }
  else
  {
    constexpr int kPieces = 24;
    const auto rim = [&](int i, double z)
    {
      const double angle = 2 * std::numbers::pi * i / kPieces;
      return at(std::cos(angle), std::sin(angle), z);
    };
    for (int i = 0; i < kPieces; ++i)
    {
      for (const double z : {-1.0, 1.0}) line(rim(i, z), rim(i + 1, z));
      if (i % 6 == 0) line(rim(i, -1), rim(i, 1));
    }
  }
}

void Scene::Track()
{
  const std::span<const std::uint32_t> movable = space_.Movable();
  if (trails_ == nullptr) trails_ = std::make_unique<Trail[]>(movable.size());
  for (std::size_t m = 0; m < movable.size(); ++m)
  {
    // The trail of an entity ends where it leaves the arena, since its later positions are outside.
    if (!space_.IsPresent(movable[m]))
    {
      trails_[m].count = 0;
      continue;
    }
    Eigen::Vector3f place = space_.GetPose(movable[m]).position.cast<float>();
    place.z() += 0.012F;
    trails_[m].Add(place);
  }
}

void Scene::ForgetTrails() { trails_.reset(); }

void Scene::AddTrails()
{
  const std::span<const std::uint32_t> movable = space_.Movable();
  constexpr float kOpacity = 0.75F;
  for (std::size_t m = 0; m < movable.size(); ++m)
  {
    const Trail& trail = trails_[m];
    const Colour colour = TrailColour(space_.GetEntity(movable[m]).GetKind());
    const auto opacity = [&](std::size_t back)
    { return kOpacity * (1 - static_cast<float>(back) / static_cast<float>(Trail::kPlaces)); };
    for (std::size_t back = 0; back + 1 < trail.count; ++back)
      lines_.push_back({trail.Last(back), trail.Last(back + 1), colour, 2, opacity(back), opacity(back + 1)});
  }
}

}  // namespace swarmanoid
