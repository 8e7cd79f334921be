// Explains to the user why the parser refuses an XML text. The parser says where it stopped, not which mistake it met.
// Only ReadXml and OutlineOf use it.
#pragma once

#include <expat.h>

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace swarmanoid
{

inline constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

struct XmlMistake
{
  std::size_t offset = 0;
  std::string message;
};

// The parser stopped at this position, for this reason. All offsets are in bytes of the text.
struct XmlRefusal
{
  XML_Error error;
  std::size_t offset;                    // the byte that the parser refuses
  std::size_t markup;                    // the start of the markup or text with this byte
  std::size_t section;                   // the start of the last CDATA section
  std::span<const std::size_t> open;     // the start tags of the open elements
  std::function<int(std::size_t)> line;  // returns the line of an offset
};

// Returns the position of the mistake, and its text with the cure.
XmlMistake ExplainRefusal(std::string_view text, const XmlRefusal& refusal);

// Returns the offset of each attribute of the start tag at `tag`, which the parser has accepted.
std::vector<std::size_t> AttributeOffsets(std::string_view text, std::size_t tag);

}  // namespace swarmanoid
