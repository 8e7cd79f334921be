// The byte positions of the parts of XML text, for edits that change one part and leave every other byte alone.
// xml_edit uses it.
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
  TextSpan start;    // the start tag; for <name/> the whole element
  TextSpan content;  // between start tag and end tag; for <name/> empty, behind it
  std::vector<Attribute> attributes;
  std::vector<XmlElement> children;  // in the order of ReadXml
  std::vector<TextSpan> notes;       // comments and processing instructions of the content

  bool HasNoEndTag() const { return whole.end == start.end; }
  // Returns the attribute of that name; nullptr if it does not exist.
  const Attribute* FindAttribute(std::string_view wanted) const;
  // Returns the first child of that name; nullptr if none exists.
  const XmlElement* FindChild(std::string_view wanted) const;
};

// Returns the root element. Throws ConfigurationError as ReadXml does, which reads the text first, with its limits.
XmlElement OutlineOf(std::string_view text, const std::string& file_name = "text");

// Returns the element at a path of child numbers from the root; nullptr if it does not exist.
const XmlElement* ElementAt(const XmlElement& root, std::span<const std::size_t> path);

}  // namespace swarmanoid
