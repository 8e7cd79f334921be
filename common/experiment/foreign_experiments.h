// Experiment files of other simulators. A converter registers at the start of the process, by the name of the root
// element. From then on such files are read like ours, and every mistake names its position in them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/experiment/load_experiment.h"

namespace swarmanoid
{

// Converts a tree of another simulator to ours; each element keeps its position. `folder`: the folder of the file.
// `settings`: the values that will be set in our tree. Mistakes go into `mistakes`; then the tree is not used.
using ExperimentConverter = std::function<std::shared_ptr<const ConfigurationNode>(
    const ConfigurationNode& root, const std::string& folder, const ExperimentSettings& settings,
    std::vector<Diagnostic>& mistakes)>;

// Registers the converter of files with that root element.
void AddExperimentConverter(const std::string& root, ExperimentConverter converter);
// Returns nullptr if no converter reads files with that root.
const ExperimentConverter* FindExperimentConverter(const std::string& root);

}  // namespace swarmanoid
