// Runs the Init of ARGoS3's loop functions in advance, for the reader of ARGoS3's files (argos3/converter/convert.h).
#pragma once

#include "argos3/converter/convert.h"

namespace swarmanoid
{

// Runs Init of the experiment's loop functions in a process of its own, and returns the bodies that they make. It
// returns none if Init fails; the run then reports why.
argos3::MadeBodies RehearseArgos3(const ConfigurationNode& experiment, const std::string& folder,
                                  const ExperimentSettings& settings);

}  // namespace swarmanoid
