// Finds statements of a study that set one value of the experiment twice in the same run: <set>, <factor>, <variant>,
// and the attributes 'ticks' and 'seeds' of <study>. Only the last one would take effect, and the table would name
// values that were not run.
#pragma once

#include <string>
#include <vector>

#include "studies/design/design.h"

namespace swarmanoid
{

// Returns one text for each pair, with the positions of both. Experiments that cannot be read are skipped, since
// loading them reports the reason.
std::vector<std::string> ConflictsIn(const Study& study, const Design& design);

}  // namespace swarmanoid
