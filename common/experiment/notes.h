// Finds content of an experiment file that has no effect. It is no mistake, but perhaps not what the author intends.
// Used by `swarmanoid check`.
#pragma once

#include <vector>

#include "common/experiment/load_experiment.h"

namespace swarmanoid
{

// Returns parameters of entities that none of their engines uses, and holes into which nothing can fall. They are in
// the order of the file, each position once.
std::vector<Diagnostic> NotesOn(const Experiment& experiment);

}  // namespace swarmanoid
