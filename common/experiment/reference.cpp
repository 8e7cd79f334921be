#include "common/experiment/reference.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/configuration/wording.h"
#include "common/experiment/schema.h"

namespace swarmanoid
{
namespace
{

constexpr std::ptrdiff_t kMostWords = 20;  // in the cell of a table

std::string DefaultText(const ParameterSpec& parameter)
{
  if (IsNumbered(parameter) && !parameter.default_value) return "none";
  if (!parameter.default_value) return "**required**";
  return parameter.default_value->empty() ? "none" : "`" + *parameter.default_value + "`";
}

// Replaces bars, which would end the cell of a table.
std::string Cell(const std::string& text)
{
  std::string cell;
  for (const char c : text) cell += c == '|' ? std::string("\\|") : std::string(1, c);
  return cell;
}

void AppendParameters(std::string& page, const std::vector<ParameterSpec>& parameters)
{
  if (parameters.empty()) return;
  page += "| parameter | type | unit | range | default | meaning |\n|---|---|---|---|---|---|\n";
  TableNotes notes;
  for (const ParameterSpec& parameter : parameters)
  {
    const std::string type = TypeText(parameter);
    page += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", parameter.name, Cell(type), Cell(parameter.unit),
                        RangeText(parameter), Cell(DefaultText(parameter)), notes.Cell(parameter));
  }
  page += notes.List() + "\n";
}

void AppendElement(std::string& page, const ElementSpec& element, const std::string& path)
{
  std::string also;
  for (std::size_t i = 1; i < element.tags.size(); ++i)
    also += (i > 1 ? ", " : "") + fmt::format("`<{}>`", element.tags[i]);
  page += fmt::format("### `{}`\n\n{}", path, element.description);
  if (!also.empty()) page += fmt::format(" Also written {}.", also);
  page += "\n\n";
  AppendParameters(page, element.parameters);

  std::string children;
  for (const ElementSpec& child : element.children)
  {
    children +=
        fmt::format("{}`<{}>`{}", children.empty() ? "" : ", ", child.Name(), child.repeatable ? " (any number)" : "");
  }
  if (element.plugins)
  {
    children += fmt::format("{}any number of {}s by their labels", children.empty() ? "" : ", ",
                            PluginKindName(*element.plugins));
  }
  if (!children.empty()) page += fmt::format("Holds: {}.\n\n", children);

  // The entities are described in another section.
  for (const ElementSpec& child : element.children)
  {
    if (!child.entity) AppendElement(page, child, path + "/" + child.Name());
  }
  for (const ElementSpec& child : element.plugin_element)
  {
    AppendElement(page, child, fmt::format("{}/({} label)", path, PluginKindName(*element.plugins)));
  }
}

void AppendPlugin(std::string& page, const PluginDescription& plugin)
{
  const std::string implementation =
      plugin.implementation.empty() ? "" : fmt::format(", implementation `{}`", plugin.implementation);
  page += fmt::format("### `<{}>`{}\n\n{}\n\n", plugin.label, implementation, plugin.brief);
  if (!plugin.robots.empty()) page += fmt::format("For: {}. ", Listed(plugin.robots));
  if (!plugin.channel.empty())
  {
    page += fmt::format("Needs `{}` from the engine ({} numbers a {}). ", plugin.channel, plugin.channel_width,
                        plugin.channel_is_per_joint ? "joint" : "robot");
  }
  if (!plugin.entity_tags.empty()) page += fmt::format("Simulates: {}. ", Listed(plugin.entity_tags));
  if (!plugin.channels.empty()) page += fmt::format("Offers: {}. ", Listed(plugin.channels));
  if (page.back() == ' ')
  {
    page.pop_back();
    page += "\n\n";
  }
  if (!plugin.declares_parameters) page += "It declares no parameters: what its `Init` asks for decides.\n\n";
  AppendParameters(page, plugin.parameters);
}

}  // namespace

