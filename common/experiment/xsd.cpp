#include <fmt/format.h>

#include <cmath>

#include "common/experiment/reference.h"
#include "common/experiment/schema.h"

namespace swarmanoid
{
namespace
{

std::string Escaped(const std::string& text)
{
  std::string escaped;
  for (const char c : text)
  {
    escaped += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  }
  return escaped;
}

std::string Documentation(const std::string& text)
{
  return fmt::format("<xs:annotation><xs:documentation>{}</xs:documentation></xs:annotation>", Escaped(text));
}

std::string Facets(const ParameterSpec& parameter)
{
  std::string facets;
  if (std::isfinite(parameter.minimum)) facets += fmt::format("<xs:minInclusive value=\"{}\"/>", parameter.minimum);
  if (std::isfinite(parameter.maximum)) facets += fmt::format("<xs:maxInclusive value=\"{}\"/>", parameter.maximum);
  return facets;
}

std::string IntegerFacets(const ParameterSpec& parameter)
{
  std::string facets;
  if (std::isfinite(parameter.minimum)) facets += fmt::format("<xs:minInclusive value=\"{:.0f}\"/>", parameter.minimum);
  if (std::isfinite(parameter.maximum)) facets += fmt::format("<xs:maxInclusive value=\"{:.0f}\"/>", parameter.maximum);
  return facets;
}

// The simple type of a value.
std::string SimpleType(const ParameterSpec& parameter)
{
  switch (parameter.type)
  {
    case ParameterType::kBoolean:
    {
      std::string values;
      for (const char* value : {"true", "false", "yes", "no", "on", "off", "1", "0"})
      {
        values += fmt::format("<xs:enumeration value=\"{}\"/>", value);
      }
      return "<xs:simpleType><xs:restriction base=\"xs:token\">" + values + "</xs:restriction></xs:simpleType>";
    }
    case ParameterType::kInteger:
      return "<xs:simpleType><xs:restriction base=\"xs:integer\">" + IntegerFacets(parameter) +
             "</xs:restriction></xs:simpleType>";
    case ParameterType::kNumber:
      return "<xs:simpleType><xs:restriction base=\"xs:double\">" + Facets(parameter) +
             "</xs:restriction></xs:simpleType>";
    case ParameterType::kChoice:
    {
      std::string values;
      for (const std::string& choice : parameter.choices)
        values += fmt::format("<xs:enumeration value=\"{}\"/>", Escaped(choice));
      return "<xs:simpleType><xs:restriction base=\"xs:token\">" + values + "</xs:restriction></xs:simpleType>";
    }
    case ParameterType::kVector2:
    case ParameterType::kVector3:
    {
      constexpr const char* kNumber = "[+\\-]?([0-9]+(\\.[0-9]*)?|\\.[0-9]+)([eE][+\\-]?[0-9]+)?";
      const int further = parameter.type == ParameterType::kVector2 ? 1 : 2;
      return fmt::format(
          "<xs:simpleType><xs:restriction base=\"xs:token\"><xs:pattern value=\"{0}(( ?, ?| ){0}){{{1}}}\"/>"
          "</xs:restriction></xs:simpleType>",
          kNumber, further);
    }
    case ParameterType::kText:
    case ParameterType::kPath:
    case ParameterType::kColour:
    case ParameterType::kTree:
      break;
  }
  return "<xs:simpleType><xs:restriction base=\"xs:token\"/></xs:simpleType>";
}

class XsdWriter
{
public:
  std::string Write(const ElementSpec& root)
  {
    Line("<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    Line("<!-- Generated from common/experiment/schema.cpp by write_experiment_reference; do not edit. -->");
    Line("<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\">");
    ++depth_;
    Element(root, root.Name());
    --depth_;
    Line("</xs:schema>");
    return std::move(text_);
  }

private:
  void Line(const std::string& line) { text_ += std::string(static_cast<std::size_t>(2 * depth_), ' ') + line + "\n"; }

  // In any order and number, since each parameter may stand as an attribute instead.
  void Content(const ElementSpec& element)
  {
    Line("<xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">");
    ++depth_;
    if (element.plugins)
    {
      Line("<xs:any processContents=\"skip\"/>");
    }
    else
    {
      for (const ElementSpec& child : element.children)
      {
        for (const std::string& tag : child.tags) Element(child, tag);
      }
      for (const ParameterSpec& parameter : element.parameters) ParameterElement(parameter);
    }
    --depth_;
    Line("</xs:choice>");
    for (const ParameterSpec& parameter : element.parameters)
    {
      if (parameter.type == ParameterType::kTree) continue;
      Line(fmt::format("<xs:attribute name=\"{}\">{}{}</xs:attribute>", parameter.name,
                       Documentation(parameter.description), SimpleType(parameter)));
    }
  }

  void ParameterElement(const ParameterSpec& parameter)
  {
    const std::string documentation = Documentation(parameter.description);
    if (parameter.type == ParameterType::kTree)
    {
      Line(fmt::format("<xs:element name=\"{}\" type=\"xs:anyType\">{}</xs:element>", parameter.name, documentation));
      return;
    }
    Line(
        fmt::format("<xs:element name=\"{}\">{}{}</xs:element>", parameter.name, documentation, SimpleType(parameter)));
  }

  void Element(const ElementSpec& element, const std::string& tag)
  {
    Line(fmt::format("<xs:element name=\"{}\">", tag));
    ++depth_;
    Line(Documentation(element.description));
    Line("<xs:complexType>");
    ++depth_;
    Content(element);
    --depth_;
    Line("</xs:complexType>");
    --depth_;
    Line("</xs:element>");
  }

  std::string text_;
  int depth_ = 0;
};

}  // namespace

std::string ExperimentXsd() { return XsdWriter().Write(ExperimentSchema()); }

}  // namespace swarmanoid
