// Finds content of an experiment file that has no effect. It is no mistake, but perhaps not what the author intends.
// `swarmanoid check` uses it.
#pragma once

#include <vector>

#include "common/experiment/load_experiment.h"

namespace swarmanoid
{

// Returns robots without a controller, engines without entities, parameters of entities that none of their engines
// uses, and holes into which nothing can fall. Each position occurs once.
std::vector<Diagnostic> NotesOn(const Experiment& experiment);

}  // namespace swarmanoid
