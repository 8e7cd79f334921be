#include "engine_worker/engines/kinematics2d/plane_bodies.h"

#include <algorithm>
#include <numeric>

#include "common/math/elementary.h"
#include "engine_worker/engines/kinematics2d/step_constants.h"

namespace swarmanoid::kinematics2d
{

double CoreOf(const CollisionModel& outline)
{
  return std::max(outline.core_radius, kThinnestCore * outline.bounding_radius);
}

// A wide body among narrow ones goes no further in a substep than they do, so that the cells can stay small.
double Bodies::LimitOf(const CollisionModel& outline) const
{
  return kWayInCore * std::min(CoreOf(outline), kWidestCore * median_core);
}

std::vector<double> Bodies::Radii() const
{
  std::vector<double> radii(count);
  for (std::uint32_t body = 0; body < count; ++body) radii[body] = RadiusOf(body);
  return radii;
}

std::uint32_t Bodies::Add(std::uint32_t model_number, const Pose2& pose, bool follower)
{
  const auto body = static_cast<std::uint32_t>(count++);
  now.Resize(PaddedCount(count));
  now.Set(body, pose);
  model.push_back(model_number);
  is_follower.push_back(follower ? 1 : 0);
  is_present.push_back(1);
  if (follower) followers.push_back({body, pose, pose, pose});
  return body;
}

void Bodies::MakeRoom()
{
  const std::size_t padded = PaddedCount(count);
  now.Resize(padded);
  before.Resize(padded);
  twists.Resize(padded);
  inverse_limit.resize(padded, 1);
  for (ZeroedVector<double>* values : {&turret_angle, &turret_sin, &turret_sin_before, &travel_forward, &travel_turn})
    values->resize(count);
  turret_way.assign(count, 0);
  placed.resize(count);
  for (const CollisionModel& shape : statics) placed.push_back({.model = &shape});
}

void Bodies::Renumber(std::span<const Run> runs, std::size_t new_count)
{
  std::vector<std::uint32_t> number_of(count, kNobody);
  for (const Run& run : runs) std::iota(number_of.begin() + run.from, number_of.begin() + run.from + run.count, run.to);
  std::erase_if(turrets, [&](const Turret& turret) { return number_of[turret.body] == kNobody; });
  for (Turret& turret : turrets) turret.body = number_of[turret.body];
  for (Follower& follower : followers) follower.body = number_of[follower.body];

  count = new_count;
  const std::size_t padded = PaddedCount(count);
  for (std::vector<double>* values : {&now.x, &now.y, &now.z, &twists.forward, &twists.left, &twists.turn})
    MoveRuns(runs, count, padded, 0.0, *values);
  for (std::vector<double>* values : {&now.w, &inverse_limit}) MoveRuns(runs, count, padded, 1.0, *values);
  for (ZeroedVector<double>* values : {&turret_angle, &turret_sin, &travel_forward, &travel_turn})
    MoveRuns(runs, count, count, 0.0, *values);
  if (!turret_cos.empty()) MoveRuns(runs, count, count, 1.0, turret_cos);
  MoveRuns(runs, count, count, 0U, model);
  for (std::vector<std::uint8_t>* values : {&is_follower, &is_present})
    MoveRuns(runs, count, count, std::uint8_t{0}, *values);
  turret_cos_before = turret_cos;
  turret_sin_before = turret_sin;
  placed.resize(count);
  MakeRoom();
  for (std::vector<double>* values : {&before.x, &before.y, &before.z, &before.w}) Trim(*values);
  Trim(placed);
  Trim(turret_way);
}

namespace
{

template <class Turrets>
auto FindTurret(Turrets& turrets, std::uint32_t body)
{
  return std::lower_bound(turrets.begin(), turrets.end(), body,
                          [](const Turret& turret, std::uint32_t b) { return turret.body < b; });
}

}  // namespace

const Turret& Bodies::TurretOf(std::uint32_t body) const { return *FindTurret(turrets, body); }

double Bodies::TurretRate(std::uint32_t body) const
{
  const auto at = FindTurret(turrets, body);
  return at != turrets.end() && at->body == body ? at->rate : 0;
}

void Bodies::SetTurretRate(std::uint32_t body, double rate)
{
  const auto at = FindTurret(turrets, body);
  const bool known = at != turrets.end() && at->body == body;
  if (rate == 0)
  {
    if (!known) return;
    turrets.erase(at);
    SetTurretAngle(body, turret_angle[body]);
  }
  else if (known)
    at->rate = rate;
  else
    turrets.insert(at, {body, rate, turret_angle[body]});
}

void Bodies::SetTurretAngle(std::uint32_t body, double angle)
{
  angle = WrapAngle(angle);
  if (turret_cos.empty())
  {
    if (angle == 0) return;
    turret_cos.assign(count, 1);
    turret_cos_before.assign(count, 1);
  }
  turret_angle[body] = angle;
  const SinCos turned = SinCosOf(angle);
  turret_cos[body] = turret_cos_before[body] = turned.cos;
  turret_sin[body] = turret_sin_before[body] = turned.sin;
  turret_way[body] = 0;
}

void Bodies::SwapFollowers()
{
  for (Follower& follower : followers)
  {
    const Pose2 other = before.Get(follower.body);
    before.Set(follower.body, follower.other);
    follower.other = other;
  }
}

}  // namespace swarmanoid::kinematics2d
