// Writing a configuration tree as XML.
#pragma once

#include <string>
#include <string_view>

#include "common/configuration/configuration_tree.h"

namespace swarmanoid
{

// XML text of a tree, indented by two blanks. Reading it gives the same tree.
std::string WriteXml(const ConfigurationNode& root);

// The text as it stands within an element.
std::string EscapedXml(std::string_view text);
// Within double quotes: a parser turns line ends and tabs there into blanks unless they are written as references.
std::string EscapedAttribute(std::string_view text);

}  // namespace swarmanoid
