// Problem: a robot changes between ODE, the planar solver and the closed form of its drive, without a jump.
//
// Method: it may become free if its bodies already move as the closed form would: upright, at ground level, with no
// other speed than that of its wheels. In the planar solver it may slide and turn in any way. Then motion_ takes over
// pose, wheel rates and velocity, and ODE leaves its bodies out. MoveBodies puts all bodies where the motion is at the
// end of a tick: it turns them rigidly about the vertical, and gives them the speeds of the motion.
//
// Invariant: height and lean of the bodies do not change while ODE does not move them.
#include <algorithm>
#include <cmath>

#include "engine_worker/engines/dynamics3d/wheeled.h"

namespace swarmanoid::dynamics3d
{
namespace
{

constexpr double kUprightCosine = 0.995;  // of 5.7 degrees
// A robot that rolls on level ground stays within these limits for all other motions.
constexpr double kFreeCosine = 1 - 1.8e-5;          // of 0.34 degrees
constexpr double kLowest = -1e-3, kHighest = 2e-4;  // m, of the origin above the ground
constexpr double kOtherSpeed = 3e-3;                // m/s
constexpr double kOtherTurn = 0.03;                 // rad/s
// A robot that would tip when braking is free only while its wheel rates are within this part of the largest rate of
// their commands.
constexpr double kSteady = 0.02;

// The planar solver moves robots that meet at this height (m) of their sides, or more.
constexpr double kLeastSide = 0.01;

double TiltCosine(dBodyID body) { return dBodyGetRotation(body)[10]; }

}  // namespace

bool WheeledModel::IsUpright() const { return !IsOnBodies() || TiltCosine(Chassis()) > kUprightCosine; }

Vector2 WheeledModel::GroundPoint() const
{
  if (!IsOnBodies()) return {motion_.x, motion_.y};
  const dReal* position = dBodyGetPosition(Chassis());
  return {position[0], position[1]};
}

Box WheeledModel::CurrentBox() const
{
  Box box = Model::CurrentBox();
  if (IsOnBodies()) return box;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const double middle = axis == 0 ? motion_.x : motion_.y;
    box[2 * axis] = middle - radius_;
    box[2 * axis + 1] = middle + radius_;
  }
  return box;
}

double WheeledModel::LargestSpeed() const
{
  if (links_) return std::max(Model::LargestSpeed(), links_->LargestSpeed());
  if (!IsUpright()) return Model::LargestSpeed();
  const std::array<double, 2> rates = WheelRates();
  double rate = 0;
  for (std::size_t wheel = 0; wheel < 2; ++wheel)
    rate = std::max({rate, std::abs(rates[wheel]), std::abs(wheel_command_[wheel])});
  double speed = 0;
  if (IsOnBodies())
    speed = std::sqrt(VectorOf(dBodyGetLinearVel(Chassis())).squaredNorm());
  else if (IsPlanar())
    speed = PlanarSpeed();
  return std::max(rate * wheel_radius_, speed);
}

std::array<double, 2> WheeledModel::WheelRates() const
{
  if (!IsOnBodies()) return motion_.rates;
  return {dJointGetHingeAngleRate(Axle(0)), dJointGetHingeAngleRate(Axle(1))};
}

double WheeledModel::PlanarSpeed() const { return std::sqrt(motion_.vx * motion_.vx + motion_.vy * motion_.vy); }

bool WheeledModel::MeetsUpright(double low, double high) const
{
  const double from = std::max(low, planar_.low);
  return std::min(high, planar_.high) - from > kLeastSide && from < planar_.highest_push;
}

bool WheeledModel::StandsOnWheels() const
{
  if (!can_be_planar_) return false;
  if (!IsOnBodies()) return true;  // until the tick ends
  const std::array<double, 2> rates = WheelRates();
  for (std::size_t wheel = 0; wheel < 2; ++wheel)
    if (std::max(std::abs(rates[wheel]), std::abs(wheel_command_[wheel])) > largest_free_rate_) return false;
  const dBodyID body = Chassis();
  const double height = dBodyGetPosition(body)[2] - MainOffset().position.z();
  if (TiltCosine(body) < kFreeCosine || height < kLowest || height > kHighest) return false;
  const dReal* spin = dBodyGetAngularVel(body);
  return std::abs(dBodyGetLinearVel(body)[2]) < kOtherSpeed && std::abs(spin[0]) < kOtherTurn &&
         std::abs(spin[1]) < kOtherTurn;
}

