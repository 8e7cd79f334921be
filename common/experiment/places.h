// Where the elements of an experiment stand in what its user wrote: file, line and column, or the option that set a
// value. The effective text of an experiment, which workers of a cluster get, has other lines; the places go with it as
// one processing instruction at its end, so that a worker's errors name the user's places too.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "common/configuration/configuration_tree.h"

namespace swarmanoid
{

// The processing instruction for a tree, to be put behind its text (WriteXml).
std::string WritePlaces(const ConfigurationNode& root);

// The text before them.
std::string_view WithoutPlaces(std::string_view text);

// The tree of a text, as ReadXml reads it, with the places that stand at the end of the text if there are any and
// they fit. Throws as ReadXml.
std::shared_ptr<const ConfigurationNode> ReadXmlWithPlaces(const std::string& text, const std::string& file_name);

}  // namespace swarmanoid
