// The positions of an experiment's elements in its user's files: file, line and column, or the option that set a value.
// Workers of a cluster get the effective text of an experiment, which has other lines. The places are appended as one
// processing instruction, so that a worker's errors name the user's positions too.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "common/configuration/configuration_tree.h"

namespace swarmanoid
{

// Returns the processing instruction for a tree, to be appended to its text (WriteXml).
std::string WritePlaces(const ConfigurationNode& root);

// Returns the text before the places.
std::string_view WithoutPlaces(std::string_view text);

// Reads the tree of a text as ReadXml does, with the places at the end of the text if they exist and fit. Throws as
// ReadXml does.
std::shared_ptr<const ConfigurationNode> ReadXmlWithPlaces(const std::string& text, const std::string& file_name);

}  // namespace swarmanoid
