// Applies --set PATH=VALUE changes to the tree of an experiment before it is checked. docs/experiment_files.md has the
// syntax of PATH.
#pragma once

#include <memory>
#include <string>

#include "common/configuration/configuration_tree.h"

namespace swarmanoid
{

// Returns the tree with a new value at the path. If the last step of the path does not exist, it is added. Elements
// that are not on the path are shared with the old tree. Throws ConfigurationError if the path leads nowhere or to
// several places.
std::shared_ptr<const ConfigurationNode> WithSetting(const std::shared_ptr<const ConfigurationNode>& root,
                                                     const std::string& path, const std::string& value);

// Returns the meaning of a path in the tree, as one text for all spellings of the path (tag, id, number, attribute).
// Settings with equal addresses change the same value. Throws ConfigurationError if the path leads to several places
// or, before its last step, nowhere.
std::string SettingAddress(const std::shared_ptr<const ConfigurationNode>& root, const std::string& path);

// Returns the tree of an experiment file before any setting; a file of another simulator is converted first. Returns
// null if the file cannot be read, which LoadExperimentFile reports.
std::shared_ptr<const ConfigurationNode> ReadExperimentTree(const std::string& path);

// Throws if no file can hold the value, since then no process could read the changed experiment.
void CheckSettingValue(const std::string& path, const std::string& value);

}  // namespace swarmanoid
