#include "common/configuration/xml_reader.h"

#include <fmt/format.h>

#include <pugixml.hpp>

#include "common/configuration/regular_file.h"
#include "common/configuration/wording.h"
#include "common/configuration/xml_scan.h"

namespace swarmanoid
{
namespace
{

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

// The offset of the first byte that is not well-formed UTF-8 or a control character that XML forbids.
std::optional<std::size_t> FirstBadByte(std::string_view text)
{
  for (std::size_t i = 0; i < text.size();)
  {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x20U && byte != '\t' && byte != '\n' && byte != '\r') return i;
    const std::size_t length = byte < 0x80U                    ? 1
                               : byte >= 0xc2U && byte < 0xe0U ? 2
                               : byte >= 0xe0U && byte < 0xf0U ? 3
                               : byte >= 0xf0U && byte < 0xf5U ? 4
                                                               : 0;
    if (length == 0 || i + length > text.size()) return i;
    for (std::size_t k = 1; k < length; ++k)
    {
      if ((static_cast<unsigned char>(text[i + k]) & 0xc0U) != 0x80U) return i;
    }
    i += length;
  }
  return std::nullopt;
}

// Builds our nodes from the parser's; the depth was limited by the scan.
class TreeBuilder
{
public:
  TreeBuilder(std::string_view text, const LineTable& lines, std::shared_ptr<const std::string> file)
      : text_(text), lines_(lines), file_(std::move(file))
  {
  }

  std::shared_ptr<const ConfigurationNode> Build(const pugi::xml_node& source) const
  {
    auto node = std::make_shared<ConfigurationNode>();
    node->name = source.name();
    const auto name_offset = static_cast<std::size_t>(source.offset_debug());
    node->location = At(name_offset - 1);

    if (source.first_attribute())
    {
      const std::vector<std::size_t> offsets = AttributeOffsets(text_, name_offset);
      std::size_t i = 0;
      for (const pugi::xml_attribute& attribute : source.attributes())
      {
        node->attributes.push_back(
            {attribute.name(), attribute.value(), At(i < offsets.size() ? offsets[i] : name_offset)});
        ++i;
      }
    }
    std::string characters;
    for (const pugi::xml_node& child : source.children())
    {
      if (child.type() == pugi::node_element)
      {
        node->children.push_back(Build(child));
      }
      else
      {
        characters += child.value();
      }
    }
    node->text = TrimBlanks(characters);
    return node;
  }

private:
  SourceLocation At(std::size_t offset) const { return {file_, lines_.Line(offset), lines_.Column(offset)}; }

  std::string_view text_;
  const LineTable& lines_;
  std::shared_ptr<const std::string> file_;
};

void AppendEscaped(std::string& xml, std::string_view text)
{
  for (const char c : text)
  {
    switch (c)
    {
      case '<':
        xml += "&lt;";
        break;
      case '>':
        xml += "&gt;";
        break;
      case '&':
        xml += "&amp;";
        break;
      case '"':
        xml += "&quot;";
        break;
      case '\r':
        xml += "&#13;";
        break;
      default:
        xml += c;
    }
  }
}

// A parser turns line ends and tabs within attributes into blanks unless they are written as references.
void AppendAttribute(std::string& xml, const ConfigurationNode::Attribute& attribute)
{
  xml += " " + attribute.name + "=\"";
  for (const char c : attribute.value)
  {
    if (c == '\n' || c == '\t')
    {
      xml += fmt::format("&#{};", static_cast<int>(c));
    }
    else
    {
      AppendEscaped(xml, {&c, 1});
    }
  }
  xml += '"';
}

void AppendNode(std::string& xml, const ConfigurationNode& node, int depth)
{
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  xml += indent + "<" + node.name;
  for (const auto& attribute : node.attributes) AppendAttribute(xml, attribute);
  if (node.text.empty() && node.children.empty())
  {
    xml += "/>\n";
    return;
  }
  xml += '>';
  AppendEscaped(xml, node.text);
  if (!node.children.empty())
  {
    xml += '\n';
    for (const auto& child : node.children) AppendNode(xml, *child, depth + 1);
    xml += indent;
  }
  xml += "</" + node.name + ">\n";
}

}  // namespace

std::shared_ptr<const ConfigurationNode> ReadXml(std::string_view text, const std::string& file_name,
                                                 const XmlLimits& limits)
{
  const auto file = std::make_shared<const std::string>(file_name);
  if (text.size() > limits.bytes)
  {
    throw ConfigurationError({file, 0, 0},
                             fmt::format("the file has {} bytes; at most {} are read", text.size(), limits.bytes));
  }
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const LineTable lines(text);
  const auto fail = [&](std::size_t offset, const std::string& message) -> ConfigurationError {
    return {{file, lines.Line(offset), lines.Column(offset)}, message};
  };

  if (const auto bad = FirstBadByte(text)) throw fail(*bad, "a byte that is not UTF-8 text; save the file as UTF-8");
  if (const auto mistake = ScanXml(text, lines, limits)) throw fail(mistake->offset, mistake->message);

  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!result)
  {
    throw fail(std::min(static_cast<std::size_t>(result.offset), text.size()),
               fmt::format("not well-formed XML: {}", result.description()));
  }
  if (!document.document_element()) throw fail(0, "the file holds no element");
  return TreeBuilder(text, lines, file).Build(document.document_element());
}

std::string ReadTextFile(const std::string& path, std::size_t most_bytes)
{
  try
  {
    return ReadRegularFile(path, most_bytes);
  }
  catch (const FileError& error)
  {
    throw ConfigurationError({std::make_shared<const std::string>(path), 0, 0},
                             std::string("the file cannot be read: ") + error.what());
  }
}

std::string WriteXml(const ConfigurationNode& root)
{
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  AppendNode(xml, root, 0);
  return xml;
}

}  // namespace swarmanoid