std::string TableNotes::Cell(const ParameterSpec& parameter)
{
  const std::string& text = parameter.description;
  const auto words = [](const std::string& part) { return std::ranges::count(part, ' ') + 1; };
  if (words(text) <= kMostWords) return swarmanoid::Cell(text);
  // The cell ends with a sentence, otherwise with a clause, as late as its words allow.
  for (const std::string end : {". ", "; ", ": "})
    for (std::size_t at = text.rfind(end); at != std::string::npos && at > 0; at = text.rfind(end, at - 1))
      if (text[at - 1] != ' ' && words(text.substr(0, at)) <= kMostWords)
      {
        list_ += fmt::format("* `{}`: {}\n", parameter.name, text.substr(at + end.size()));
        return swarmanoid::Cell(text.substr(0, at)) + (end == ". " ? "." : "");
      }
  list_ += fmt::format("* `{}`: {}\n", parameter.name, text);
  return "see below";
}

std::string TableNotes::List() const { return list_.empty() ? "" : "\n" + list_; }

std::string TypeText(const ParameterSpec& parameter)
{
  switch (parameter.type)
  {
    case ParameterType::kBoolean:
      return "true or false";
    case ParameterType::kInteger:
      return "whole number";
    case ParameterType::kNumber:
      return "number";
    case ParameterType::kText:
      return "text";
    case ParameterType::kChoice:
      return Listed(parameter.choices);
    case ParameterType::kVector2:
      return "x, y";
    case ParameterType::kVector3:
      return "x, y, z";
    case ParameterType::kPath:
      return "file name";
    case ParameterType::kColour:
      return "colour";
    case ParameterType::kTree:
      return "elements";
  }
  return {};
}

std::string ExperimentReference()
{
  std::string page =
      "# Reference of the experiment file\n\n"
      "Generated from the table that the reader uses (`common/experiment/schema.cpp`) by `write_experiment_reference`; "
      "do not edit. [Experiment files](experiment_files.md) explains how to write one; `swarmanoid list plugins` and "
      "[plug-ins](plugin_reference.md) have the parameters of engines, devices, visualisations, experiment functions "
      "and "
      "controllers.\n\n"
      "Every parameter may be written as an attribute (`<footbot id=\"fb\">`) or as a child element "
      "(`<position>1, 1, 0</position>`), once. Elements and parameters that are not listed are errors. Numbers of a "
      "vector are "
      "separated by commas or blanks. Colours are a name (black, white, red, green, blue, yellow, cyan, magenta, "
      "orange, "
      "purple, brown, gray, silver), `#rrggbb`, or `r, g, b` from 0 to 255.\n\n"
      "## Elements\n\n";
  AppendElement(page, ExperimentSchema(), ExperimentSchema().Name());
  page +=
      "## Entities\n\nChildren of `<arena>` and, without `position` and `orientation`, of `<distribute>`. Robots have "
      "bodies of "
      "fixed size: footbot a cylinder of radius 0.085 m and height 0.147 m, eyebot a cylinder of radius 0.25 m and "
      "height "
      "0.566 m, handbot a box of 0.22 x 0.17 x 0.16 m.\n\n";
  for (const ElementSpec& entity : EntityElements()) AppendElement(page, entity, entity.Name());
  while (page.ends_with("\n\n")) page.pop_back();
  return page;
}

std::string PluginReference()
{
  std::string page =
      "# Reference of the plug-ins\n\nGenerated from the tables with which plug-ins register; do not edit. How they "
      "are used: "
      "[experiment files](experiment_files.md).\n\n";
  const std::pair<PluginKind, const char*> sections[] = {{PluginKind::kEngine, "Physics engines"},
                                                         {PluginKind::kActuator, "Actuators"},
                                                         {PluginKind::kSensor, "Sensors"},
                                                         {PluginKind::kRenderer, "Visualisations"},
                                                         {PluginKind::kExperimentFunctions, "Experiment functions"},
                                                         {PluginKind::kEntityKind, "Entity kinds"},
                                                         {PluginKind::kController, "Controllers"}};
  for (const auto& [kind, title] : sections)
  {
    page += fmt::format("## {}\n\n", title);
    for (const PluginDescription* plugin : PluginCatalogue::Instance().Of(kind)) AppendPlugin(page, *plugin);
  }
  while (page.ends_with("\n\n")) page.pop_back();
  return page;
}

}  // namespace swarmanoid
