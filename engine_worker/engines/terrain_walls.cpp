#include "engine_worker/engines/terrain_walls.h"

#include <algorithm>

#include "common/space/terrain/terrain.h"

namespace swarmanoid
{

std::vector<std::vector<Vector2>> TerrainWalls(const EntityConfiguration& terrain, const std::string& experiment_folder,
                                               const PlaneFrame& plane)
{
  const Pose local = terrain.pose.Inverse().Compose(plane.Frame());
  const Vector3 normal = local.orientation * Vector3::UnitZ();
  if (normal.z() < 1 - 1e-9)
    throw ConfigurationError(
        terrain.location, "terrain '" + terrain.id +
                              "' is not level with the plane of its two-dimensional engine; turn one of them about a "
                              "vertical axis only, or list the terrain in a three-dimensional engine");

  const double height = local.position.z() + kTerrainStep_m;
  std::vector<std::vector<Vector2>> walls;
  for (const TerrainRectangle& cut : LoadTerrain(terrain, experiment_folder)->Section(height))
  {
    std::vector<Vector2>& wall = walls.emplace_back();
    for (const Vector2& corner :
         {cut.low, Vector2(cut.high.x(), cut.low.y()), cut.high, Vector2(cut.low.x(), cut.high.y())})
    {
      const PlanePose pose =
          plane.ToPlane({terrain.pose.Apply({corner.x(), corner.y(), height}), Quaternion::Identity()});
      wall.emplace_back(pose.u, pose.v);
    }
  }
  return walls;
}

}  // namespace swarmanoid
