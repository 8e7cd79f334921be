// Writing a configuration tree as XML.
#pragma once

#include <string>
#include <string_view>

#include "common/configuration/configuration_tree.h"

namespace swarmanoid
{

// XML text of a tree, indented by two blanks. Reading it gives the same tree.
std::string WriteXml(const ConfigurationNode& root);

// The text as it stands within an element, or within double quotes in an attribute.
std::string EscapedXml(std::string_view text);

}  // namespace swarmanoid
