// Uneven ground as solids of the dynamics3d engine: a height for each point of a grid (rolling ground), or cells of
// which some are solid (buildings, caves, OctoMaps). Made once, before the engine starts.
#pragma once

#include <memory>

#include "common/space/terrain/terrain.h"
#include "engine_worker/engines/dynamics3d/ode_world.h"

namespace swarmanoid::dynamics3d
{

// The memory behind a terrain's solid. It must outlive the world.
class TerrainShape
{
public:
  virtual ~TerrainShape() = default;
};

// `pose`: of the terrain's frame in the frame of the engine.
std::unique_ptr<TerrainShape> AddHeightfield(OdeWorld& world, std::uint32_t entity,
                                             std::shared_ptr<const HeightTerrain> terrain, const Pose& pose);
std::unique_ptr<TerrainShape> AddVoxels(OdeWorld& world, std::uint32_t entity,
                                        std::shared_ptr<const VoxelTerrain> terrain, const Pose& pose);

}  // namespace swarmanoid::dynamics3d
