// Problem: a kind of robot states only its size, mass and wheels. Find bodies, motors and casters with which it drives
// stably in ODE, and decide when a closed form may replace them.
//
// Method: proportions of the footbot fill in what the row of the kind lacks. Motors are a little weaker than what
// rubber wheels hold on level ground, with a torque that falls linearly to 0 at kFreeSpeed times the largest speed. The
// robot may be free if its wheels stay on the ground without slip on the tightest arc at that speed
// (KeepsItsWheelsDown): forward force and centripetal force stay within the friction circle, and no wheel is unloaded.
//
// Source: docs/engines.md, "Robots that touch nothing".
#include "engine_worker/engines/dynamics3d/wheeled.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "common/math/elementary.h"

namespace swarmanoid::dynamics3d
{
namespace
{

constexpr double kGearedInertia = 10;  // of a wheel, times that of a sphere
constexpr double kGravity = 9.81;      // m/s2
// Stalled motors push with this part of the robot's weight. On level ground its wheels carry 77 %, so they do not slip
// at a friction of 1, and spin at less than 0.95.
constexpr double kUsableWeight = 0.73;
// The speed at which motors have no torque left, as a multiple of the kind's largest speed. Motors have most power at
// half of it.
constexpr double kFreeSpeed = 2;

// Casters are soft enough to leave the weight to the wheels, and so stiff that stalled motors tilt the robot by that.
constexpr double kStallTilt = 0.02;  // rad

// A caster stands at this part of the way from the axle to the end of the body, but at least a wheel's radius away.
constexpr double kCasterPlace = 7.0 / 8;

double ShorterReach(const WheeledShape& shape) { return std::min(shape.caster_reach[0], shape.caster_reach[1]); }

// Returns the force (N) that both motors together can exert on the ground, if it holds.
double StallForce(const WheeledShape& shape)
{
  return kUsableWeight * (shape.chassis_mass + 2 * shape.wheel_mass) * kGravity;
}

}  // namespace

WheeledShape WheeledShape::Of(const CSwarmanoidSpaceEntity& entity, double density)
{
  const EntityKindDescription& kind = DescriptionOf(entity.GetKind());
  WheeledShape shape;
  shape.size = entity.GetSize();
  shape.is_cylinder = kind.form == BodyForm::kCylinder;
  shape.hull = entity.GetConfiguration().hull;
  const double half_length = shape.is_cylinder ? shape.size.x() : shape.size.x() / 2;
  const double area = shape.is_cylinder ? kPi * half_length * half_length : shape.size.x() * shape.size.y();
  const double given = entity.GetConfiguration().mass_kg;
  double mass = given > 0 ? given : density * area * shape.size.z();
  for (const MovingLink& link : kind.links) mass -= link.body.mass_kg;
  shape.wheel_radius = kind.wheels->radius_m;
  shape.half_track = kind.wheels->axle_m / 2;
  shape.clearance = std::min(shape.wheel_radius / 2, shape.size.z() / 4);
  shape.caster_radius = shape.clearance * 2 / 3;
  shape.caster_reach = {kCasterPlace * half_length, kCasterPlace * half_length};
  if (shape.hull)
  {
    double front = 0, back = 0;
    for (const Vector3& corner : shape.hull->corners)
    {
      front = std::max(front, corner.x());
      back = std::max(back, -corner.x());
    }
    for (const auto& [reach, end] : {std::pair(&shape.caster_reach[0], front), std::pair(&shape.caster_reach[1], back)})
      *reach = std::max(shape.wheel_radius, kCasterPlace * end);
  }
  shape.wheel_mass = mass / 8;
  shape.chassis_mass = mass - 2 * shape.wheel_mass;
  shape.centre_of_mass = shape.size.z() / 3;
  shape.inertia_radius = half_length;
  shape.inertia_height = shape.size.z() * 2 / 3;
  shape.free_speed = kFreeSpeed * kind.wheels->max_speed_m_s;
  return shape;
}

namespace
{

dMass ChassisMass(const WheeledShape& shape)
{
  return CylinderMass(shape.chassis_mass, shape.inertia_radius, shape.inertia_height);
}

dMass WheelMass(const WheeledShape& shape)
{
  return Geared(SphereMass(shape.wheel_mass, shape.wheel_radius), kGearedInertia);
}

DriveDescription DriveOf(const WheeledShape& shape)
{
  const double wheel_inertia = WheelMass(shape).I[0];  // about any axis
  const double track_inertia = shape.wheel_mass * shape.half_track * shape.half_track;
  return {.mass = shape.chassis_mass + 2 * shape.wheel_mass,
          .inertia = ChassisMass(shape).I[10] + 2 * (wheel_inertia + track_inertia),
          .wheel_inertia = wheel_inertia,
          .wheel_radius = shape.wheel_radius,
          .half_track = shape.half_track,
          .stall_torque = StallForce(shape) * shape.wheel_radius / 2,
          .free_rate = shape.free_speed / shape.wheel_radius};
}

// Returns the largest speed (m/s) of a free robot. Faster robots, which brake harder, are solved. Wheels swing beyond
// their commands by less than a twentieth.
double LargestFreeSpeed(const WheeledShape& shape) { return 1.05 * shape.free_speed / kFreeSpeed; }

// Returns whether the wheels neither slip nor are lifted on the tightest arc at that speed; if it `brakes`, as hard as
// it can.
bool KeepsItsWheelsDown(const WheeledShape& shape, const WorldSettings& settings, bool brakes)
{
  const DriveDescription drive = DriveOf(shape);
  const double weight = drive.mass * std::sqrt(settings.gravity.squaredNorm());
  const double speed = LargestFreeSpeed(shape);
  // Part of the motors' force turns the wheels themselves.
  const double rolling = 2 * drive.wheel_inertia / (shape.wheel_radius * shape.wheel_radius);
  const double braking =
      brakes ? (1 + speed / shape.free_speed) * StallForce(shape) * drive.mass / (drive.mass + rolling) : 0;
  const double across = drive.mass * speed * speed / (4 * shape.half_track);
  const double height =
      (shape.chassis_mass * shape.centre_of_mass + 2 * shape.wheel_mass * shape.wheel_radius) / drive.mass;
  const double load = std::min(kUsableWeight * weight, weight - braking * height / ShorterReach(shape));
  const double grip = 0.95 * settings.wheel_friction * load;
  return load > 0 && braking * braking + across * across < grip * grip &&
         2 * across * height < weight * shape.half_track;
}

// Returns the corner of a wheel's tread that is farthest from the middle of the robot.
Vector2 CornerOfTread(const WheeledShape& shape)
{
  return {std::sqrt(1 - kWheelFlank * kWheelFlank) * shape.wheel_radius,
          shape.half_track + kWheelFlank * shape.wheel_radius};
}

double RadiusOf(const WheeledShape& shape)
{
  double square = shape.size.x() * shape.size.x();
  if (shape.hull)
  {
    square = 0;
    for (const Vector3& corner : shape.hull->corners) square = std::max(square, corner.head<2>().squaredNorm());
  }
  else if (!shape.is_cylinder)
    square = shape.size.head<2>().squaredNorm() / 4;
  // The treads of the wheels touch the ground, and their edges may stand out beyond the chassis.
  return std::sqrt(std::max(square, CornerOfTread(shape).squaredNorm()));
}

// Returns whether nothing upright meets a wheel before the chassis, whose outline is a disc or a box.
bool CoversItsWheels(const WheeledShape& shape)
{
  if (shape.hull) return false;
  const Vector2 corner = CornerOfTread(shape);
  if (shape.is_cylinder) return corner.squaredNorm() <= shape.size.x() * shape.size.x();
  return corner.x() <= shape.size.x() / 2 && corner.y() <= shape.size.y() / 2;
}

PlanarOutline PlanarOutlineOf(const WheeledShape& shape, const WorldSettings& settings)
{
  constexpr double kSafe = 0.5;
  const double weight = (shape.chassis_mass + 2 * shape.wheel_mass) * std::sqrt(settings.gravity.squaredNorm());
  return {.radius = shape.is_cylinder ? shape.size.x() : 0,
          .half_size = shape.is_cylinder ? Vector2(Vector2::Zero()) : Vector2(shape.size.head<2>() / 2),
          .low = shape.clearance,
          .high = shape.size.z(),
          .highest_push = kSafe * weight * std::min(ShorterReach(shape), shape.half_track) / StallForce(shape)};
}

double HighestOf(const ConvexHull& hull)
{
  double highest = 0;
  for (const Vector3& corner : hull.corners) highest = std::max(highest, corner.z());
  return highest;
}

// Returns the hull with all corners below a height lifted to it.
std::shared_ptr<const HullShape> Raised(const ConvexHull& hull, double height)
{
  std::vector<Vector3> corners = hull.corners;
  for (Vector3& corner : corners) corner.z() = std::max(corner.z(), height);
  return std::make_shared<const HullShape>(HullOf(corners));
}

}  // namespace

WheeledModel::WheeledModel(Scene& scene, const CSwarmanoidSpaceEntity& entity, const WheeledShape& shape)
    : Model(scene, entity),
      wheel_radius_(shape.wheel_radius),
      radius_(RadiusOf(shape)),
      height_(shape.hull ? HighestOf(*shape.hull) : shape.size.z()),
      largest_free_rate_(
          KeepsItsWheelsDown(shape, scene.world.Settings(), false) ? LargestFreeSpeed(shape) / wheel_radius_ : 0),
      brakes_freely_(KeepsItsWheelsDown(shape, scene.world.Settings(), true)),
      drive_(DriveOf(shape)),
      can_be_planar_(brakes_freely_ && largest_free_rate_ > 0 && CoversItsWheels(shape)),
      planar_(PlanarOutlineOf(shape, scene.world.Settings()))
{
  OdeWorld& world = scene.world;
  const auto wheel_centre = [&](int wheel)
  { return Vector3(0, wheel == 0 ? shape.half_track : -shape.half_track, shape.wheel_radius); };

  // Bodies, at the origin: joints made here do not depend on where the robot starts.
  AddBody(ChassisMass(shape), {Vector3(0, 0, shape.centre_of_mass), Quaternion::Identity()});
  for (int wheel = 0; wheel < 2; ++wheel) AddBody(WheelMass(shape), {wheel_centre(wheel), Quaternion::Identity()});
  for (int wheel = 0; wheel < 2; ++wheel)
  {
    axles_[wheel] = world.AddHinge(bodies_[static_cast<std::size_t>(1 + wheel)].number, MainBody(), wheel_centre(wheel),
                                   Vector3::UnitY());
  }

  if (!DescriptionOf(entity.GetKind()).links.empty())
    links_ = std::make_unique<JointedLinks>(scene, entity, MainBody(),
                                            [this](const dMass& mass, const Pose& in_entity)
                                            {
                                              AddBody(mass, in_entity, EBody::kMechanism);
                                              return bodies_.back().number;
                                            });

  const double stall_torque = StallForce(shape) * shape.wheel_radius;
  const double lever = ShorterReach(shape) * ShorterReach(shape);
  Touch touch;
  touch.caster_stiffness = stall_torque / (lever * kStallTilt);
  world.BeginEntity(Entity(), touch);
  const auto in_chassis = [&](double x, double z) -> Pose {
    return {Vector3(x, 0, z - shape.centre_of_mass), Quaternion::Identity()};
  };
  const double body_height = shape.size.z() - shape.clearance;
  const auto hull = shape.hull ? Raised(*shape.hull, shape.clearance) : nullptr;
  const dGeomID body = hull                ? hull->MakeGeom()
                       : shape.is_cylinder ? dCreateCylinder(nullptr, shape.size.x(), body_height)
                                           : dCreateBox(nullptr, shape.size.x(), shape.size.y(), body_height);
  Pose middle = in_chassis(0, shape.clearance + body_height / 2);
  if (hull) middle.position = hull->Centre() - Vector3(0, 0, shape.centre_of_mass);
  world.AddSolid(body, bodies_[0].number, ELayer::kRobot, ESurface::kPlain, middle);
  world.KeepShape(hull);
  for (const double x : {shape.caster_reach[0], -shape.caster_reach[1]})
    world.AddSolid(dCreateSphere(nullptr, shape.caster_radius), bodies_[0].number, ELayer::kWheel, ESurface::kCaster,
                   in_chassis(x, shape.caster_radius));
  for (std::size_t wheel = 1; wheel <= 2; ++wheel)
    world.AddSolid(dCreateSphere(nullptr, shape.wheel_radius), bodies_[wheel].number, ELayer::kWheel, ESurface::kWheel);
  if (links_) links_->AddSolids();
}

void WheeledModel::Place(const Pose& pose)
{
  Model::Place(pose);
  if (links_) links_->Put(pose);
}

void WheeledModel::FollowAttributes()
{
  if (links_) links_->FollowAttributes(CurrentPose());
}

void WheeledModel::Command(std::string_view channel, std::span<const double> values)
{
  if (links_ && channel == "joints") links_->Command(values);
  if (channel != "footbot_wheels" && channel != "wheels") return;
  wheel_command_[0] = values[0];
  wheel_command_[1] = values[1];
}

void WheeledModel::BeginTick()
{
  wheel_turn_[0] = wheel_turn_[1] = 0;
  elapsed_ = 0;
  motion_of_ = EMotionOf::kBodies;  // who moves it is to be found out from the bodies
}

void WheeledModel::SetLeftOut(bool left_out)
{
  motion_of_ = EMotionOf::kBodies;
  Model::SetLeftOut(left_out);
}

void WheeledModel::SetVelocity(const EntityVelocity& velocity)
{
  Model::SetVelocity(velocity);
  const Vector3 forward = VectorToWorld(Chassis(), Vector3::UnitX());
  const Vector3 axle = VectorToWorld(Chassis(), Vector3::UnitY());
  for (std::size_t wheel = 1; wheel <= 2; ++wheel)
  {
    const dBodyID body = scene_.world.Body(bodies_[wheel].number);
    const double rate = forward.dot(VectorOf(dBodyGetLinearVel(body))) / wheel_radius_;
    const Vector3 spin = velocity.angular + axle * (rate - axle.dot(velocity.angular));
    dBodySetAngularVel(body, spin.x(), spin.y(), spin.z());
  }
}

void WheeledModel::BeforeStep(double seconds)
{
  if (links_) links_->BeforeStep(seconds);
  for (std::size_t wheel = 0; wheel < 2; ++wheel)
  {
    const double speed = dJointGetHingeAngleRate(Axle(wheel));
    dJointSetHingeParam(Axle(wheel), dParamVel, wheel_command_[wheel]);
    dJointSetHingeParam(Axle(wheel), dParamFMax, drive_.LargestTorque(wheel_command_[wheel], speed));
  }
}

void WheeledModel::AfterStep(double seconds)
{
  elapsed_ += seconds;
  if (links_) links_->AfterStep();
  for (std::size_t wheel = 0; wheel < 2; ++wheel) wheel_turn_[wheel] += dJointGetHingeAngleRate(Axle(wheel)) * seconds;
}

void WheeledModel::Report(AttributeReport& report) const
{
  if (links_) links_->Report(report);
}

void WheeledModel::Save(ByteWriter& state) const
{
  if (links_) links_->Save(state);
}

void WheeledModel::Load(ByteReader& state)
{
  if (links_) links_->Load(state);
}

void WheeledModel::SaveTick(ByteWriter& state) const
{
  if (links_) links_->SaveTick(state);
  state.Put(wheel_command_);
  state.Put(wheel_turn_);
  state.Put(elapsed_);
  state.Put(motion_of_);
  if (!IsOnBodies()) state.Put(motion_);
}

void WheeledModel::LoadTick(ByteReader& state)
{
  if (links_) links_->LoadTick(state);
  wheel_command_ = state.Get<std::array<double, 2>>();
  wheel_turn_ = state.Get<std::array<double, 2>>();
  elapsed_ = state.Get<double>();
  motion_of_ = state.Get<EMotionOf>();
  if (!IsOnBodies()) motion_ = state.Get<PlaneMotion>();
}

void WheeledModel::Sense(std::string_view channel, std::span<double> values) const
{
  if (links_ && channel == "joints") return links_->Sense(values);
  if (elapsed_ <= 0 || channel != "footbot_encoders") return Model::Sense(channel, values);
  for (std::size_t wheel = 0; wheel < 2; ++wheel) values[wheel] = wheel_turn_[wheel] * wheel_radius_;
}

}  // namespace swarmanoid::dynamics3d
