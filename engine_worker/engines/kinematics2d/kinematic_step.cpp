// KinematicWorld::Advance: move all, find who meets, push apart, hold back those who still overlap.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/math/elementary.h"
#include "engine_worker/engines/kinematics2d/kinematic_limits.h"
#include "engine_worker/engines/kinematics2d/kinematic_world.h"
#include "engine_worker/engines/kinematics2d/vectors.h"

namespace swarmanoid::kinematics2d
{
void KinematicWorld::Advance(double seconds, int steps)
{
  if (keeps_travel_)
  {
    std::fill(travel_forward_.begin(), travel_forward_.end(), 0.0);
    std::fill(travel_turn_.begin(), travel_turn_.end(), 0.0);
  }
  if (!grips_.empty())
  {
    effective_ = twists_;
    for (std::size_t g = 0; g + 1 < group_start_.size(); ++g)
    {
      const std::span<const Grip> members(&grips_[group_start_[g]], group_start_[g + 1] - group_start_[g]);
      for (const Grip& grip : members) effective_.Set(grip.body, {});
      effective_.Set(members.front().prey, GroupTwist(members));
    }
  }
  const int substeps = Substeps(seconds, steps);
  statistics_ = {};
  statistics_.substeps = substeps;
  for (int k = 1; k <= substeps; ++k) Substep(seconds / substeps, static_cast<double>(k) / substeps);
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
  Doubles most_ratio{}, most_speed{};
  for (std::size_t k = 0; k < count_; k += kDoubles)
  {
    const Doubles forward = LoadDoubles(&twists.forward[k]);
    const Doubles left = LoadDoubles(&twists.left[k]);
    const Doubles inverse_limit = LoadDoubles(&inverse_limit_[k]);
    const Doubles speed = forward * forward + left * left;
    const Doubles ratio = speed * (inverse_limit * inverse_limit);
    most_ratio = ratio > most_ratio ? ratio : most_ratio;
    most_speed = speed > most_speed ? speed : most_speed;
  }
  double ratio = 0, way = 0;
  for (std::size_t lane = 0; lane < kDoubles; ++lane)
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
    consider(speed * seconds, core_limit_[grip.body]);
  }
  for (const Follower& follower : followers_)
  {
    const double dx = follower.goal.x - follower.from.x;
    const double dy = follower.goal.y - follower.from.y;
    consider(std::sqrt(dx * dx + dy * dy), core_limit_[follower.body]);
  }

  if (!(ratio <= kMostSubsteps))
    throw std::runtime_error("a body is told to move " + std::to_string(way) + " m in " + std::to_string(seconds) +
                             " s; the kinematic engine follows up to " +
                             std::to_string(kMostSubsteps * smallest_limit_) + " m in that time");
  const int needed = static_cast<int>(std::ceil(ratio / steps));
  const int substeps = steps * std::max(needed, 1);
  reach_ = 2 * way / substeps + kSlowestSeparation;
  return substeps;
}

void KinematicWorld::Substep(double seconds, double fraction)
{
  Move(seconds, fraction);
  const double margin = std::min(kContactMargin, reach_);
  broad_.FindPairs(now_, present_, margin, pool_.get());
  FindContacts(margin);
  if (solver_.HasOverlaps())
  {
    solver_.Solve(mobility_, kSolverTolerance * allowed_, reach_, now_.x, now_.y);
    for (const Grip& grip : grips_) now_.Set(grip.body, Compose(now_.Get(grip.prey), grip.relative));
    HoldBack();
  }
  if (keeps_travel_)
    InParts(pool_.get(), count_, 1,
            [&](unsigned, std::size_t begin, std::size_t end) { KeepTravelOf(seconds, begin, end); });
  statistics_.pairs = broad_.Pairs().size() + broad_.StaticPairs().size();
  statistics_.contacts = solver_.Contacts().size();
}

void KinematicWorld::Move(double seconds, double fraction)
{
  std::swap(now_, before_);
  InParts(pool_.get(), PaddedCount(count_), kPadding,
          [&](unsigned, std::size_t begin, std::size_t end)
          { Integrate(before_, grips_.empty() ? twists_ : effective_, seconds, begin, end, now_); });
  for (const Grip& grip : grips_) now_.Set(grip.body, Compose(now_.Get(grip.prey), grip.relative));
  for (const Follower& follower : followers_)
  {
    const Pose2& from = follower.from;
    const Pose2& goal = follower.goal;
    now_.Set(follower.body, fraction < 1 ? Pose2{from.x + fraction * (goal.x - from.x),
                                                 from.y + fraction * (goal.y - from.y), goal.heading}
                                         : goal);
  }
  for (Turret& turret : turrets_)
  {
    turret.before = turret_angle_[turret.body];
    if (leader_[turret.body] == turret.body) SetTurretAngle(turret.body, turret.before + turret.rate * seconds);
  }
}

