// A pass over XML text that finds what the parser behind it does not report well: mismatched tags by name and line,
// document types, unknown entities, limits. Keeps nothing but the open elements. Used by ReadXml alone.
#pragma once

#include <string_view>
#include <vector>

#include "common/configuration/xml_reader.h"

namespace swarmanoid
{

// Line and column (from 1, in characters of UTF-8) of byte offsets. Fast when asked in ascending order within a line.
class LineTable
{
public:
  explicit LineTable(std::string_view text);
  int Line(std::size_t offset) const;
  int Column(std::size_t offset) const;

private:
  std::string_view text_;
  std::vector<std::size_t> starts_;
  mutable std::size_t last_offset_ = 0;
  mutable int last_column_ = 1;
};

struct XmlMistake
{
  std::size_t offset = 0;
  std::string message;
};

// The first mistake, or nothing.
std::optional<XmlMistake> ScanXml(std::string_view text, const LineTable& lines, const XmlLimits& limits);

// The offset of the value-bearing name of each attribute of the element whose name starts at `name`.
std::vector<std::size_t> AttributeOffsets(std::string_view text, std::size_t name);

}  // namespace swarmanoid
