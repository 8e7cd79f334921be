// Problem: decide for how long neighbours found once stay valid.
//
// Method: positions at the reference tick are kept. While no body went farther than half the margin, and the same
// bodies are in the arena, the neighbours hold. When they cease to hold, the margin is set so that the bodies, at the
// speed that they had, need about kAim ticks to use it up.
//
// Invariant: the decision depends on positions and ticks alone, so all threads and processes take the same one.
#include "controller_host/devices/sensing/moved_since.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/math/lanes.h"
#include "controller_host/devices/sensing/body_shapes.h"

namespace swarmanoid
{
namespace
{

constexpr double kAim = 8;  // ticks that a margin is made for
// The first margin (m) assumes bodies of 5 cm/s in ticks of 0.1 s.
constexpr double kFirstMargin = 0.08;
constexpr double kLeastMargin = 0.01;

}  // namespace

void MovedSince::Follow(WorkerPool* pool)
{
  if (revision_ == space_.Revision()) return;
  revision_ = space_.Revision();
  is_now_ = false;
  if (!lifetime_.BeginStep()) return;
  if (x_.empty())
  {
    x_.resize(bodies_.size());
    y_.resize(bodies_.size());
    margin_ = kFirstMargin;
  }
  furthest_.assign(pool == nullptr ? 1 : pool->Parts(), 0);
  InParts(pool, bodies_.size(), 8,
          [&](unsigned part, std::size_t begin, std::size_t end) { furthest_[part] = FurthestSquare(begin, end); });
  const double furthest = std::sqrt(*std::max_element(furthest_.begin(), furthest_.end()));
  if (Holds() && furthest <= margin_ / 2 && std::ranges::equal(absent_, space_.Absent())) return;

  // A body that was put elsewhere says nothing about the speed of the bodies.
  if (Holds())
    margin_ = std::clamp(2 * kAim * std::min(furthest, margin_) / lifetime_.Age(), kLeastMargin, kMostMargin);
  const bool all_upright = std::isfinite(furthest);
  if (!all_upright) return lifetime_.Pause();
  if (lifetime_.Renew()) Begin();
}

double MovedSince::FurthestSquare(std::size_t begin, std::size_t end) const
{
  const PoseArrays& poses = space_.Poses();
  double furthest = 0, tilt = 0;
  std::size_t k = begin;
  // Consecutive bodies are processed several at a time.
  if (begin < end && bodies_[end - 1] - bodies_[begin] == end - 1 - begin)
  {
    DoubleLanes furthest_of{}, tilt_of{};
    for (std::size_t entity = bodies_[begin]; k + kDoubleLanes <= end; k += kDoubleLanes, entity += kDoubleLanes)
    {
      const DoubleLanes dx = LoadLanes(&poses.x[entity]) - LoadLanes(&x_[k]);
      const DoubleLanes dy = LoadLanes(&poses.y[entity]) - LoadLanes(&y_[k]);
      const DoubleLanes qx = LoadLanes(&poses.qx[entity]);
      const DoubleLanes qy = LoadLanes(&poses.qy[entity]);
      const DoubleLanes square = dx * dx + dy * dy;
      furthest_of = square > furthest_of ? square : furthest_of;
      tilt_of += (qx > 0 ? qx : -qx) + (qy > 0 ? qy : -qy);
    }
    for (std::size_t lane = 0; lane < kDoubleLanes; ++lane)
    {
      furthest = std::max(furthest, furthest_of[lane]);
      tilt += tilt_of[lane];
    }
  }
  for (; k < end; ++k)
  {
    const std::size_t entity = bodies_[k];
    const double dx = poses.x[entity] - x_[k];
    const double dy = poses.y[entity] - y_[k];
    furthest = std::max(furthest, dx * dx + dy * dy);
    tilt += IsUpright(poses, entity) ? 0 : 1;
  }
  return tilt > 0 ? std::numeric_limits<double>::infinity() : furthest;
}

void MovedSince::Begin()
{
  const PoseArrays& poses = space_.Poses();
  for (std::size_t k = 0; k < bodies_.size(); ++k)
  {
    x_[k] = poses.x[bodies_[k]];
    y_[k] = poses.y[bodies_[k]];
  }
  absent_.assign(space_.Absent().begin(), space_.Absent().end());
  ++number_;
  is_now_ = true;
}

}  // namespace swarmanoid
