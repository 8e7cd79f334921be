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
  InitDemand(robots_.size());
}

void ProximityByRays::RefreshShared(WorkerPool* pool) { world_->Refresh(pool); }

void ProximityByRays::MakeDue()
{
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
  const Pose pose = space_->GetPose(robot);
  near_.clear();
  const auto add = [&](std::uint32_t body)
  {
    if (body != robot && world_->Membership().ShareEngine(robot, body)) near_.push_back(body);
  };
  world_->Grid().ForEachNear(pose.position.x(), pose.position.y(), reach_m_, add);
  for (const std::uint32_t body : fixed_->Near(pose.position.x(), pose.position.y())) add(body);
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
  if (!noise_.IsActive()) return;
  AddNoise(k);
  for (std::size_t i = 0; i < width_; ++i) ValuesOf(k)[i] = std::clamp(ValuesOf(k)[i], 0.0, 1.0);
}

}  // namespace swarmanoid
