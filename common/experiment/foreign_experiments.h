// Experiment files of other simulators. Who can read them says so at the start of the process, by the name of their
// root element; from then on they are read like ours, and every mistake names its place in them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/experiment/load_experiment.h"

namespace swarmanoid
{

// Our tree for theirs; each element keeps the place that it came from. `folder`: of the file. `settings`: what will be
// set in our tree, for those who run something of it. What is wrong goes into `mistakes`; then the tree is not used.
using ExperimentConverter = std::function<std::shared_ptr<const ConfigurationNode>(
    const ConfigurationNode& root, const std::string& folder, const ExperimentSettings& settings,
    std::vector<Diagnostic>& mistakes)>;

void AddExperimentConverter(const std::string& root, ExperimentConverter converter);
// nullptr if nobody reads files of that root.
const ExperimentConverter* FindExperimentConverter(const std::string& root);

}  // namespace swarmanoid
