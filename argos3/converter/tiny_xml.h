// Reads files of ARGoS3 that are no well-formed XML. ARGoS3's parser, TinyXML, accepts some of them.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/configuration/configuration_tree.h"
#include "common/experiment/diagnostics.h"

namespace swarmanoid::argos3
{

// Returns the root element as TinyXML reads it. Each mistake that TinyXML forgives becomes a note. Returns nullptr if
// TinyXML refuses the text, too.
std::shared_ptr<const ConfigurationNode> ReadTinyXml(std::string_view text, const std::string& file_name,
                                                     std::vector<Diagnostic>& notes);

}  // namespace swarmanoid::argos3
