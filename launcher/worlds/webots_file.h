// Reads the text of Webots worlds, which is VRML97 with fields of Webots (https://cyberbotics.com/doc/reference).
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "common/configuration/configuration_tree.h"

namespace swarmanoid
{

// Returns a tree. Its root, named "world", has the nodes of the file as children. A node is an element of the name of
// its type. A field of numbers, texts or truth values is an attribute: its values have blanks between them, its texts
// line feeds. A field of nodes is a child of the field's name with the nodes as children. The name of DEF is the
// attribute "DEF". Nodes that USE names stand in the tree again. The hidden fields, with which Webots saves velocities,
// are left out. Throws ConfigurationError with file:line:col at the first mistake of syntax.
std::shared_ptr<const ConfigurationNode> ReadWebotsFile(std::string_view text, const std::string& file_name);

// Returns whether a text is that of a Webots file, by its first line.
bool IsWebotsFile(std::string_view text);

}  // namespace swarmanoid
