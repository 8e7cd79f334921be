// Problem: where each body is after a substep if nothing is in its way, and how it travelled when collisions have moved
// it elsewhere.
//
// Method: a body at a constant twist follows the arc of a circle, which motion.cpp computes exactly. Members of groups
// keep their places at the prey, followers go straight to their goals, turrets turn unless their body grips. The way
// forward along an arc with the chord c and the turn w is c / sinc(w / 2): the chord has the direction of the mean
// heading. A limited motion has the same arc, shortened.
//
// Invariant: each body has slots of its own, so that threads change no bit.
#include "common/math/elementary.h"
#include "engine_worker/engines/kinematics2d/plane_step.h"

namespace swarmanoid::kinematics2d
{
namespace
{

void MoveFollowers(Bodies& bodies, double fraction)
{
  for (Follower& follower : bodies.followers)
  {
    const Pose2& from = follower.from;
    const Pose2& goal = follower.goal;
    follower.other =
        fraction < 1 ? Pose2{from.x + fraction * (goal.x - from.x), from.y + fraction * (goal.y - from.y), goal.heading}
                     : goal;
    bodies.now.Set(follower.body, follower.other);
  }
}

void TurnTurrets(Bodies& bodies, const Groups& groups, double seconds)
{
  for (Turret& turret : bodies.turrets)
  {
    const std::uint32_t body = turret.body;
    turret.before = bodies.turret_angle[body];
    const double before_cos = bodies.TurretCos(body);
    const double before_sin = bodies.turret_sin[body];
    const double way = groups.leader[body] == body ? turret.rate * seconds : 0;
    bodies.SetTurretAngle(body, turret.before + way);
    if (!bodies.turret_cos_before.empty()) bodies.turret_cos_before[body] = before_cos;
    bodies.turret_sin_before[body] = before_sin;
    bodies.turret_way[body] = way;
  }
}

}  // namespace

void MoveBodies(PlaneState& plane, double seconds, double fraction)
{
  Bodies& bodies = plane.bodies;
  const Groups& groups = plane.groups;
  std::swap(bodies.now, bodies.before);

  // All bodies go along their arcs, in pieces that stay in the cache.
  constexpr std::size_t kPiece = 16 * kPadding;
  const TwistStore& twists = groups.Twists(bodies);
  InParts(plane.Pool(), PaddedCount(bodies.count), kPadding,
          [&](unsigned, std::size_t begin, std::size_t end)
          {
            for (; begin < end; begin += kPiece)
            {
              const std::size_t piece_end = std::min(begin + kPiece, end);
              Integrate(bodies.before, twists, seconds, begin, piece_end, bodies.now);
              for (std::size_t k = begin; k < std::min(piece_end, bodies.count); ++k)
                bodies.placed[k] = bodies.PlacedNow(static_cast<std::uint32_t>(k));
            }
          });

  // Members of groups, followers and turrets move differently.
  for (const Grip& grip : groups.grips) bodies.now.Set(grip.body, Compose(bodies.now.Get(grip.prey), grip.relative));
  MoveFollowers(bodies, fraction);
  TurnTurrets(bodies, groups, seconds);
  const auto place = [&](std::uint32_t body) { bodies.placed[body] = bodies.PlacedNow(body); };
  for (const Grip& grip : groups.grips) place(grip.body);
  for (const Follower& follower : bodies.followers) place(follower.body);
  for (const Turret& turret : bodies.turrets) place(turret.body);
}

void MeasureTravel(PlaneState& plane, double seconds)
{
  Bodies& bodies = plane.bodies;
  const PoseStore& before = bodies.before;
  const PoseStore& now = bodies.now;
  const auto measure = [&](std::size_t k)
  {
    const Rotor old_heading{before.z[k], before.w[k]};
    const Rotor heading{now.z[k], now.w[k]};
    const Rotor middle = old_heading * heading;  // half angles of both: the sine and cosine of the mean heading
    const bool turned = old_heading.z != heading.z || old_heading.w != heading.w;
    const std::uint32_t leader = plane.groups.leader[k];
    const double turn = turned ? plane.TurnOf(leader, seconds) * plane.limits.limiter.PartOf(TurnMotion(leader)) : 0;
    const double chord = (now.x[k] - before.x[k]) * middle.w + (now.y[k] - before.y[k]) * middle.z;
    const double half = turn / 2;
    const double sinc = half == 0 ? 1 : SinCosOf(half).sin / half;
    bodies.travel_forward[k] += chord / sinc;
    bodies.travel_turn[k] += turn;
  };
  InParts(plane.Pool(), bodies.count, 1,
          [&](unsigned, std::size_t begin, std::size_t end)
          {
            for (std::size_t k = begin; k < end; ++k) measure(k);
          });
}

}  // namespace swarmanoid::kinematics2d
