// Where the parts of XML text stand in it, in bytes: for edits that change a part and leave every other byte alone.
// Used by xml_edit.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace swarmanoid
{

struct TextSpan
{
  std::size_t begin = 0;
  std::size_t end = 0;  // behind the last byte

  std::string_view Of(std::string_view text) const { return text.substr(begin, end - begin); }
};

struct XmlElement
{
  struct Attribute
  {
    std::string name;
    TextSpan whole;  // name="value"
    TextSpan value;  // between the quotes, as it is written
  };

  std::string name;
  TextSpan whole;    // from "<name" to behind "</name>" or "/>"
  TextSpan start;    // the start tag; of <name/> the whole
  TextSpan content;  // between start tag and end tag; of <name/> empty, behind it
  std::vector<Attribute> attributes;
  std::vector<XmlElement> children;  // in the order of ReadXml
  std::vector<TextSpan> notes;       // comments and processing instructions of the content

  bool HasNoEndTag() const { return whole.end == start.end; }
  const Attribute* FindAttribute(std::string_view wanted) const;
  // The first child of that name; nullptr if there is none.
  const XmlElement* FindChild(std::string_view wanted) const;
};

// The root element. Throws ConfigurationError as ReadXml does, which reads the text first, with its limits.
XmlElement OutlineOf(std::string_view text, const std::string& file_name = "text");

// The element at a path of child numbers, from the root on; nullptr if there is none.
const XmlElement* ElementAt(const XmlElement& root, std::span<const std::size_t> path);

}  // namespace swarmanoid
