// The --set PATH=VALUE changes of an experiment, applied to its tree before it is checked. docs/experiment_files.md has
// the syntax of PATH.
#pragma once

#include <memory>
#include <string>

#include "common/configuration/configuration_tree.h"

namespace swarmanoid
{

// The tree with the value at the path replaced or, if the last step of the path is not there, added. Elements that
// are not on the path are shared with the old tree. Throws ConfigurationError if the path leads nowhere or to
// several places.
std::shared_ptr<const ConfigurationNode> WithSetting(const std::shared_ptr<const ConfigurationNode>& root,
                                                     const std::string& path, const std::string& value);

// What a path means in the tree, as one text that is the same for every spelling of the path (tag, id, number,
// attribute). Settings with equal addresses change the same value. Throws ConfigurationError if the path leads to
// several places or, before its last step, nowhere.
std::string SettingAddress(const std::shared_ptr<const ConfigurationNode>& root, const std::string& path);

// The tree of an experiment file before any setting; a file of another simulator is converted first. Null if it cannot
// be read, which LoadExperimentFile reports.
std::shared_ptr<const ConfigurationNode> ReadExperimentTree(const std::string& path);

// Throws if no file can hold the value, so that no process could read the changed experiment.
void CheckSettingValue(const std::string& path, const std::string& value);

}  // namespace swarmanoid
