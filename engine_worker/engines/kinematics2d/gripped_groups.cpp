// Problem: the wheels of several robots pull at one prey. With which twist does the group go?
//
// Method: the rigid motion that comes nearest, in the least-squares sense, to what the wheels of all members would do.
// Let member k stand at p_k in the frame of the prey, and let v_k and w_k be its own velocity and turn in that frame.
// The wheels stand an arm a left and right of its centre, so that turning weighs a^2. The velocity v of the centroid
// and the turn w minimise
//     sum of |v + w x (p_k - p) - v_k|^2 + a^2 (w - w_k)^2,      p = mean of p_k,
// which gives v = mean of v_k and w = sum of ((p_k - p) x v_k + a^2 w_k) / sum of (|p_k - p|^2 + a^2).
//
// Invariant: grips are in the order of IsBefore, so that sums have one order in all processes.
#include "engine_worker/engines/kinematics2d/gripped_groups.h"

#include <tuple>

#include "engine_worker/engines/kinematics2d/step_constants.h"

namespace swarmanoid::kinematics2d
{
namespace
{

// Returns the twist in the frame of the prey, in which the members do not move.
Twist TwistOfMember(const Bodies& bodies, const Grip& grip)
{
  const Twist own = bodies.twists.Get(grip.body);
  const double c = CosOf(grip.relative.heading);
  const double s = SinOf(grip.relative.heading);
  return {c * own.forward - s * own.left, s * own.forward + c * own.left, own.turn};
}

Twist GroupTwist(const Bodies& bodies, std::span<const Grip> members)
{
  const double count = static_cast<double>(members.size());
  double centre_x = 0, centre_y = 0, velocity_x = 0, velocity_y = 0;
  for (const Grip& grip : members)
  {
    const Twist v = TwistOfMember(bodies, grip);
    centre_x += grip.relative.x / count;
    centre_y += grip.relative.y / count;
    velocity_x += v.forward / count;
    velocity_y += v.left / count;
  }
  double turning = 0, inertia = 0;
  for (const Grip& grip : members)
  {
    const Twist v = TwistOfMember(bodies, grip);
    const double x = grip.relative.x - centre_x;
    const double y = grip.relative.y - centre_y;
    turning += x * v.left - y * v.forward + kGripArm * kGripArm * v.turn;
    inertia += x * x + y * y + kGripArm * kGripArm;
  }
  const double turn = turning / inertia;
  return {velocity_x + turn * centre_y, velocity_y - turn * centre_x, turn};
}

}  // namespace

bool IsBefore(const Grip& a, const Grip& b) { return std::tie(a.prey, a.body) < std::tie(b.prey, b.body); }

void Groups::Rebuild(const Bodies& bodies)
{
  leader.resize(bodies.count + 1);
  mobility.resize(bodies.count + 1);
  for (std::uint32_t k = 0; k <= bodies.count; ++k)
  {
    leader[k] = k;
    mobility[k] = k == bodies.count || bodies.IsFollower(k) ? 0 : 1;
  }
  starts.clear();
  for (std::size_t k = 0; k < grips.size(); ++k)
  {
    leader[grips[k].body] = grips[k].prey;
    if (k == 0 || grips[k].prey != grips[k - 1].prey) starts.push_back(static_cast<std::uint32_t>(k));
  }
  starts.push_back(static_cast<std::uint32_t>(grips.size()));
  // A group weighs as much as its members and the prey together.
  ForEach([&](std::span<const Grip> members)
          { mobility[members.front().prey] = 1.0 / static_cast<double>(1 + members.size()); });
}

const Grip* Groups::FindGrip(std::uint32_t body) const
{
  if (leader[body] == body) return nullptr;
  // The leader of a gripped body is the body that it holds.
  const auto found = std::lower_bound(grips.begin(), grips.end(), Grip{body, leader[body], {}}, IsBefore);
  return found == grips.end() || found->body != body ? nullptr : &*found;
}

std::span<const Grip> Groups::GripsOf(std::uint32_t prey) const
{
  const auto group = std::equal_range(grips.begin(), grips.end(), Grip{0, prey, {}},
                                      [](const Grip& a, const Grip& b) { return a.prey < b.prey; });
  return {group.first, group.second};
}

void FindGroupTwists(const Bodies& bodies, Groups& groups)
{
  if (groups.grips.empty()) return;
  groups.with_groups = bodies.twists;
  groups.ForEach(
      [&](std::span<const Grip> members)
      {
        for (const Grip& grip : members) groups.with_groups.Set(grip.body, {});
        groups.with_groups.Set(members.front().prey, GroupTwist(bodies, members));
      });
}

}  // namespace swarmanoid::kinematics2d
