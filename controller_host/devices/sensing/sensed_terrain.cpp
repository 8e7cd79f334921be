#include "controller_host/devices/sensing/sensed_terrain.h"

#include <algorithm>
#include "common/space/space.h"

namespace swarmanoid
{

SensedTerrain::SensedTerrain(const CSwarmanoidSpace& space)
{
  const Experiment& experiment = space.GetExperiment();
  for (std::uint32_t e = 0; e < experiment.entities.size(); ++e)
  {
    const EntityConfiguration& entity = experiment.entities[e];
    if (DescriptionOf(entity.kind).role != EntityRole::kTerrain) continue;
    auto terrain = LoadTerrain(entity, experiment.folder);
    const Vector3 low = terrain->Low();
    const Vector3 high = terrain->High();
    terrains_.push_back({e, std::move(terrain), entity.pose.Inverse(), low, high});
  }
}

double SensedTerrain::HitOf(const Placed& placed, const Vector3& from, const Vector3& to)
{
  constexpr double kMiss = 2;
  const Vector3 start = placed.to_terrain.Apply(from);
  const Vector3 end = placed.to_terrain.Apply(to);
  // Most lines pass above the whole terrain.
  if (std::min(start.z(), end.z()) > placed.high.z()) return kMiss;
  for (int axis = 0; axis < 2; ++axis)
    if (std::max(start[axis], end[axis]) < placed.low[axis] || std::min(start[axis], end[axis]) > placed.high[axis])
      return kMiss;
  return placed.terrain->SegmentHit(start, end).value_or(kMiss);
}

}  // namespace swarmanoid
