// Where the plane of a two-dimensional engine lies in the space; the parameters are the same for all such engines
// (PlaneParameters, common/builtins).
#pragma once

#include "common/configuration/parameter.h"
#include "engine_worker/engines/plane_frame.h"

namespace swarmanoid
{

PlaneFrame PlaneFrom(const Parameters& parameters);

}  // namespace swarmanoid