bool WheeledModel::RollsFreely() const
{
  PlaneMotion motion;
  motion.rates = WheelRates();
  for (std::size_t wheel = 0; wheel < 2; ++wheel)
  {
    const double command = wheel_command_[wheel];
    if (std::max(std::abs(motion.rates[wheel]), std::abs(command)) > largest_free_rate_) return false;
    if (!brakes_freely_ && std::abs(command - motion.rates[wheel]) > kSteady * largest_free_rate_) return false;
  }
  const double speed = drive_.Speed(motion);
  const double turn = drive_.Turn(motion);
  if (!IsOnBodies())
  {
    const double forward = motion_.cosine * motion_.vx + motion_.sine * motion_.vy;
    const double left = motion_.cosine * motion_.vy - motion_.sine * motion_.vx;
    return std::max(std::abs(forward - speed), std::abs(left)) < kOtherSpeed &&
           std::abs(motion_.spin - turn) < kOtherTurn;
  }
  const dBodyID body = Chassis();
  const double height = dBodyGetPosition(body)[2] - MainOffset().position.z();
  if (TiltCosine(body) < kFreeCosine || height < kLowest || height > kHighest) return false;
  const Vector3 velocity = VectorFromWorld(body, VectorOf(dBodyGetLinearVel(body)));
  const Vector3 spin = VectorOf(dBodyGetAngularVel(body));
  const Vector3 other = velocity - Vector3(speed, 0, 0);
  const Vector3 other_spin = spin - Vector3(0, 0, turn);
  return other.cwiseAbs().maxCoeff() < kOtherSpeed && other_spin.cwiseAbs().maxCoeff() < kOtherTurn;
}

// Takes over the motion of the bodies, which ODE then leaves out.
void WheeledModel::StartMotion()
{
  const std::array<double, 2> rates = {dJointGetHingeAngleRate(Axle(0)), dJointGetHingeAngleRate(Axle(1))};
  const dReal* position = dBodyGetPosition(Chassis());
  const dReal* rotation = dBodyGetRotation(Chassis());
  const dReal* velocity = dBodyGetLinearVel(Chassis());
  const double length = std::sqrt(rotation[0] * rotation[0] + rotation[4] * rotation[4]);
  motion_ = {.x = position[0],
             .y = position[1],
             .cosine = rotation[0] / length,
             .sine = rotation[4] / length,
             .rates = rates,
             .vx = velocity[0],
             .vy = velocity[1],
             .spin = dBodyGetAngularVel(Chassis())[2]};
  for (const PlacedBody& placed : bodies_) scene_.world.SetLeftOut(placed.number, true);
}

void WheeledModel::BecomeFree()
{
  if (IsOnBodies()) StartMotion();
  motion_of_ = EMotionOf::kClosedForm;
}

void WheeledModel::BecomePlanar()
{
  if (IsOnBodies()) StartMotion();
  if (IsFree())
  {
    const double speed = drive_.Speed(motion_);
    motion_.vx = speed * motion_.cosine;
    motion_.vy = speed * motion_.sine;
    motion_.spin = drive_.Turn(motion_);
  }
  motion_of_ = EMotionOf::kPlanarSolver;
}

void WheeledModel::BecomeSolved()
{
  motion_of_ = EMotionOf::kBodies;
  for (const PlacedBody& placed : bodies_) scene_.world.SetLeftOut(placed.number, false);
}

void WheeledModel::AfterPlanarStep(double seconds)
{
  for (std::size_t wheel = 0; wheel < 2; ++wheel) wheel_turn_[wheel] += motion_.turned[wheel];
  AfterFreeMotion(seconds);
}

void WheeledModel::AdvanceFreely(int steps, double step_seconds)
{
  drive_.Advance(motion_, wheel_command_, steps, step_seconds);
  for (std::size_t wheel = 0; wheel < 2; ++wheel) wheel_turn_[wheel] += motion_.turned[wheel];
  AfterFreeMotion(steps * step_seconds);
}

void WheeledModel::MoveBodies()
{
  const double turn_cosine = motion_.half_cosine * motion_.half_cosine - motion_.half_sine * motion_.half_sine;
  const double turn_sine = 2 * motion_.half_cosine * motion_.half_sine;
  const Quaternion turn(motion_.half_cosine, 0, 0, motion_.half_sine);
  motion_.half_cosine = 1;
  motion_.half_sine = 0;
  const Vector3 from = VectorOf(dBodyGetPosition(Chassis()));
  // A robot that stands still keeps its pose to the last bit.
  const bool has_moved = turn_sine != 0 || motion_.x != from.x() || motion_.y != from.y();
  const Vector3 velocity = IsFree() ? Vector3(drive_.Speed(motion_) * Vector3(motion_.cosine, motion_.sine, 0))
                                    : Vector3(motion_.vx, motion_.vy, 0);
  const double spin = IsFree() ? drive_.Turn(motion_) : motion_.spin;
  for (std::size_t k = 0; k < bodies_.size(); ++k)
  {
    const dBodyID body = scene_.world.Body(bodies_[k].number);
    const Pose before = PoseOf(body);
    const Vector3 arm = before.position - from;
    const Vector3 turned(turn_cosine * arm.x() - turn_sine * arm.y(), turn_sine * arm.x() + turn_cosine * arm.y(),
                         arm.z());
    if (has_moved)
      SetRawPose(body, RawOf({Vector3(motion_.x, motion_.y, from.z()) + turned, turn * before.orientation}));
    dBodySetLinearVel(body, velocity.x() - spin * turned.y(), velocity.y() + spin * turned.x(), 0);
    Vector3 rotation(0, 0, spin);
    if (k > 0)
    {
      dVector3 axle;
      dJointGetHingeAxis(Axle(k - 1), axle);
      rotation += motion_.rates[k - 1] * VectorOf(axle);
    }
    dBodySetAngularVel(body, rotation.x(), rotation.y(), rotation.z());
  }
}

}  // namespace swarmanoid::dynamics3d
