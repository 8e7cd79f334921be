// Experiment files of other simulators. A converter registers at the start of the process, by the name of the root
// element. From then on such files are read like ours, and every mistake names its position in them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/experiment/load_experiment.h"

namespace swarmanoid
{

// Converts a tree of another simulator to ours; each element keeps its position. `folder`: the folder of the file.
// `settings`: the values that will be set in our tree. Mistakes go into `mistakes`; then the tree is not used.
using ExperimentConverter = std::function<std::shared_ptr<const ConfigurationNode>(
    const ConfigurationNode& root, const std::string& folder, const ExperimentSettings& settings,
    std::vector<Diagnostic>& mistakes)>;

// Reads a text that is no well-formed XML. Returns the root element, or nullptr if the other simulator refuses the
// text, too.
using ExperimentReader =
    std::function<std::shared_ptr<const ConfigurationNode>(const std::string& text, const std::string& file_name)>;

// Registers the converter of files with that root element, and their reader.
void AddExperimentConverter(const std::string& root, ExperimentConverter converter, ExperimentReader reader);
// Returns nullptr if no converter reads files with that root.
const ExperimentConverter* FindExperimentConverter(const std::string& root);
// Returns whether the text is an experiment of another simulator, judged by the name of its root element.
bool IsForeignExperiment(std::string_view text);
// Returns the root element of the text of an experiment file. Throws ConfigurationError if it cannot be read.
std::shared_ptr<const ConfigurationNode> ReadExperimentXml(const std::string& text, const std::string& file_name);

}  // namespace swarmanoid
