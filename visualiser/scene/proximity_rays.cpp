#include "visualiser/scene/proximity_rays.h"

#include <algorithm>
#include <cmath>
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

bool ReadsProximity(const Experiment& experiment, const EntityConfiguration& robot)
{
  const ControllerConfiguration* controller = experiment.FindController(robot.controller);
  return controller != nullptr && std::any_of(controller->sensors.begin(), controller->sensors.end(),
                                              [](const DeviceConfiguration& sensor) {
                                                return sensor.type == "footbot_proximity" || sensor.type == "proximity";
                                              });
}

}  // namespace

void FindProximityRays(const CSwarmanoidSpace& space, SpaceQuery& query, std::uint32_t robot,
                       std::vector<ProximityRay>& rays)
{
  rays.clear();
  const CSwarmanoidSpaceEntity& entity = space.GetEntity(robot);
  const std::optional<ProximityRing>& ring = DescriptionOf(entity.GetKind()).proximity;
  if (!ring || !ReadsProximity(space.GetExperiment(), entity.GetConfiguration())) return;
  const Pose pose = space.GetPose(robot);
  for (const ProximityRing::Sensor& sensor : ring->sensors)
  {
    const Vector3 direction(std::cos(sensor.direction), std::sin(sensor.direction), 0);
    const Vector3 start(sensor.place.x(), sensor.place.y(), ring->height_m);
    const Vector3 from = pose.Apply(start);
    const Vector3 to = pose.Apply(start + ring->range_m * direction);
    const auto first = query.FindFirstHit(from, to, robot, {&robot, 1});
    rays.push_back({from, to, first ? first->fraction : 1});
  }
}

}  // namespace swarmanoid
