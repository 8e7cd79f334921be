// KinematicWorld::Advance: move all, find who meets, push apart, let nobody go so far that outlines overlap. The middle
// of it is in kinematic_contacts.cpp, the end in kinematic_limiting.cpp.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/math/elementary.h"
#include "common/math/lanes.h"
#include "engine_worker/engines/kinematics2d/kinematic_division.h"
#include "engine_worker/engines/kinematics2d/kinematic_limits.h"
#include "engine_worker/engines/kinematics2d/kinematic_region.h"
#include "engine_worker/engines/kinematics2d/kinematic_world.h"

namespace swarmanoid::kinematics2d
{
void KinematicWorld::Advance(double seconds, int steps)
{
  if (division_ && division_->Advance(*this, seconds, steps)) return;
  if (region_) region_->ShareBodies(*this);
  if (keeps_travel_)
  {
    std::fill(travel_forward_.begin(), travel_forward_.end(), 0.0);
    std::fill(travel_turn_.begin(), travel_turn_.end(), 0.0);
  }
  FindEffectiveTwists();
  const int substeps = Substeps(seconds, steps);
  statistics_ = {};
  statistics_.substeps = substeps;
  for (int k = 1; k <= substeps; ++k)
  {
    if (region_ && k > 1)
    {
      region_->ShareBodies(*this);
      FindEffectiveTwists();
    }
    Substep(seconds / substeps, static_cast<double>(k) / substeps);
  }
}

void KinematicWorld::FindEffectiveTwists()
{
  if (grips_.empty()) return;
  effective_ = twists_;
  for (std::size_t g = 0; g + 1 < group_start_.size(); ++g)
  {
    const std::span<const Grip> members(&grips_[group_start_[g]], group_start_[g + 1] - group_start_[g]);
    for (const Grip& grip : members) effective_.Set(grip.body, {});
    effective_.Set(members.front().prey, GroupTwist(members));
  }
}

// The rigid motion that comes nearest, in the least-squares sense, to what the wheels of all members would do. Wheels
// of a member stand kGripArm left and right of its centre. All in the frame of the prey, where the members do not move.
Twist KinematicWorld::GroupTwist(std::span<const Grip> members) const
{
  const double count = static_cast<double>(members.size());
  double centre_x = 0, centre_y = 0, velocity_x = 0, velocity_y = 0;
  const auto velocity_of = [this](const Grip& grip)
  {
    const Twist own = twists_.Get(grip.body);
    const double c = CosOf(grip.relative.heading);
    const double s = SinOf(grip.relative.heading);
    return Twist{c * own.forward - s * own.left, s * own.forward + c * own.left, own.turn};
  };
  for (const Grip& grip : members)
  {
    const Twist v = velocity_of(grip);
    centre_x += grip.relative.x / count;
    centre_y += grip.relative.y / count;
    velocity_x += v.forward / count;
    velocity_y += v.left / count;
  }
  double turning = 0, inertia = 0;
  for (const Grip& grip : members)
  {
    const Twist v = velocity_of(grip);
    const double x = grip.relative.x - centre_x;
    const double y = grip.relative.y - centre_y;
    turning += x * v.left - y * v.forward + kGripArm * kGripArm * v.turn;
    inertia += x * x + y * y + kGripArm * kGripArm;
  }
  const double turn = turning / inertia;
  return {velocity_x + turn * centre_y, velocity_y - turn * centre_x, turn};
}

int KinematicWorld::Substeps(double seconds, int steps)
{
  // The largest way against its limit, and the largest way (metres), over all bodies. Maxima do not depend on the
  // order.
  const TwistStore& twists = grips_.empty() ? twists_ : effective_;
  DoubleLanes most_ratio{}, most_speed{};
  for (std::size_t k = 0; k < count_; k += kDoubleLanes)
  {
    const DoubleLanes forward = LoadLanes(&twists.forward[k]);
    const DoubleLanes left = LoadLanes(&twists.left[k]);
    const DoubleLanes inverse_limit = LoadLanes(&inverse_limit_[k]);
    const DoubleLanes speed = forward * forward + left * left;
    const DoubleLanes ratio = speed * (inverse_limit * inverse_limit);
    most_ratio = ratio > most_ratio ? ratio : most_ratio;
    most_speed = speed > most_speed ? speed : most_speed;
  }
  double ratio = 0, way = 0;
  for (std::size_t lane = 0; lane < kDoubleLanes; ++lane)
  {
    ratio = std::max(ratio, most_ratio[lane]);
    way = std::max(way, most_speed[lane]);
  }
  ratio = std::sqrt(ratio) * seconds;
  way = std::sqrt(way) * seconds;
  const auto consider = [&](double metres, double limit)
  {
    ratio = std::max(ratio, metres / limit);
    way = std::max(way, metres);
  };
  for (const Grip& grip : grips_)
  {
    const Twist group = effective_.Get(grip.prey);
    const double arm = std::sqrt(grip.relative.x * grip.relative.x + grip.relative.y * grip.relative.y);
    const double speed =
        std::sqrt(group.forward * group.forward + group.left * group.left) + std::fabs(group.turn) * arm;
    consider(speed * seconds, CoreLimitOf(ModelOf(grip.body)));
  }
  for (const Follower& follower : followers_)
  {
    const double dx = follower.goal.x - follower.from.x;
    const double dy = follower.goal.y - follower.from.y;
    consider(std::sqrt(dx * dx + dy * dy), CoreLimitOf(ModelOf(follower.body)));
  }

  if (region_) region_->ShareMaxima({&ratio, &way});
  if (!(ratio <= kMostSubsteps))
    throw std::runtime_error("a body is told to move " + std::to_string(way) + " m in " + std::to_string(seconds) +
                             " s; the kinematic engine follows up to " +
                             std::to_string(kMostSubsteps * smallest_limit_) + " m in that time");
  const int needed = static_cast<int>(std::ceil(ratio / steps));
  const int substeps = steps * std::max(needed, 1);
  reach_ = way / substeps + kSlowestSeparation;
  contact_margin_ = std::min(kContactMargin, 2 * way / substeps + kSlowestSeparation);
  return substeps;
}

void KinematicWorld::Substep(double seconds, double fraction)
{
  Move(seconds, fraction);
  FindContacts();
  limiter_.Clear();
  if (ListContactsByColour())
  {
    const std::span<const double> mobility = EveryoneIsFree() ? std::span<const double>() : mobility_;
    solver_.Solve(colours_, mobility, kSolverTolerance * allowed_, 2 * reach_, now_.x, now_.y, Pool(), region_.get());
    LimitMotions(seconds);
  }
  if (keeps_travel_)
    InParts(Pool(), count_, 1,
            [&](unsigned, std::size_t begin, std::size_t end) { KeepTravelOf(seconds, begin, end); });
}

// Between where each follower was when the substep began and where it is now, as its place in `before_`. For collisions
// the former counts; who looks for room finds a follower where it is: it goes there whatever others do.
void KinematicWorld::SwapFollowers()
{
  for (Follower& follower : followers_)
  {
    const Pose2 other = before_.Get(follower.body);
    before_.Set(follower.body, follower.before);
    follower.before = other;
  }
}

void KinematicWorld::Move(double seconds, double fraction)
{
  std::swap(now_, before_);
  // In pieces that stay in the cache.
  constexpr std::size_t kPiece = 16 * kPadding;
  InParts(Pool(), PaddedCount(count_), kPadding,
          [&](unsigned, std::size_t begin, std::size_t end)
          {
            for (; begin < end; begin += kPiece)
            {
              const std::size_t piece_end = std::min(begin + kPiece, end);
              Integrate(before_, grips_.empty() ? twists_ : effective_, seconds, begin, piece_end, now_);
              for (std::size_t k = begin; k < std::min(piece_end, count_); ++k)
                placed_[k] = PlaceAt(static_cast<std::uint32_t>(k), now_);
            }
          });
  for (const Grip& grip : grips_) now_.Set(grip.body, Compose(now_.Get(grip.prey), grip.relative));
  for (Follower& follower : followers_)
  {
    const Pose2& from = follower.from;
    const Pose2& goal = follower.goal;
    follower.before =
        fraction < 1 ? Pose2{from.x + fraction * (goal.x - from.x), from.y + fraction * (goal.y - from.y), goal.heading}
                     : goal;
    now_.Set(follower.body, follower.before);
  }
  for (Turret& turret : turrets_)
  {
    const std::uint32_t body = turret.body;
    turret.before = turret_angle_[body];
    const double before_cos = TurretCos(body);
    const double before_sin = turret_sin_[body];
    const double way = leader_[body] == body ? turret.rate * seconds : 0;
    SetTurretAngle(body, turret.before + way);
    if (!turret_cos_before_.empty()) turret_cos_before_[body] = before_cos;
    turret_sin_before_[body] = before_sin;
    turret_way_[body] = way;
  }
  for (const Grip& grip : grips_) placed_[grip.body] = PlaceAt(grip.body, now_);
  for (const Follower& follower : followers_) placed_[follower.body] = PlaceAt(follower.body, now_);
  for (const Turret& turret : turrets_) placed_[turret.body] = PlaceAt(turret.body, now_);
}

// The way forward along the arc: its chord, seen from the mean heading, over sinc of half the turn.
void KinematicWorld::KeepTravelOf(double seconds, std::size_t begin, std::size_t end)
{
  const TwistStore& twists = grips_.empty() ? twists_ : effective_;
  for (std::size_t k = begin; k < end; ++k)
  {
    const Rotor old_heading{before_.z[k], before_.w[k]};
    const Rotor heading{now_.z[k], now_.w[k]};
    const Rotor middle = old_heading * heading;  // half angles of both: the sine and cosine of the mean heading
    const bool turned = old_heading.z != heading.z || old_heading.w != heading.w;
    const std::uint32_t leader = leader_[k];
    const double turn = turned ? twists.turn[leader] * seconds * limiter_.PartOf(TurnMotion(leader)) : 0;
    const double chord = (now_.x[k] - before_.x[k]) * middle.w + (now_.y[k] - before_.y[k]) * middle.z;
    const double half = turn / 2;
    const double sinc = half == 0 ? 1 : SinCosOf(half).sin / half;
    travel_forward_[k] += chord / sinc;
    travel_turn_[k] += turn;
  }
}

}  // namespace swarmanoid::kinematics2d
