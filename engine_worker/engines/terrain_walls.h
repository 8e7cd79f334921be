// Terrain in a two-dimensional engine: it is a wall if it is higher above the plane than a wheel can climb.
#pragma once

#include <string>
#include <vector>

#include "common/experiment/experiment.h"
#include "engine_worker/engines/plane_frame.h"

namespace swarmanoid
{

// How far above the plane (m) the terrain is cut: lower steps are driven over.
inline constexpr double kTerrainStep_m = 0.02;

// Returns the cut as rectangles, counter-clockwise in (u, v). Throws ConfigurationError if the plane is not parallel to
// the terrain's own ground, or its file cannot be read.
std::vector<std::vector<Vector2>> TerrainWalls(const EntityConfiguration& terrain, const std::string& experiment_folder,
                                               const PlaneFrame& plane);

}  // namespace swarmanoid
