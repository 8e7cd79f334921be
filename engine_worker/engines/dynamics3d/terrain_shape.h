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

// Adds the terrain to the world. `pose` is that of the terrain's frame in the frame of the engine.
std::unique_ptr<TerrainShape> AddHeightfield(OdeWorld& world, std::uint32_t entity,
                                             std::shared_ptr<const HeightTerrain> terrain, const Pose& pose);
std::unique_ptr<TerrainShape> AddVoxels(OdeWorld& world, std::uint32_t entity,
                                        std::shared_ptr<const VoxelTerrain> terrain, const Pose& pose);

// These functions take the geom of a solid that AddVoxels made.
double CellSizeOf(dGeomID voxels);
// Returns whether any solid cell may reach into a box (least and largest x, y and z in the frame of the engine).
bool ReachesCells(dGeomID voxels, const std::array<double, 6>& box);

}  // namespace swarmanoid::dynamics3d
