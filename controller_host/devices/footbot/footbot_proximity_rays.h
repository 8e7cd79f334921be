// The 24 rays of a footbot's proximity sensors, and the distance along each to the bodies that it meets: discs, boxes
// and sides in the plane, or any shape in the space. FootbotProximity uses it for one robot after another, in its
// thread. It is inline because the sensor spends most of its time here.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "common/math/elementary.h"
#include "common/math/pose.h"
#include "controller_host/devices/sensing/body_shapes.h"

namespace swarmanoid
{

// A place in the frame of an upright box, in the plane (m).
struct PlaceBesideBox
{
  PlaceBesideBox(const PoseArrays& poses, std::uint32_t body, const Vector3& half_size, double at_x, double at_y)
      : box(HeadingOf(poses, body))
  {
    const double dx = at_x - poses.x[body];
    const double dy = at_y - poses.y[body];
    x = box.cos * dx + box.sin * dy;
    y = box.cos * dy - box.sin * dx;
    outside_x = std::max(__builtin_fabs(x) - half_size.x(), 0.0);
    outside_y = std::max(__builtin_fabs(y) - half_size.y(), 0.0);
  }
  bool IsBeyond(double reach) const { return outside_x * outside_x + outside_y * outside_y > reach * reach; }

  Heading box;
  double x, y;
  double outside_x, outside_y;  // from the sides of the box, 0 between them
};

class FootbotProximityRays
{
public:
  static constexpr unsigned kRays = CCI_FootBotProximitySensor::NUM_SENSORS;
  // The height of the sensors above the base of the footbot (ARGoS3, foot-bot).
  static constexpr double kHeight = 0.06;

  // A number for each ray.
  struct alignas(64) Values
  {
    double values[kRays];
  };

  // Sets the rays, in metres: they start on a ring of this radius around the robot's centre and end after `range`.
  void Configure(double ring_radius, double range);
  double Range() const { return range_; }
  // Returns the distance (m) from the robot's centre to the end of a ray.
  double Reach() const { return ring_radius_ + range_; }

  // Begins with another robot, whose rays have met nothing.
  void Reset() { touched_ = false; }
  bool Touched() const { return touched_; }
  // Returns the distances (m) to the nearest body along each ray, infinity for rays that met nothing. Valid only if a
  // ray met something.
  const double* Distances() const { return distances_.values; }

  // Adds a disc whose centre is at (dx, dy) from the robot's centre.
  void AddDisc(const PoseArrays& poses, std::uint32_t robot, double dx, double dy, double radius);
  void AddUprightBox(const PoseArrays& poses, std::uint32_t robot, std::uint32_t body, const Vector3& half_size);
  // hit_of(from, to) returns the fraction of the way between two points in the space at which a body is met, if any.
  template <class HitOf>
  void AddInSpace(const Pose& robot, const HitOf& hit_of);

private:
  static constexpr double kTiny = 1e-300;  // for a ray along a side: the quotients become huge, not NaN

  void Touch()
  {
    if (!touched_) std::fill_n(distances_.values, kRays, std::numeric_limits<double>::infinity());
    touched_ = true;
  }
  void AddSide(double way, double c, double s);

