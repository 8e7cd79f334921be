// What an experiment file says without any effect: no mistakes, but perhaps not what its author thinks. Used by
// `swarmanoid check`.
#pragma once

#include <vector>

#include "common/experiment/load_experiment.h"

namespace swarmanoid
{

// Parameters of entities that none of their engines uses, and holes into which nothing can fall; in the order of the
// file, each place once.
std::vector<Diagnostic> NotesOn(const Experiment& experiment);

}  // namespace swarmanoid
