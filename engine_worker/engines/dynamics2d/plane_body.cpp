#include "engine_worker/engines/dynamics2d/plane_body.h"

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"

namespace swarmanoid::dynamics2d
{
namespace
{

constexpr double kSlip = 1e-3;        // m/s: slower than this a body on the ground is taken to stand
constexpr double kSameCorner = 1e-4;  // m
constexpr double kSmallTurn = 1e-6;   // rad: the chord is as long as the arc

// Returns the corners in counter-clockwise order, without those that lie on the one before.
std::vector<Vector2> DistinctCorners(const std::vector<Vector2>& polygon)
{
  std::vector<Vector2> corners;
  double twice_area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vector2& next = polygon[(i + 1) % polygon.size()];
    twice_area += polygon[i].x() * next.y() - polygon[i].y() * next.x();
    if ((next - polygon[i]).squaredNorm() > kSameCorner * kSameCorner) corners.push_back(polygon[i]);
  }
  if (twice_area < 0) std::ranges::reverse(corners);
  return corners;
}

}  // namespace

void UpdateShape(Body& body)
{
  const BodyModel& model = body.model;
  body.radius = model.radius;
  body.corners.clear();
  if (model.radius <= 0)
  {
    const std::vector<Vector2> corners = DistinctCorners(model.polygon);
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      const Vector2 edge = corners[(i + 1) % corners.size()] - corners[i];
      const double length = std::sqrt(edge.squaredNorm());
      const Corner corner{corners[i].x(), corners[i].y(), edge.y() / length, -edge.x() / length};
      body.corners.push_back(corner);
      body.radius = std::max(body.radius, Length(corner.x, corner.y));
    }
  }
  body.arm = model.has_gripper ? Length(kGripperReach, kGripperSide / 2) : 0;
  body.radius = std::max(body.radius, body.arm);
}

FrictionShares SharesOf(const BodyModel& model, double vx, double vy, double turn)
{
  const double lever = turn * model.ground_torque / model.ground_force;
  const double sliding = vx * vx + vy * vy;
  const double slip = std::sqrt(sliding + lever * lever);
  if (slip <= kSlip) return {1, 1};
  return {std::sqrt(sliding) / slip, std::abs(lever) / slip};
}

ChordOfStep ChordOf(double turn)
{
  if (turn == 0) return {1, 0, 1};
  const SinCos half = SinCosOf(turn / 2);
  return {half.cos, half.sin, std::abs(turn) > kSmallTurn ? half.sin / (turn / 2) : 1};
}

double AngleOfGrip(const Body& body, const Body& gripped)
{
  return WrapAngle(gripped.state.angle - body.state.angle - body.grip.reference_angle);
}

void PutMotion(const Body& body, ByteWriter& state)
{
  state.Put(body.state);
  state.Put(static_cast<std::uint8_t>(body.solid ? 1 : 0));
  if (!body.model.has_gripper) return;
  state.Put(body.turret_angle);
  state.Put(static_cast<std::uint8_t>(body.held_angle ? 1 : 0));
  if (body.held_angle) state.Put(*body.held_angle);
}

void GetMotion(Body& body, ByteReader& state)
{
  body.state = state.Get<BodyState>();
  body.solid = state.Get<std::uint8_t>() != 0;
  if (!body.model.has_gripper) return;
  body.turret_angle = state.Get<double>();
  const bool held = state.Get<std::uint8_t>() != 0;
  body.held_angle = held ? std::optional(state.Get<double>()) : std::nullopt;
}

void PutGrip(const Body& body, ByteWriter& state)
{
  state.Put(static_cast<std::int32_t>(body.gripped));
  if (body.gripped != kNoBody) state.Put(body.grip);
}

void GetGrip(Body& body, ByteReader& state)
{
  body.gripped = state.Get<std::int32_t>();
  body.grip = {};
  if (body.gripped != kNoBody) body.grip = state.Get<GripState>();
}

}  // namespace swarmanoid::dynamics2d