  double ring_radius_ = 0;
  double range_ = 0;
  Values cos_{}, sin_{};  // of each ray's angle
  Values distances_{};
  bool touched_ = false;
};

inline void FootbotProximityRays::Configure(double ring_radius, double range)
{
  ring_radius_ = ring_radius;
  range_ = range;
  for (unsigned i = 0; i < kRays; ++i)
  {
    const SinCos angle = SinCosOf(CCI_FootBotProximitySensor::AngleOf(i));
    cos_.values[i] = angle.cos;
    sin_.values[i] = angle.sin;
  }
}

// Rays from the centre of the robot's ring against a disc (dx, dy) from it: with p its centre in the robot's frame and
// b = ray . p, the ray is within the disc from b - s to b + s, s^2 = b^2 - |p|^2 + r^2.
inline void FootbotProximityRays::AddDisc(const PoseArrays& poses, std::uint32_t robot, double dx, double dy,
                                          double radius)
{
  const double square = dx * dx + dy * dy;
  const double reach = Reach() + radius;
  if (square > reach * reach) return;

  const Heading heading = HeadingOf(poses, robot);
  const double px = heading.cos * dx + heading.sin * dy;
  const double py = heading.cos * dy - heading.sin * dx;
  const double c = square - radius * radius;
  const double ring = ring_radius_;
  const double far = Reach();
  Touch();
  for (unsigned i = 0; i < kRays; ++i)
  {
    const double b = cos_.values[i] * px + sin_.values[i] * py;
    const double discriminant = b * b - c;
    const double s = __builtin_sqrt(discriminant > 0 ? discriminant : 0);
    const double enter = b - s;
    const double distance = enter > ring ? enter - ring : 0;
    const bool hit = (discriminant >= 0) & (b + s >= ring) & (enter <= far);
    const double nearest = distances_.values[i];
    const double candidate = hit ? distance : nearest;
    distances_.values[i] = candidate < nearest ? candidate : nearest;
  }
}

inline void FootbotProximityRays::AddUprightBox(const PoseArrays& poses, std::uint32_t robot, std::uint32_t body,
                                                const Vector3& half_size)
{
  const PlaceBesideBox place(poses, body, half_size, poses.x[robot], poses.y[robot]);
  const auto& [box, ox, oy, outside_x, outside_y] = place;
  const double near = ring_radius_;
  const double far = Reach();
  if (place.IsBeyond(far)) return;

  // The rays turned into the frame of the box.
  const Heading own = HeadingOf(poses, robot);
  const double c = own.cos * box.cos + own.sin * box.sin;
  const double s = own.sin * box.cos - own.cos * box.sin;
  Touch();
  // Most boxes are walls, of which the rays meet one side: they do not reach its ends, and start before its back.
  constexpr double kMore = 1.000001;  // a ray may be rounded to be longer than 1
  const auto is_side_only = [&](double outside, double across, double along, double half_across, double half_along)
  { return outside > 0 && along + kMore * far <= half_along && across + half_across >= kMore * near; };
  const double across_x = __builtin_fabs(ox);
  const double across_y = __builtin_fabs(oy);
  if (is_side_only(outside_x, across_x, across_y, half_size.x(), half_size.y()))
    return AddSide(std::copysign(half_size.x(), ox) - ox, c, -s);
  if (is_side_only(outside_y, across_y, across_x, half_size.y(), half_size.x()))
    return AddSide(std::copysign(half_size.y(), oy) - oy, s, c);
  for (unsigned i = 0; i < kRays; ++i)
  {
    double ux = c * cos_.values[i] - s * sin_.values[i];
    double uy = s * cos_.values[i] + c * sin_.values[i];
    ux = ux == 0 ? kTiny : ux;
    uy = uy == 0 ? kTiny : uy;
    const double ax = (-half_size.x() - ox) / ux;
    const double bx = (half_size.x() - ox) / ux;
    const double ay = (-half_size.y() - oy) / uy;
    const double by = (half_size.y() - oy) / uy;
    const double enter_x = ax < bx ? ax : bx;
    const double leave_x = ax < bx ? bx : ax;
    const double enter_y = ay < by ? ay : by;
    const double leave_y = ay < by ? by : ay;
    double enter = enter_x > enter_y ? enter_x : enter_y;
    enter = enter > near ? enter : near;
    double leave = leave_x < leave_y ? leave_x : leave_y;
    leave = leave < far ? leave : far;
    const double nearest = distances_.values[i];
    const double candidate = enter <= leave ? enter - near : nearest;
    distances_.values[i] = candidate < nearest ? candidate : nearest;
  }
}

// Rays against a straight side that all of them that point to it meet: `way` metres off along an axis, which is (c, s)
// in the frame of the robot.
inline void FootbotProximityRays::AddSide(double way, double c, double s)
{
  const double near = ring_radius_;
  const double far = Reach();
  for (unsigned i = 0; i < kRays; ++i)
  {
    double u = c * cos_.values[i] + s * sin_.values[i];
    u = u == 0 ? kTiny : u;
    const double meets = way / u;
    const double enter = meets > near ? meets : near;
    const double nearest = distances_.values[i];
    const double candidate = ((meets > 0) & (enter <= far)) ? enter - near : nearest;
    distances_.values[i] = candidate < nearest ? candidate : nearest;
  }
}

template <class HitOf>
void FootbotProximityRays::AddInSpace(const Pose& robot, const HitOf& hit_of)
{
  const Eigen::Matrix3d rotation = robot.orientation.toRotationMatrix();
  for (unsigned i = 0; i < kRays; ++i)
  {
    const Vector3 ray(cos_.values[i], sin_.values[i], 0);
    const Vector3 from = robot.position + rotation * (ring_radius_ * ray + Vector3(0, 0, kHeight));
    const auto hit = hit_of(from, from + rotation * (range_ * ray));
    if (!hit) continue;
    Touch();
    distances_.values[i] = std::min(distances_.values[i], *hit * range_);
  }
}

}  // namespace swarmanoid