// Each thread some of the pairs, in their order; then one after the other into the solver.
void KinematicWorld::FindContacts(double margin)
{
  solver_.Clear();
  const auto to_solver = [this](const Contact& contact) { solver_.Add(contact, contact.touch.depth > 0); };
  for (std::vector<Contact>& contacts : contacts_of_others_) contacts.clear();
  InParts(pool_.get(), broad_.Pairs().size(), 1,
          [&](unsigned part, std::size_t begin, std::size_t end)
          {
            if (part == 0) return FindContacts(margin, begin, end, to_solver);
            std::vector<Contact>& contacts = contacts_of_others_[part - 1];
            FindContacts(margin, begin, end, [&](const Contact& contact) { contacts.push_back(contact); });
          });
  for (const std::vector<Contact>& contacts : contacts_of_others_) solver_.Add(contacts);

  Touches touches;
  Spot first, second;
  for (const Pair& pair : broad_.StaticPairs())
  {
    if (mobility_[leader_[pair.first]] <= 0) continue;
    PlaceAt(pair.first, now_, first.placed);
    second.placed.model = &statics_[pair.second];
    Spread(first);
    Spread(second);
    FindTouches(first, second, margin, touches);
    AddContacts(pair.first, static_cast<std::uint32_t>(count_), touches, to_solver);
  }
}

template <class Add>
void KinematicWorld::FindContacts(double margin, std::size_t begin, std::size_t end, const Add& add) const
{
  Touches touches;
  Spot first, second;
  for (std::size_t n = begin; n < end; ++n)
  {
    const std::uint32_t a = broad_.Pairs()[n].first;
    const std::uint32_t b = broad_.Pairs()[n].second;
    if (leader_[a] == leader_[b] || mobility_[leader_[a]] + mobility_[leader_[b]] <= 0) continue;
    PlaceAt(a, now_, first.placed);
    PlaceAt(b, now_, second.placed);
    Spread(first);
    Spread(second);
    FindTouches(first, second, margin, touches);
    AddContacts(a, b, touches, add);
  }
}

template <class Add>
void KinematicWorld::AddContacts(std::uint32_t first, std::uint32_t second, const Touches& touches,
                                 const Add& add) const
{
  if (touches.Count() == 0) return;
  const std::uint32_t i = leader_[first];
  const std::uint32_t j = leader_[second];
  // From the difference of the leaders to that of the bodies.
  const double dx = now_.x[i] - now_.x[j];
  const double dy = now_.y[i] - now_.y[j];
  double shift_x = 0;
  double shift_y = 0;
  if (i != first || j != second)
  {
    shift_x = (now_.x[first] - now_.x[second]) - dx;
    shift_y = (now_.y[first] - now_.y[second]) - dy;
  }
  for (int k = 0; k < touches.Count(); ++k)
  {
    Contact contact{i, j, touches[k], 0};
    Touch& touch = contact.touch;
    if (touch.face)
      touch.reach -= shift_x * touch.x + shift_y * touch.y;
    else
    {
      touch.x += shift_x;
      touch.y += shift_y;
    }
    if (touch.depth > 0)
    {
      const double length = touch.reach - touch.depth;
      const double nx = touch.face ? touch.x : length > 0 ? (dx + touch.x) / length : 1;
      const double ny = touch.face ? touch.y : length > 0 ? (dy + touch.y) / length : 0;
      const double way_x = dx - (before_.x[i] - before_.x[j]);
      const double way_y = dy - (before_.y[i] - before_.y[j]);
      contact.bounce = elasticity_ * std::min(touch.depth, std::max(0.0, -(way_x * nx + way_y * ny)));
    }
    add(contact);
  }
}

// The solver's sweeps may end before a dense crowd is at peace. Where the step began there was no such overlap, so
// those that still overlap go back: first to their old position, turned as they wish; if that does not help, all the
// way. Each one held may stand in the way of others, until nobody overlaps more than when the step began.
void KinematicWorld::HoldBack()
{
  suspects_.clear();
  for (const Contact& contact : solver_.Contacts())
    if ((solver_.WasPushed(contact.first) || solver_.WasPushed(contact.second)) &&
        DepthOf(contact.touch, now_.x[contact.first] - now_.x[contact.second],
                now_.y[contact.first] - now_.y[contact.second]) > allowed_)
    {
      Suspect(contact.first);
      Suspect(contact.second);
    }
  // Pushed so far that it may have met outlines that were no contacts yet.
  const double far = std::min(kContactMargin, reach_) / 2;
  for (const PushedLeader& pushed : solver_.Pushed())
  {
    const double dx = now_.x[pushed.leader] - pushed.x;
    const double dy = now_.y[pushed.leader] - pushed.y;
    if (dx * dx + dy * dy > far * far) Suspect(pushed.leader);
  }

  held_.clear();
  for (std::size_t n = 0; n < suspects_.size(); ++n)
  {
    const std::uint32_t leader = suspects_[n];
    is_suspect_[leader] = 0;
    HoldFromOthers(leader);
    for (const Grip& grip : grips_)
      if (grip.prey == leader) HoldFromOthers(grip.body);
  }
  statistics_.held_back += held_.size();
  for (const std::uint32_t leader : held_) hold_[leader] = Hold::kFree;
}

