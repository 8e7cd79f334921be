#include "controller_host/devices/any_robot/proximity_by_rays.h"

#include <algorithm>

#include "common/space/space.h"

namespace swarmanoid
{

void ProximityByRays::InitRays(const DeviceSetup& setup, std::size_t count, double range_m, double reach_m)
{
  Reset(setup, count);
  noise_ = NoiseFrom(setup.parameters);
  range_m_ = range_m;
  reach_m_ = reach_m;
  world_ = SensorWorld::Of(setup.space);
  fixed_ = std::make_unique<FixedBodies>(setup.space, world_->Bodies(), reach_m);
  remembers_ = !world_->HasArticulated();
  if (remembers_)
    fixed_for_long_ =
        std::make_unique<FixedBodies>(setup.space, world_->Bodies(), reach_m + MovedSince::kMostMargin / 2);
  InitDemand(robots_.size());
}

void ProximityByRays::RefreshShared(WorkerPool* pool)
{
  if (remembers_) world_->Moved().Follow(pool);
  if (!KnowsNear()) world_->Refresh(pool);
}

bool ProximityByRays::KnowsNear() const
{
  return remembers_ && world_->Moved().Holds() && near_since_ == world_->Moved().Number();
}

void ProximityByRays::FindNear()
{
  near_since_ = world_->Moved().Number();
  const double reach = reach_m_ + world_->Moved().Margin();
  const PoseArrays& poses = space_->Poses();
  near_.clear();
  first_remembered_.clear();
  for (const std::uint32_t robot : robots_)
  {
    first_remembered_.push_back(static_cast<std::uint32_t>(near_.size()));
    const auto add = [&](std::uint32_t body) { AddNear(robot, body); };
    world_->Grid().ForEachNear(poses.x[robot], poses.y[robot], reach, add);
    for (const std::uint32_t body : fixed_for_long_->Near(poses.x[robot], poses.y[robot])) add(body);
  }
  first_remembered_.push_back(static_cast<std::uint32_t>(near_.size()));
  remembered_.swap(near_);
}

void ProximityByRays::MakeDue()
{
  if (remembers_ && !KnowsNear() && world_->Moved().IsNow()) FindNear();
  for (std::size_t k = 0; k < robots_.size(); ++k)
    if (IsDue(k)) Sense(k);
}

bool ProximityByRays::MakeAlone(std::size_t k)
{
  Sense(k);
  return true;
}

void ProximityByRays::Sense(std::size_t k)
{
  const std::uint32_t robot = robots_[k];
  const PoseArrays& poses = space_->Poses();
  near_.clear();
  if (KnowsNear())
    for (std::uint32_t i = first_remembered_[k]; i < first_remembered_[k + 1]; ++i)
    {
      const std::uint32_t body = remembered_[i];
      const double dx = poses.x[body] - poses.x[robot];
      const double dy = poses.y[body] - poses.y[robot];
      const double reach = reach_m_ + world_->Body(body).radius;
      if (dx * dx + dy * dy <= reach * reach) near_.push_back(body);
    }
  else
  {
    const auto add = [&](std::uint32_t body) { AddNear(robot, body); };
    world_->Grid().ForEachNear(poses.x[robot], poses.y[robot], reach_m_, add);
    for (const std::uint32_t body : fixed_->Near(poses.x[robot], poses.y[robot])) add(body);
  }
  if (near_.empty() && world_->Terrain().IsEmpty())
    std::fill_n(ValuesOf(k), width_, 0.0);
  else
    CastRays(k);
  if (!noise_.IsActive()) return;
  AddNoise(k);
  for (std::size_t i = 0; i < width_; ++i) ValuesOf(k)[i] = std::clamp(ValuesOf(k)[i], 0.0, 1.0);
}

void ProximityByRays::CastRays(std::size_t k)
{
  const std::uint32_t robot = robots_[k];
  const Pose pose = space_->GetPose(robot);
  const auto is_there = [&](std::uint32_t terrain) { return world_->Membership().ShareEngine(robot, terrain); };
  double* reading = ValuesOf(k);
  for (const ProximitySensorRay& ray : RaysOf(k))
  {
    const Vector3 from = pose.Apply(ray.from);
    const Vector3 to = pose.Apply(ray.from + range_m_ * ray.direction);
    double nearest = 1;
    for (const std::uint32_t body : near_)
      if (const auto hit = world_->HitOn(body, from, to)) nearest = std::min(nearest, *hit);
    if (!world_->Terrain().IsEmpty()) nearest = std::min(nearest, world_->Terrain().FirstHit(from, to, is_there));
    *reading++ = 1 - nearest;
  }
}

}  // namespace swarmanoid
