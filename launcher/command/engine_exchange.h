// It says what another engine changes for an experiment: `swarmanoid check FILE --engine NAME`.
#pragma once

#include <string>
#include <vector>

#include "common/experiment/load_experiment.h"

namespace swarmanoid
{

struct EngineExchange
{
  std::vector<Diagnostic> errors;   // reasons for which the experiment with that engine would be refused
  std::vector<Diagnostic> changes;  // in the order: engines, devices, entities
};

// Returns the result of `engine` (a tag) in the place of every other engine of a valid experiment. `places`: as in
// LoadedExperiment.
EngineExchange ExchangeEngines(const Experiment& experiment, const std::string& places, const std::string& engine);

}  // namespace swarmanoid
