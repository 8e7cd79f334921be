// Problem: move bodies by constant twists, exactly, and with the same bits for one body as for kDoubleLanes at once.
//
// Method: a body that turns by 2u within the step goes along the arc of a circle. The chord has the direction of the
// heading after half the turn, and the length of the arc times sin(u) / u. Small turns use series for sine and cosine,
// in lanes; larger ones the functions of common/math, body by body. Headings are half-angle pairs (z, w) as in
// quaternions, so that turns are products.
//
// Invariant: a Newton step keeps the pair at unit length to rounding, for any number of steps. Source: docs/engines.md,
// "Model".
#include "engine_worker/engines/kinematics2d/motion.h"

#include "common/math/elementary.h"
#include "common/math/lanes.h"

namespace swarmanoid::kinematics2d
{
namespace
{

// Up to this half turn a step, the series below are exact to rounding: their first missing terms are under 1e-16.
constexpr double kSeriesLimit = 0.5;

// These series give sin(u) / u and cos(u) for z = u * u.
template <class Number>
Number SincSeries(Number z)
{
  Number p = z * 1.6059043836821613e-10 - 2.505210838544172e-08;
  p = p * z + 2.7557319223985893e-06;
  p = p * z - 1.984126984126984e-04;
  p = p * z + 8.333333333333333e-03;
  p = p * z - 1.6666666666666666e-01;
  return 1.0 + z * p;
}

template <class Number>
Number CosSeries(Number z)
{
  Number p = 2.08767569878681e-09 - z * 1.1470745597729725e-11;
  p = p * z - 2.755731922398589e-07;
  p = p * z + 2.48015873015873e-05;
  p = p * z - 1.388888888888889e-03;
  p = p * z + 4.1666666666666664e-02;
  return (1.0 - 0.5 * z) + z * z * p;
}

template <class Number>
struct Motion
{
  Number x, y, z, w;
};

// From the pose, the way along the body's axes (metres) and the half turn's sine over itself, sine and cosine. The
// chord of the arc has the direction at half the turn, and the length of the arc times sinc(u).
template <class Number>
Motion<Number> Advance(Number x, Number y, Number z, Number w, Number forward, Number left, Number sinc, Number sine,
                       Number cosine)
{
  const Number heading_cos = w * w - z * z;
  const Number heading_sin = (z + z) * w;
  const Number middle_cos = (heading_cos * cosine - heading_sin * sine) * sinc;
  const Number middle_sin = (heading_sin * cosine + heading_cos * sine) * sinc;
  const Number new_z = z * cosine + w * sine;
  const Number new_w = w * cosine - z * sine;
  // One Newton step brings the quaternion back to unit length.
  const Number scale = 1.5 - 0.5 * (new_z * new_z + new_w * new_w);
  return {x + (forward * middle_cos - left * middle_sin), y + (forward * middle_sin + left * middle_cos), new_z * scale,
          new_w * scale};
}

}  // namespace

Rotor RotorOf(double angle)
{
  const SinCos half = SinCosOf(angle / 2);
  return {half.sin, half.cos};
}

double AngleOf(Rotor rotor) { return WrapAngle(2 * Atan2(rotor.z, rotor.w)); }

Pose2 Compose(const Pose2& frame, const Pose2& local)
{
  const double c = CosOf(frame.heading);
  const double s = SinOf(frame.heading);
  return {frame.x + (c * local.x - s * local.y), frame.y + (s * local.x + c * local.y), frame.heading * local.heading};
}

Pose2 Relative(const Pose2& outer, const Pose2& inner)
{
  const double c = CosOf(outer.heading);
  const double s = SinOf(outer.heading);
  const double dx = inner.x - outer.x;
  const double dy = inner.y - outer.y;
  return {c * dx + s * dy, c * dy - s * dx, Conjugate(outer.heading) * inner.heading};
}

Pose2 Advanced(const Pose2& pose, const Twist& twist, double seconds)
{
  const double half_turn = 0.5 * seconds * twist.turn;
  const SinCos u = SinCosOf(half_turn);
  const double sinc = half_turn == 0 ? 1 : u.sin / half_turn;
  const auto moved = Advance<double>(pose.x, pose.y, pose.heading.z, pose.heading.w, seconds * twist.forward,
                                     seconds * twist.left, sinc, u.sin, u.cos);
  return {moved.x, moved.y, {moved.z, moved.w}};
}

void PoseStore::Resize(std::size_t padded)
{
  x.resize(padded, 0);
  y.resize(padded, 0);
  z.resize(padded, 0);
  w.resize(padded, 1);
}

void TwistStore::Resize(std::size_t padded)
{
  forward.resize(padded, 0);
  left.resize(padded, 0);
  turn.resize(padded, 0);
}

void Integrate(const PoseStore& from, const TwistStore& twists, double seconds, std::size_t begin, std::size_t end,
               PoseStore& to)
{
  for (std::size_t k = begin; k < end; k += kDoubleLanes)
  {
    const DoubleLanes u = LoadLanes(&twists.turn[k]) * (0.5 * seconds);
    const DoubleLanes squared = u * u;
    const DoubleLanes sinc = SincSeries(squared);
    const auto moved = Advance<DoubleLanes>(LoadLanes(&from.x[k]), LoadLanes(&from.y[k]), LoadLanes(&from.z[k]),
                                            LoadLanes(&from.w[k]), LoadLanes(&twists.forward[k]) * seconds,
                                            LoadLanes(&twists.left[k]) * seconds, sinc, sinc * u, CosSeries(squared));
    StoreLanes(moved.x, &to.x[k]);
    StoreLanes(moved.y, &to.y[k]);
    StoreLanes(moved.z, &to.z[k]);
    StoreLanes(moved.w, &to.w[k]);

    ForEachBit(LaneMask(squared > kSeriesLimit * kSeriesLimit),
               [&](unsigned lane) { to.Set(k + lane, Advanced(from.Get(k + lane), twists.Get(k + lane), seconds)); });
  }
}

}  // namespace swarmanoid::kinematics2d
