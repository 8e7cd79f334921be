#include "common/configuration/xml_writer.h"

namespace swarmanoid
{
namespace
{

void AppendNode(std::string& xml, const ConfigurationNode& node, int depth)
{
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  xml += indent + "<" + node.name;
  for (const auto& attribute : node.attributes)
    xml += " " + attribute.name + "=\"" + EscapedAttribute(attribute.value) + '"';
  if (node.text.empty() && node.children.empty())
  {
    xml += "/>\n";
    return;
  }
  xml += '>' + EscapedXml(node.text);
  if (!node.children.empty())
  {
    xml += '\n';
    for (const auto& child : node.children) AppendNode(xml, *child, depth + 1);
    xml += indent;
  }
  xml += "</" + node.name + ">\n";
}

}  // namespace

std::string EscapedAttribute(std::string_view text)
{
  std::string xml;
  for (const char c : EscapedXml(text)) xml += c == '\n' ? "&#10;" : c == '\t' ? "&#9;" : std::string(1, c);
  return xml;
}

std::string WriteXml(const ConfigurationNode& root)
{
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  AppendNode(xml, root, 0);
  return xml;
}

std::string EscapedXml(std::string_view text)
{
  std::string xml;
  xml.reserve(text.size());
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
  return xml;
}

}  // namespace swarmanoid
