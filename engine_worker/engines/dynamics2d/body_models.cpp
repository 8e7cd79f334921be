// Problem: find the body that a three-dimensional entity has on the plane of the engine: its outline, mass and inertia.
//
// Method: a cylinder has a circle. A free box has the convex polygon in which the plane cuts it, and any other box its
// rectangle. The inertia of a polygon is that of even density: a sum over its triangles about the origin.
//
// Invariant: an outline is at least kSmallest_m (m) thick, since Box2D's tolerance would swallow thinner ones.
#include "engine_worker/engines/dynamics2d/body_models.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"
#include "common/space/shape.h"

namespace swarmanoid::dynamics2d
{
namespace
{

// Box2D's tolerance is half a millimetre at this engine's scale; smaller bodies would be lost in it.
constexpr double kSmallest_m = 2e-3;

std::vector<Vector2> Rectangle(double x, double y)
{
  return {{x / 2, -y / 2}, {x / 2, y / 2}, {-x / 2, y / 2}, {-x / 2, -y / 2}};
}

[[noreturn]] void TooSmall(const CSwarmanoidSpaceEntity& entity)
{
  throw ConfigurationError(
      entity.GetConfiguration().location,
      fmt::format("'{}' is thinner than {} m where the plane of dynamics2d cuts it; make it larger, or "
                  "take it out of this engine",
                  entity.GetId(), kSmallest_m));
}

double AreaOf(const std::vector<Vector2>& polygon)
{
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vector2& a = polygon[i];
    const Vector2& b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

// Returns the moment of inertia about the origin of a polygon with even density, for each kilogram.
double UnitInertia(const std::vector<Vector2>& polygon)
{
  double moment = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vector2& a = polygon[i];
    const Vector2& b = polygon[(i + 1) % polygon.size()];
    moment += (a.x() * b.y() - a.y() * b.x()) * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
  }
  return moment / 12 / AreaOf(polygon);
}

// Returns the cut of a block at `at` by the plane, in the frame of its pose on the plane; empty where it does not reach
// it.
std::vector<Vector2> CutOf(const CSwarmanoidSpaceEntity& entity, const Pose& at, const PlaneFrame& plane)
{
  std::vector<Vector2> outline = plane.CutBody(entity, at);
  const PlanePose pose = plane.ToPlane(at);
  const SinCos heading = SinCosOf(pose.heading);
  for (Vector2& point : outline)
  {
    const double u = point.x() - pose.u;
    const double v = point.y() - pose.v;
    point = {heading.cos * u + heading.sin * v, heading.cos * v - heading.sin * u};
  }
  return outline;
}

// Returns the least width of a convex polygon.
double WidthOf(const std::vector<Vector2>& polygon)
{
  double width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vector2& a = polygon[i];
    const Vector2 edge = polygon[(i + 1) % polygon.size()] - a;
    double reach = 0;
    for (const Vector2& b : polygon)
      reach =
          std::max(reach, (edge.x() * (b.y() - a.y()) - edge.y() * (b.x() - a.x())) / std::sqrt(edge.squaredNorm()));
    width = std::min(width, reach);
  }
  return width;
}

void SetContact(BodyModel& model, const CSwarmanoidSpaceEntity& entity, const Dynamics2dParameters& parameters)
{
  const TConfigurationTree& tree = entity.GetConfiguration().tree;
  const bool is_wall = model.motion == EMotion::kStatic;
  model.friction = tree.GetNumber("friction", is_wall ? parameters.wall_friction : parameters.friction);
  model.restitution = tree.GetNumber("restitution", parameters.restitution);
}

// Coulomb friction of a body that lies on the ground. Even pressure under a disc of radius R resists turning with
// 2/3 mu m g R; other outlines count as the disc with their radius of gyration.
void SetGroundFriction(BodyModel& model, double coefficient, double gravity)
{
  model.lies = true;
  model.ground_force = coefficient * model.mass * gravity;
  model.ground_torque = 2.0 / 3.0 * model.ground_force * std::sqrt(2 * model.inertia / model.mass);
}

double MassOf(const CSwarmanoidSpaceEntity& entity, const Dynamics2dParameters& parameters)
{
  const Vector3& size = entity.GetSize();
  const EntityKindDescription& kind = DescriptionOf(entity.GetKind());
  // The parameters of the engine replace the masses of the rows of the simulator's own robots.
  const double own = entity.GetConfiguration().mass_kg;
  const auto replaced = parameters.robot_mass.find(kind.tag);
  if (replaced != parameters.robot_mass.end() && (own == 0 || own == kind.mass_kg)) return replaced->second;
  if (own > 0) return own;
  if (kind.form == BodyForm::kCylinder) return parameters.density * kPi * size.x() * size.x() * size.z();
  return parameters.density * size.prod();
}

}  // namespace

