// Finds statements of a study that give one value of the experiment twice in the same run: <set>, <factor>, <variant>,
// and the attributes 'ticks' and 'seeds' of <study>. Only the last one would take effect, and the table would name
// values that were not run.
#pragma once

#include <string>
#include <vector>

#include "studies/design.h"

namespace swarmanoid
{

// One text for each pair, with the places of both. Experiments that cannot be read are left out: loading them tells
// why.
std::vector<std::string> ConflictsIn(const Study& study, const Design& design);

}  // namespace swarmanoid
