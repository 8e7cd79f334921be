// Writes a configuration tree as XML.
#pragma once

#include <string>
#include <string_view>

#include "common/configuration/configuration_tree.h"

namespace swarmanoid
{

// Returns the XML text of a tree, indented by two blanks. Reading it gives the same tree.
std::string WriteXml(const ConfigurationNode& root);

// Returns the text with escapes, for the content of an element.
std::string EscapedXml(std::string_view text);
// Returns the text with escapes, for use within double quotes. Line ends and tabs become references, since a parser
// would turn them into blanks.
std::string EscapedAttribute(std::string_view text);

}  // namespace swarmanoid
