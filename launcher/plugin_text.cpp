#include "launcher/plugin_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "common/configuration/wording.h"
#include "common/configuration/xml_reader.h"
#include "common/experiment/reference.h"
#include "common/experiment/schema.h"
#include "common/plugins/script_parameters.h"
#include "controller_host/device.h"

namespace swarmanoid
{
namespace
{

// Replaces tabs and line ends, which separate fields and rows.
std::string Field(std::string text)
{
  std::ranges::replace_if(
      text, [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::string DefaultOf(const ParameterSpec& parameter)
{
  if (parameter.default_value) return *parameter.default_value;
  return IsNumbered(parameter) ? "" : "required";
}

std::string Bound(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

// Makes columns as wide as their widest text, except for the last one.
std::string Aligned(const std::vector<std::array<std::string, 6>>& rows)
{
  std::array<std::size_t, 6> widths{};
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  std::string text;
  for (const auto& row : rows)
  {
    std::string line = "   ";
    for (std::size_t c = 0; c + 1 < row.size(); ++c) line += fmt::format(" {:<{}} ", row[c], widths[c]);
    line += " " + row.back();
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

void AppendSettings(std::string& rows, const std::string& path, const TConfigurationTree& tree,
                    const std::vector<ParameterSpec>& parameters)
{
  for (const ParameterSpec& parameter : parameters)
  {
    // The id is left out, since paths name elements by it.
    if (parameter.type == ParameterType::kTree || IsNumbered(parameter) || parameter.name == "id") continue;
    const std::string value = tree.Value(parameter.name).value_or(parameter.default_value.value_or(""));
    rows += fmt::format("{}.{}={}\t{}\t{}\n", path, parameter.name, Field(value), Field(AllowedText(parameter)),
                        Field(parameter.description));
  }
}

void AppendPlugin(std::string& rows, const std::string& path, const TConfigurationTree& tree, PluginKind kind,
                  const std::string& label, const std::string& implementation = "")
{
  const PluginDescription* plugin = PluginCatalogue::Instance().Find(kind, label, implementation);
  if (plugin != nullptr) AppendSettings(rows, path, tree, ScriptParameters::Instance().TableOf(*plugin, tree, ""));
}

// Returns "left [rad/s], right [rad/s]". For numbered columns the text has the first and the last number: "0 … 23".
std::string ColumnsText(const std::vector<CCI_ColumnGroup>& groups)
{
  std::string text;
  for (const CCI_ColumnGroup& group : groups)
    for (CCI_Column column : group.columns)
    {
      const std::size_t place = column.name.find('#');
      const std::string name = column.name;
      const auto numbered = [&](std::size_t number)
      {
        column.name = std::string(name).replace(place, 1, std::to_string(number));
        return column.Title();
      };
      text += (text.empty() ? "" : ", ");
      if (place == std::string::npos)
        text += column.Title();
      else
        text += numbered(0) + " …" + (group.count == 0 ? "" : " " + numbered(group.count - 1));
    }
  return text;
}

nlohmann::ordered_json ColumnsJson(const std::vector<CCI_ColumnGroup>& groups)
{
  auto list = nlohmann::ordered_json::array();
  for (const CCI_ColumnGroup& group : groups)
    for (const CCI_Column& column : group.columns)
    {
      nlohmann::ordered_json each{{"name", column.name}, {"unit", column.unit}};
      if (column.name.find('#') != std::string::npos && group.count != 0) each["count"] = group.count;
      if (std::isfinite(column.minimum)) each["minimum"] = column.minimum;
      if (std::isfinite(column.maximum)) each["maximum"] = column.maximum;
      list.push_back(each);
    }
  return list;
}

}  // namespace

std::string PluginKindTitle(PluginKind kind)
{
  std::string title(PluginKindName(kind));
  title[0] = static_cast<char>(std::toupper(title[0]));
  return title.ends_with('s') ? title : title + "s";
}

std::string PluginName(const PluginDescription& plugin)
{
  return plugin.implementation.empty() ? plugin.label : fmt::format("{} / {}", plugin.label, plugin.implementation);
}

std::string PluginDetails(PluginKind kind, const PluginDescription& plugin)
{
  std::string text = fmt::format("{} {}\n  {}\n", PluginKindName(kind), PluginName(plugin), plugin.brief);
  if (!plugin.robots.empty()) text += fmt::format("  for {}\n", Listed(plugin.robots));
  if (!plugin.channel.empty()) text += fmt::format("  needs {} of the engine\n", plugin.channel);
  if (const CCI_Columns* columns = FindColumns(kind, plugin.label))
  {
    if (!columns->settings.empty()) text += fmt::format("  takes {}\n", ColumnsText(columns->settings));
    if (!columns->readings.empty()) text += fmt::format("  reads {}\n", ColumnsText(columns->readings));
    if (!columns->row.empty())
      text += fmt::format("  reads of each {}: {}\n", columns->row_name, ColumnsText(columns->row));
  }
  if (!plugin.entity_tags.empty()) text += fmt::format("  simulates {}\n", Listed(plugin.entity_tags));
  if (!plugin.channels.empty()) text += fmt::format("  offers {}\n", Listed(plugin.channels));
  if (!plugin.declares_parameters) return text + "  it declares no parameters: what its Init asks for decides\n";
  if (plugin.parameters.empty()) return text + "  no parameters\n";
  std::vector<std::array<std::string, 6>> rows{{"parameter", "type", "unit", "default", "range", "meaning"}};
  for (const ParameterSpec& parameter : plugin.parameters)
    rows.push_back({parameter.name, TypeText(parameter), parameter.unit, DefaultOf(parameter), RangeText(parameter),
                    parameter.description});
  return text + Aligned(rows);
}

std::string PluginRows(PluginKind kind, const PluginDescription& plugin)
{
  const std::string start =
      fmt::format("{}\t{}\t{}\t", PluginKindName(kind), Field(plugin.label), Field(plugin.implementation));
  std::string rows = fmt::format("{}\t\t\t\t\t\t\t{}\n", start, Field(plugin.brief));
  for (const ParameterSpec& parameter : plugin.parameters)
  {
    const bool chosen = parameter.type == ParameterType::kChoice;
    rows += fmt::format("{}{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", start, parameter.name,
                        chosen ? "choice" : TypeText(parameter), Field(parameter.unit), Field(DefaultOf(parameter)),
                        Bound(parameter.minimum), Bound(parameter.maximum), chosen ? Listed(parameter.choices) : "",
                        Field(parameter.description));
  }
  return rows;
}

nlohmann::ordered_json PluginJson(PluginKind kind, const PluginDescription& plugin)
{
  nlohmann::ordered_json json{{"kind", PluginKindName(kind)},
                              {"label", plugin.label},
                              {"implementation", plugin.implementation},
                              {"brief", plugin.brief},
                              {"robots", plugin.robots}};
  if (const CCI_Columns* columns = FindColumns(kind, plugin.label))
  {
    json["columns"] = ColumnsJson(kind == PluginKind::kActuator ? columns->settings : columns->readings);
    if (!columns->row.empty()) json["rows"] = ColumnsJson(columns->row);
  }
  json["parameters"] = nlohmann::ordered_json::array();
  for (const ParameterSpec& parameter : plugin.parameters)
  {
    nlohmann::ordered_json each{{"name", parameter.name},
                                {"type", TypeText(parameter)},
                                {"unit", parameter.unit},
                                {"description", parameter.description}};
    if (parameter.default_value) each["default"] = *parameter.default_value;
    if (std::isfinite(parameter.minimum)) each["minimum"] = parameter.minimum;
    if (std::isfinite(parameter.maximum)) each["maximum"] = parameter.maximum;
    if (!parameter.choices.empty()) each["choices"] = parameter.choices;
    json["parameters"].push_back(each);
  }
  return json;
}

nlohmann::ordered_json SettingsJson(const Experiment& experiment)
{
  auto json = nlohmann::ordered_json::array();
  std::istringstream rows(SettingRows(experiment));
  for (std::string row; std::getline(rows, row);)
  {
    const std::size_t sign = row.find('='), allowed = row.find('\t'), meaning = row.rfind('\t');
    json.push_back({{"path", row.substr(0, sign)},
                    {"value", row.substr(sign + 1, allowed - sign - 1)},
                    {"allowed", row.substr(allowed + 1, meaning - allowed - 1)},
                    {"description", row.substr(meaning + 1)}});
  }
  return json;
}

std::string SettingRows(const Experiment& experiment)
{
  std::string rows;
  const TConfigurationTree root(ReadXml(experiment.effective_xml, experiment.name));
  AppendSettings(rows, "framework", root.Child("framework"), ExperimentSchema().Child("framework").parameters);
  for (const ControllerConfiguration& controller : experiment.controllers)
  {
    const std::string path = "controllers." + controller.id;
    for (const DeviceConfiguration& device : controller.actuators)
      AppendPlugin(rows, path + ".actuators." + device.type, device.tree, PluginKind::kActuator, device.type,
                   device.implementation);
    for (const DeviceConfiguration& device : controller.sensors)
      AppendPlugin(rows, path + ".sensors." + device.type, device.tree, PluginKind::kSensor, device.type,
                   device.implementation);
    AppendPlugin(rows, path + ".parameters", controller.parameters, PluginKind::kController, controller.tag);
  }
  for (const EngineConfiguration& engine : experiment.engines)
    AppendPlugin(rows, "engines." + engine.id, engine.tree, PluginKind::kEngine, engine.tag);
  for (const RenderConfiguration& render : experiment.visualisations)
    AppendPlugin(rows, "visualisations." + render.id, render.tree, PluginKind::kRenderer, render.tag);
  for (const FunctionsConfiguration& functions : experiment.functions)
    AppendPlugin(rows, "experiment_functions." + functions.id, functions.tree, PluginKind::kExperimentFunctions,
                 functions.tag);
  return rows;
}

}  // namespace swarmanoid
