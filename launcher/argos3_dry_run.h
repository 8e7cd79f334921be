// A rehearsal of the Init of ARGoS3's loop functions, for the reader of its files (argos3/converter/convert.h).
#pragma once

#include "argos3/converter/convert.h"

namespace swarmanoid
{

// In a process of its own. None if Init fails: whoever runs the experiment is told why.
argos3::MadeBodies RehearseArgos3(const ConfigurationNode& experiment, const std::string& folder,
                                  const ExperimentSettings& settings);

}  // namespace swarmanoid
