// KinematicWorld::HoldBack: those who overlap more than at the beginning of a substep go back.
#include <algorithm>

#include "common/math/elementary.h"
#include "engine_worker/engines/kinematics2d/kinematic_limits.h"
#include "engine_worker/engines/kinematics2d/kinematic_world.h"

namespace swarmanoid::kinematics2d
{
namespace
{

// Cells are asked for this many bodies before they are needed.
constexpr std::size_t kFarAhead = 6;

}  // namespace

// The solver's sweeps may end before a dense crowd is at peace. Where the step began there was no such overlap, so
// those that still overlap go back: first to their old position, turned as commanded; if that does not help, all the
// way. Each one held may stand in the way of others, until nobody overlaps more than when the step began.
void KinematicWorld::HoldBack()
{
  queue_.clear();
  solver_.ForEachDeeper(allowed_, now_.x, now_.y,
                        [this](std::uint32_t first, std::uint32_t second)
                        {
                          Enqueue(first);
                          Enqueue(second);
                        });
  EnqueueThosePushedFar();

  held_.clear();
  for (std::size_t n = 0; n < queue_.size(); ++n)
  {
    const std::uint32_t leader = queue_[n];
    is_queued_[leader] = 0;
    HoldFromOthers(leader);
    for (const Grip& grip : grips_)
      if (grip.prey == leader) HoldFromOthers(grip.body);
  }
  statistics_.held_back += held_.size();
  for (const std::uint32_t leader : held_) hold_[leader] = Hold::kFree;
}

void KinematicWorld::Enqueue(std::uint32_t leader)
{
  if (leader == count_ || is_queued_[leader] != 0) return;
  is_queued_[leader] = 1;
  queue_.push_back(leader);
}

// Into `near_`: those pushed so far that they may have met outlines that were no contacts yet, each with everybody
// whose bounding circle now meets its own. Those near static shapes are queued at once: they are few.
void KinematicWorld::ListNearThosePushedFar()
{
  far_.clear();
  const double far = std::min(kContactMargin, reach_) / 2;
  for (const PushedLeader& pushed : solver_.Pushed())
  {
    const double dx = now_.x[pushed.leader] - pushed.x;
    const double dy = now_.y[pushed.leader] - pushed.y;
    if (dx * dx + dy * dy <= far * far) continue;
    far_.push_back(pushed.leader);
    for (const Grip& grip : grips_)
      if (grip.prey == pushed.leader) far_.push_back(grip.body);
  }

  // Each stage asks ahead for what the next one needs: in large crowds it is not in the cache.
  near_.clear();
  for (std::size_t n = 0; n < far_.size(); ++n)
  {
    const std::uint32_t ahead = far_[std::min(n + kFarAhead, far_.size() - 1)];
    broad_.PrefetchNear(now_.x[ahead], now_.y[ahead]);
    const std::uint32_t body = far_[n];
    ForEachNear(body,
                [&](std::uint32_t other)
                {
                  if (other == body) return;
                  near_.push_back({body, other});
                  __builtin_prefetch(&now_.x[other]);
                  __builtin_prefetch(&now_.y[other]);
                  __builtin_prefetch(&radius_[other]);
                });
    broad_.ForEachStaticNear(body, now_.x[body], now_.y[body], [&](std::uint32_t) { Enqueue(leader_[body]); });
  }
  std::size_t kept = 0;
  for (const auto [body, other] : near_)
  {
    near_[kept] = {body, other};
    if (!CirclesMeet(body, other)) continue;
    ++kept;
    __builtin_prefetch(&placed_[body]);
    __builtin_prefetch(&placed_[other]);
  }
  near_.resize(kept);
}

// Those pushed far who overlap others now. Few do: they are looked at in batches.
void KinematicWorld::EnqueueThosePushedFar()
{
  ListNearThosePushedFar();
  PairBatch batch;
  const auto look = [&]
  {
    if (batch.Count() == 0) return;
    batch.FindTouches(-allowed_);
    for (std::size_t lane = 0; lane < batch.Count(); ++lane)
      if (batch.Deepest(lane) > allowed_) Enqueue(leader_[NumberOf(batch.First(lane))]);
    batch.Clear();
  };
  for (const auto [body, other] : near_)
  {
    MovePlaced(body);
    MovePlaced(other);
    if (batch.IsFull() || !batch.Takes(placed_[body], placed_[other])) look();
    batch.Add(placed_[body], placed_[other]);
  }
  look();
}

// The others have moved by up to `reach_` since they were sorted into cells.
template <class Act>
void KinematicWorld::ForEachNear(std::uint32_t body, const Act& act) const
{
  broad_.ForEachNear(now_.x[body], now_.y[body], radius_[body] + reach_, act);
}

void KinematicWorld::HoldFromOthers(std::uint32_t body)
{
  ForEachNear(body,
              [&](std::uint32_t other)
              {
                if (other != body) HoldPair(body, other);
              });
  broad_.ForEachStaticNear(body, now_.x[body], now_.y[body], [&](std::uint32_t shape) { HoldFromStatic(body, shape); });
}

bool KinematicWorld::CirclesMeet(std::uint32_t a, std::uint32_t b) const
{
  const double dx = now_.x[a] - now_.x[b];
  const double dy = now_.y[a] - now_.y[b];
  const double limit = radius_[a] + radius_[b];
  return dx * dx + dy * dy <= limit * limit;
}

// Those that were put into each other have no better place to go back to; the solver parts them step by step.
bool KinematicWorld::MustNotOverlap(double overlap, double before) const
{
  return before <= 2 * allowed_ && overlap > before;
}

void KinematicWorld::HoldPair(std::uint32_t a, std::uint32_t b)
{
  if (!CirclesMeet(a, b)) return;
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
  const Placed& fixed = placed_[count_ + shape];
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
  Enqueue(leader);
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

}  // namespace swarmanoid::kinematics2d
