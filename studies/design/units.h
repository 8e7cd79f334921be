// The units of a study's factors and metrics, for the axes and tables of pictures.
#pragma once

#include <map>
#include <string>

#include "studies/design/design.h"

namespace swarmanoid
{

// Returns the unit of each factor, and of each column of the metrics, that has one. A factor has the unit of the
// parameter that it sets first, if the plug-ins of the experiment are loaded.
std::map<std::string, std::string> UnitsOf(const Study& study, const Design& design);

}  // namespace swarmanoid
