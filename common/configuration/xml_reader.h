// Reads XML text (UTF-8) into a configuration tree whose elements and attributes know their line and column. The parser
// is expat. The reader accepts files from any source: it refuses document types and entity declarations, and stops if a
// limit is passed.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "common/configuration/configuration_tree.h"

namespace swarmanoid
{

struct XmlLimits
{
  std::size_t bytes = std::size_t{64} << 20U;
  int depth = 64;  // elements within elements
  std::size_t elements = 2'000'000;
  std::size_t attributes = 8'000'000;  // total for all elements
  int attributes_of_one = 64;
};

// Returns the root element. Throws ConfigurationError with file:line:col at the first mistake of syntax.
std::shared_ptr<const ConfigurationNode> ReadXml(std::string_view text, const std::string& file_name,
                                                 const XmlLimits& limits = {});

// Returns the whole file. Throws ConfigurationError if it cannot be read or is larger than the limit.
std::string ReadTextFile(const std::string& path, std::size_t most_bytes = XmlLimits{}.bytes);

}  // namespace swarmanoid
