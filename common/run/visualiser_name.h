// The name of the process of a visualisation in a cluster: "visualiser 'text'".
#pragma once

#include <string>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

inline std::string VisualiserName(const RenderConfiguration& render) { return "visualiser '" + render.id + "'"; }

}  // namespace swarmanoid
