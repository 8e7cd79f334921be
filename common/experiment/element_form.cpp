#include "common/experiment/element_form.h"

#include <algorithm>
#include <filesystem>

#include "common/experiment/schema.h"
#include "common/plugins/script_parameters.h"

namespace swarmanoid
{
namespace
{

// The walk through the tables keeps this state.
struct SchemaPlace
{
  const ElementSpec* element = nullptr;  // nullptr: only a table of parameters, or an unknown element
  const PluginDescription* plugin = nullptr;
  std::optional<PluginKind> kind;  // the kind of plug-in that the element stands for
  std::optional<std::vector<ParameterSpec>> table{};
};

// Returns the parameters of a controller with this <parameters>. A script with a mistake, which the reader reports,
// adds none.
std::vector<ParameterSpec> TableOf(const PluginDescription& controller, const ConfigurationNode& node)
{
  const TConfigurationTree parameters(
      std::shared_ptr<const ConfigurationNode>(std::shared_ptr<const ConfigurationNode>(), &node));
  try
  {
    const std::string file = node.location.file == nullptr ? "" : *node.location.file;
    return ScriptParameters::Instance().TableOf(controller, parameters,
                                                std::filesystem::path(file).parent_path().string());
  }
  catch (const ConfigurationError&)
  {
    return controller.parameters;
  }
}

const std::string* ValueIn(const ConfigurationNode& node, std::string_view name)
{
  for (const auto& attribute : node.attributes)
    if (attribute.name == name) return &attribute.value;
  for (const auto& child : node.children)
    if (child->name == name) return &child->text;
  return nullptr;
}

const PluginDescription* PluginOf(PluginKind kind, const ConfigurationNode& node)
{
  const std::string* implementation = ValueIn(node, "implementation");
  return PluginCatalogue::Instance().Find(kind, node.name, implementation == nullptr ? "" : *implementation);
}

SchemaPlace Into(const SchemaPlace& above, const ConfigurationNode& node)
{
  if (above.element == nullptr) return {};
  if (const ElementSpec* child = above.element->FindChild(node.name)) return {child, nullptr, {}, {}};
  if (above.element->plugins)
  {
    const PluginKind kind = *above.element->plugins;
    return {&above.element->plugin_element.front(), PluginOf(kind, node), kind, {}};
  }
  const bool has_table = above.kind == PluginKind::kController && node.name == "parameters" &&
                         above.plugin != nullptr && above.plugin->declares_parameters;
  return has_table ? SchemaPlace{nullptr, nullptr, {}, TableOf(*above.plugin, node)} : SchemaPlace{};
}

// Adds the registered implementations as choices, for the elements of devices.
void OfferImplementations(std::vector<ParameterSpec>& parameters, PluginKind kind, const std::string& label)
{
  const auto found = std::ranges::find(parameters, "implementation", &ParameterSpec::name);
  if (found == parameters.end()) return;
  found->type = ParameterType::kChoice;
  found->choices = PluginCatalogue::Instance().Implementations(kind, label);
}

std::vector<ParameterSpec> RequiredOf(const std::vector<ParameterSpec>& parameters)
{
  std::vector<ParameterSpec> required;
  std::ranges::copy_if(parameters, std::back_inserter(required),
                       [](const ParameterSpec& parameter)
                       { return !parameter.default_value && !IsNumbered(parameter); });
  return required;
}

void AddChildren(const SchemaPlace& place, const ConfigurationNode& node, ElementForm& form)
{
  const auto holds = [&](const ElementSpec& spec)
  { return std::ranges::any_of(node.children, [&](const auto& child) { return spec.HasTag(child->name); }); };
  for (const ElementSpec& child : place.element->children)
    form.children.push_back(
        {child.Name(), child.description, RequiredOf(child.parameters), child.repeatable || !holds(child)});
  if (place.kind == PluginKind::kController)
  {
    const auto& parameters = place.element->parameters;
    const auto table = std::ranges::find(parameters, "parameters", &ParameterSpec::name);
    form.children.push_back({"parameters", table->description, {}, ValueIn(node, "parameters") == nullptr});
  }
  if (!place.element->plugins) return;
  const PluginKind kind = *place.element->plugins;
  const bool is_device = kind == PluginKind::kSensor || kind == PluginKind::kActuator;
  for (const std::string& label : PluginCatalogue::Instance().Labels(kind))
  {
    std::vector<ParameterSpec> required = RequiredOf(place.element->plugin_element.front().parameters);
    OfferImplementations(required, kind, label);
    const auto implementations = PluginCatalogue::Instance().Implementations(kind, label);
    const PluginDescription* plugin =
        PluginCatalogue::Instance().Find(kind, label, is_device ? implementations.front() : "");
    if (plugin == nullptr) continue;
    for (const ParameterSpec& parameter : RequiredOf(plugin->parameters)) required.push_back(parameter);
    const bool there = is_device && std::ranges::any_of(node.children, [&](const auto& c) { return c->name == label; });
    form.children.push_back({label, plugin->brief, std::move(required), !there});
  }
}

}  // namespace

ElementForm FormOf(std::span<const ConfigurationNode* const> path)
{
  ElementForm form;
  if (path.empty() || path.front()->name != ExperimentSchema().Name()) return form;
  SchemaPlace place{&ExperimentSchema(), nullptr, {}, {}};
  for (const ConfigurationNode* node : path.subspan(1)) place = Into(place, *node);
  const ConfigurationNode& node = *path.back();
  if (place.table)
  {
    form.known = true;
    form.description = "The parameters of the controller.";
    form.parameters = *place.table;
    return form;
  }
  if (place.element == nullptr) return form;
  form.known = !place.kind || place.plugin != nullptr || place.kind == PluginKind::kEntityKind;
  form.description = place.plugin != nullptr ? place.plugin->brief : place.element->description;
  form.required = place.element->required;
  form.parameters = place.element->parameters;
  std::erase_if(form.parameters, [](const ParameterSpec& p) { return p.type == ParameterType::kTree; });
  const bool has_own =
      place.plugin != nullptr && place.kind != PluginKind::kController && place.kind != PluginKind::kEntityKind;
  if (has_own)
    for (const ParameterSpec& parameter : place.plugin->parameters) form.parameters.push_back(parameter);
  if (place.kind) OfferImplementations(form.parameters, *place.kind, node.name);
  AddChildren(place, node, form);
  return form;
}

}  // namespace swarmanoid