BodyModel MovableModel(const CSwarmanoidSpaceEntity& entity, EMotion motion, const PlaneFrame& plane,
                       const Dynamics2dParameters& parameters)
{
  BodyModel model;
  model.motion = motion;
  SetContact(model, entity, parameters);
  const Vector3& size = entity.GetSize();
  const EntityKindDescription& kind = DescriptionOf(entity.GetKind());
  const bool is_free_box = IsFreeBox(entity.GetKind());
  model.mass = MassOf(entity, parameters);
  if (kind.form == BodyForm::kCylinder)
  {
    if (size.x() < kSmallest_m) TooSmall(entity);
    model.radius = size.x();
    model.inertia = model.mass * size.x() * size.x() / 2;
  }
  else
  {
    if (size.x() < kSmallest_m || size.y() < kSmallest_m || size.z() < kSmallest_m) TooSmall(entity);
    // An engine that is made again in mid-run finds blocks at other poses. Blocks that the engine moves keep the
    // outline of the start.
    if (motion == EMotion::kDynamic && is_free_box)
      model.polygon = CutOf(entity, entity.GetConfiguration().pose, plane);
    else
      model.polygon = MirrorOutline(entity, plane);
    if (model.polygon.empty()) model.polygon = Rectangle(size.x(), size.y());
    if (WidthOf(model.polygon) < kSmallest_m) TooSmall(entity);
    model.inertia = model.mass * UnitInertia(model.polygon);
  }
  model.has_gripper = kind.mechanism == Mechanism::kTurretGripper;
  model.grips_by_rod = model.has_gripper && parameters.grips_by_rods;
  if (motion != EMotion::kDynamic) return model;

  model.grippable = kind.grippable;
  if (kind.wheels)
  {
    model.ground_force = std::min(parameters.wheel_friction * model.mass * parameters.gravity, parameters.drive_force);
    model.ground_torque = model.ground_force * kind.wheels->axle_m / 2;
  }
  else if (kind.propellers)
  {
    const auto replaced = parameters.propellers.find(kind.tag);
    const PropellerForces forces = replaced == parameters.propellers.end() ? ForcesOfKind(kind.tag) : replaced->second;
    model.ground_force = forces.force_n;
    model.ground_torque = forces.torque_n_m;
  }
  else
  {
    const TConfigurationTree& given = entity.GetConfiguration().tree;
    SetGroundFriction(model, given.GetNumber("ground_friction", parameters.ground_friction), parameters.gravity);
    model.ground_torque = given.GetNumber("ground_torque", model.ground_torque);
  }
  return model;
}

std::vector<Vector2> MirrorOutline(const CSwarmanoidSpaceEntity& entity, const PlaneFrame& plane)
{
  if (!IsFreeBox(entity.GetKind())) return {};
  std::vector<Vector2> outline = CutOf(entity, entity.GetPose(), plane);
  if (!outline.empty() && WidthOf(outline) < kSmallest_m) outline.clear();
  return outline;
}

BodyModel StaticModel(std::vector<Vector2> polygon, const Dynamics2dParameters& parameters)
{
  BodyModel model;
  model.motion = EMotion::kStatic;
  model.polygon = std::move(polygon);
  model.friction = parameters.wall_friction;
  model.restitution = parameters.restitution;
  return model;
}

std::optional<FixedBody> FixedModel(const CSwarmanoidSpaceEntity& entity, const PlaneFrame& plane,
                                    const Dynamics2dParameters& parameters)
{
  const Pose pose = entity.GetPose();
  const Shape shape = ShapeOf(entity.GetConfiguration());
  FixedBody fixed;
  if (shape.kind == Shape::Kind::kCylinder)
  {
    if (!plane.CutsUpright(pose, entity.GetSize().z())) return std::nullopt;
    if (shape.half_size.x() < kSmallest_m) TooSmall(entity);
    fixed = {StaticModel({}, parameters), plane.ToPlane(pose)};
    fixed.model.radius = shape.half_size.x();
  }
  else
  {
    fixed = {StaticModel(plane.CutBody(entity, pose), parameters), {}};
    if (fixed.model.polygon.empty()) return std::nullopt;
    if (WidthOf(fixed.model.polygon) < kSmallest_m) TooSmall(entity);
  }
  SetContact(fixed.model, entity, parameters);
  return fixed;
}

bool ReachesPlane(const CSwarmanoidSpaceEntity& entity, const PlaneFrame& plane)
{
  if (IsFreeBox(entity.GetKind())) return !MirrorOutline(entity, plane).empty();
  return plane.CutsUpright(entity.GetPose(), entity.GetSize().z());
}

}  // namespace swarmanoid::dynamics2d
