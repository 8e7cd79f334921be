#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/configuration/xml_writer.h"
#include "common/experiment/reference.h"
#include "common/experiment/schema.h"
#include "common/plugins/script_parameters.h"

namespace swarmanoid
{
namespace
{

std::string Documentation(const std::string& text)
{
  return fmt::format("<xs:annotation><xs:documentation>{}</xs:documentation></xs:annotation>", EscapedXml(text));
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

// Returns the simple type of a value.
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
        values += fmt::format("<xs:enumeration value=\"{}\"/>", EscapedXml(choice));
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

// Collects the common content of the elements of plug-ins, by kind.
void CollectPluginElements(const ElementSpec& element, std::map<PluginKind, const ElementSpec*>& found)
{
  if (element.plugins) found[*element.plugins] = &element.plugin_element.front();
  for (const ElementSpec& child : element.children) CollectPluginElements(child, found);
  for (const ElementSpec& child : element.plugin_element) CollectPluginElements(child, found);
}

// Each label has one element. A sensor and an actuator may have the same label, and each may have several
// implementations. The element allows the content of all of them.
struct LabelElement
{
  ElementSpec element;
  std::set<std::string> implementations;
  std::vector<ParameterSpec> controller_parameters;
  bool declares_parameters = false;  // a controller
  bool open = false;                 // a family of parameters: any names
};

bool SameValues(const ParameterSpec& a, const ParameterSpec& b)
{
  return a.type == b.type && a.minimum == b.minimum && a.maximum == b.maximum && a.choices == b.choices;
}

void AddParameter(std::vector<ParameterSpec>& parameters, const ParameterSpec& added)
{
  const auto known = std::ranges::find(parameters, added.name, &ParameterSpec::name);
  if (known == parameters.end())
    parameters.push_back(added);
  else if (!SameValues(*known, added))
    known->type = ParameterType::kText;
}

std::map<std::string, LabelElement> LabelElements(const ElementSpec& root)
{
  std::map<PluginKind, const ElementSpec*> common;
  CollectPluginElements(root, common);
  std::map<std::string, LabelElement> elements;
  for (const auto& [kind, shared] : common)
  {
    for (const PluginDescription* plugin : PluginCatalogue::Instance().Of(kind))
    {
      LabelElement& label = elements[plugin->label];
      std::string& text = label.element.description;
      if (text.find(plugin->brief) == std::string::npos) text += (text.empty() ? "" : "; ") + plugin->brief;
      for (const ElementSpec& child : shared->children)
        if (label.element.children.empty() || !label.element.FindChild(child.Name()))
          label.element.children.push_back(child);
      for (const ParameterSpec& parameter : shared->parameters) AddParameter(label.element.parameters, parameter);
      if (!plugin->implementation.empty()) label.implementations.insert(plugin->implementation);
      if (kind == PluginKind::kController)
      {
        // A script may declare more parameters than the table has.
        label.declares_parameters = plugin->declares_parameters && !ScriptParameters::Instance().Has(plugin->label);
        label.controller_parameters = plugin->parameters;
        continue;
      }
      // Entity kinds are the elements of entities in <arena>.
      if (kind == PluginKind::kEntityKind) continue;
      label.open |= std::ranges::any_of(plugin->parameters, IsNumbered);
      for (const ParameterSpec& parameter : plugin->parameters) AddParameter(label.element.parameters, parameter);
    }
  }
  for (auto& [name, label] : elements)
  {
    const auto implementation = std::ranges::find(label.element.parameters, "implementation", &ParameterSpec::name);
    if (label.implementations.empty() || implementation == label.element.parameters.end()) continue;
    implementation->type = ParameterType::kChoice;
    implementation->choices.assign(label.implementations.begin(), label.implementations.end());
  }
  return elements;
}

class XsdWriter
{
public:
  std::string Write(const ElementSpec& root)
  {
    Line("<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    Line("<!-- Generated from the tables of the experiment file and of the plug-ins; do not edit. -->");
    Line("<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\">");
    ++depth_;
    Element(root, root.Name());
    for (const auto& [label, element] : LabelElements(root)) PluginElement(label, element);
    --depth_;
    Line("</xs:schema>");
    return std::move(text_);
  }

private:
  void Line(const std::string& line) { text_ += std::string(static_cast<std::size_t>(2 * depth_), ' ') + line + "\n"; }

  // Children may have any order and number, since each parameter may be an attribute instead.
  void Content(const ElementSpec& element)
  {
    Line("<xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">");
    ++depth_;
    if (element.plugins)
    {
      // Elements of known plug-ins are declared below; others may have any content.
      Line("<xs:any processContents=\"lax\"/>");
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
    Attributes(element.parameters);
  }

  void Attributes(const std::vector<ParameterSpec>& parameters)
  {
    for (const ParameterSpec& parameter : parameters)
    {
      if (parameter.type == ParameterType::kTree) continue;
      Line(fmt::format("<xs:attribute name=\"{}\">{}{}</xs:attribute>", parameter.name,
                       Documentation(TextOf(parameter)), SimpleType(parameter)));
    }
  }

  // Returns a text such as "Forward velocity. A number in m/s, at least 0; 0.1 where it is left out."
  static std::string TextOf(const ParameterSpec& parameter)
  {
    std::string text = parameter.description;
    if (!parameter.unit.empty()) text += fmt::format("{}In {}.", text.empty() ? "" : " ", parameter.unit);
    if (parameter.default_value && !parameter.default_value->empty())
      text += fmt::format("{}Default: {}.", text.empty() ? "" : " ", *parameter.default_value);
    return text;
  }

  void PluginElement(const std::string& label, const LabelElement& plugin)
  {
    Line(fmt::format("<xs:element name=\"{}\">", label));
    ++depth_;
    Line(Documentation(plugin.element.description));
    Line(plugin.open ? "<xs:complexType mixed=\"true\">" : "<xs:complexType>");
    ++depth_;
    Line("<xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">");
    ++depth_;
    if (plugin.open)
      Line("<xs:any processContents=\"skip\"/>");
    else
    {
      for (const ElementSpec& child : plugin.element.children) Element(child, child.Name());
      for (const ParameterSpec& parameter : plugin.element.parameters)
      {
        if (parameter.name == "parameters" && plugin.declares_parameters)
          Table(parameter, plugin.controller_parameters);
        else
          ParameterElement(parameter);
      }
    }
    --depth_;
    Line("</xs:choice>");
    if (plugin.open)
      Line("<xs:anyAttribute processContents=\"skip\"/>");
    else
      Attributes(plugin.element.parameters);
    --depth_;
    Line("</xs:complexType>");
    --depth_;
    Line("</xs:element>");
  }

  // Writes the <parameters> of a controller that declared them.
  void Table(const ParameterSpec& holder, const std::vector<ParameterSpec>& parameters)
  {
    if (std::ranges::any_of(parameters, IsNumbered)) return ParameterElement(holder);
    ElementSpec element;
    element.description = holder.description;
    element.parameters = parameters;
    Element(element, holder.name);
  }

  void ParameterElement(const ParameterSpec& parameter)
  {
    const std::string documentation = Documentation(TextOf(parameter));
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