void KinematicWorld::Suspect(std::uint32_t leader)
{
  if (leader == count_ || is_suspect_[leader] != 0) return;
  is_suspect_[leader] = 1;
  suspects_.push_back(leader);
}

void KinematicWorld::HoldFromOthers(std::uint32_t body)
{
  // The others have moved by up to `reach_` since they were sorted into cells.
  const double x = now_.x[body];
  const double y = now_.y[body];
  broad_.ForEachNear(x, y, radius_[body] + broad_.LargestSmallRadius() + reach_,
                     [&](std::uint32_t other)
                     {
                       if (other != body) HoldPair(body, other);
                     });
  broad_.ForEachStaticNear(body, now_.x[body], now_.y[body], [&](std::uint32_t shape) { HoldFromStatic(body, shape); });
}

// Those that were put into each other have no better place to go back to; the solver parts them step by step.
bool KinematicWorld::MustNotOverlap(double overlap, double before) const
{
  return before <= 2 * allowed_ && overlap > before;
}

void KinematicWorld::HoldPair(std::uint32_t a, std::uint32_t b)
{
  const double dx = now_.x[a] - now_.x[b];
  const double dy = now_.y[a] - now_.y[b];
  const double limit = radius_[a] + radius_[b];
  if (dx * dx + dy * dy > limit * limit) return;
  const std::uint32_t i = leader_[a];
  const std::uint32_t j = leader_[b];
  // What a follower does is not to be undone.
  if (i == j || mobility_[i] <= 0 || mobility_[j] <= 0) return;
  if (hold_[i] == Hold::kPose && hold_[j] == Hold::kPose) return;
  const double overlap = Overlap(PlaceAt(a, now_), PlaceAt(b, now_));
  if (overlap <= allowed_ || !MustNotOverlap(overlap, Overlap(PlaceBefore(a), PlaceBefore(b)))) return;
  RaiseHold(i);
  RaiseHold(j);
}

void KinematicWorld::HoldFromStatic(std::uint32_t body, std::uint32_t shape)
{
  const std::uint32_t leader = leader_[body];
  if (mobility_[leader] <= 0 || hold_[leader] == Hold::kPose) return;
  const Placed fixed{&statics_[shape], 0, 0, 1, 0, 1, 0};
  const double overlap = Overlap(PlaceAt(body, now_), fixed);
  if (overlap <= allowed_ || !MustNotOverlap(overlap, Overlap(PlaceBefore(body), fixed))) return;
  RaiseHold(leader);
}

void KinematicWorld::RaiseHold(std::uint32_t leader)
{
  if (hold_[leader] == Hold::kPose) return;
  if (hold_[leader] == Hold::kFree) held_.push_back(leader);
  const bool first = hold_[leader] == Hold::kFree;
  hold_[leader] = first ? Hold::kPosition : Hold::kPose;
  Suspect(leader);
  now_.x[leader] = before_.x[leader];
  now_.y[leader] = before_.y[leader];
  if (!first)
  {
    now_.z[leader] = before_.z[leader];
    now_.w[leader] = before_.w[leader];
    const auto turret = FindTurret(leader);
    if (turret != turrets_.end() && turret->body == leader) SetTurretAngle(leader, turret->before);
  }
  for (const Grip& grip : grips_)
    if (grip.prey == leader) now_.Set(grip.body, Compose(now_.Get(leader), grip.relative));
}

Placed KinematicWorld::PlaceBefore(std::uint32_t body) const
{
  Placed placed = PlaceAt(body, before_);
  const auto turret = const_cast<KinematicWorld*>(this)->FindTurret(body);
  if (turret != turrets_.end() && turret->body == body)
  {
    const SinCos turned = SinCosOf(turret->before);
    placed.turret_cos = turned.cos;
    placed.turret_sin = turned.sin;
  }
  return placed;
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
    const double turn = turned ? twists.turn[leader_[k]] * seconds : 0;
    const double chord = (now_.x[k] - before_.x[k]) * middle.w + (now_.y[k] - before_.y[k]) * middle.z;
    const double half = turn / 2;
    const double sinc = half == 0 ? 1 : SinCosOf(half).sin / half;
    travel_forward_[k] += chord / sinc;
    travel_turn_[k] += turn;
  }
}

}  // namespace swarmanoid::kinematics2d
