// The parameters that place the plane of a two-dimensional engine in the space; the same for all such engines.
#pragma once

#include <vector>

#include "common/configuration/parameter.h"
#include "engine_worker/engines/plane_frame.h"

namespace swarmanoid
{

// perpendicular_axis, distance, tilt.
std::vector<ParameterSpec> PlaneParameters();
PlaneFrame PlaneFrom(const Parameters& parameters);

}  // namespace swarmanoid
