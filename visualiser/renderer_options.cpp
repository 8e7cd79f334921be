#include "visualiser/renderer_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "common/configuration/wording.h"
#include "common/plugins/plugin_library.h"

namespace swarmanoid
{
namespace
{

constexpr std::string_view kEnding = "_render";

std::string KindOf(const std::string& label)
{
  return label.ends_with(kEnding) ? label.substr(0, label.size() - kEnding.size()) : label;
}

std::string HelpOf(const ParameterSpec& spec)
{
  std::string text = spec.description;
  if (!spec.choices.empty()) text += fmt::format(" One of {}.", Listed(spec.choices));
  if (spec.default_value && !spec.default_value->empty()) text += fmt::format(" Default: {}.", *spec.default_value);
  return text;
}

// Returns "--window_size,--window-size", without names that are taken.
std::string FreeNames(const CLI::App& app, const std::string& parameter)
{
  std::string dashed = parameter;
  std::ranges::replace(dashed, '_', '-');
  std::string names;
  for (const std::string& name : {dashed, parameter})
  {
    const std::string option = "--" + name;
    if (app.get_option_no_throw(option) != nullptr || names == option) continue;
    names += (names.empty() ? "" : ",") + option;
  }
  return names;
}

void AddOption(CLI::App& app, const std::string& name, const ParameterSpec& spec, const std::string& group,
               std::vector<std::string>& parameters)
{
  const std::string names = FreeNames(app, name);
  if (names.empty()) return;
  if (spec.type == ParameterType::kBoolean)
  {
    // A flag has --name and, if its default is true, also --no-name.
    const std::string opposite = ",!--no-" + names.substr(2, names.find(',') - 2);
    app.add_flag_function(
           names + opposite,
           [name, &parameters](std::int64_t count) { parameters.push_back(name + (count > 0 ? "=true" : "=false")); },
           HelpOf(spec))
        ->group(group);
    return;
  }
  app.add_option_function<std::string>(
         names, [name, &parameters](const std::string& value) { parameters.push_back(name + "=" + value); },
         HelpOf(spec))
      ->type_name(spec.unit.empty() ? "VALUE" : spec.unit)
      ->group(group);
}

}  // namespace

const PluginDescription& FindRenderer(std::string_view kind)
{
  const PluginCatalogue& catalogue = PluginCatalogue::Instance();
  for (const std::string& label : {std::string(kind), std::string(kind).append(kEnding)})
    if (const PluginDescription* found = catalogue.Find(PluginKind::kRenderer, label)) return *found;

  const bool is_path = kind.find('/') != std::string_view::npos;
  const PluginLibrary& library = LoadPluginLibrary(
      is_path ? std::filesystem::absolute(kind).string() : std::string(kind), StandardPluginFolders());
  for (const auto& [plugin, label] : library.registrations.labels)
    if (plugin == PluginKind::kRenderer && library.error.empty()) return *catalogue.Find(PluginKind::kRenderer, label);
  if (is_path || !library.path.empty())
    throw ConfigurationError(
        library.error.empty() ? library.path + " holds no visualiser; REGISTER_RENDER makes one known" : library.error);
  std::vector<std::string> kinds;
  for (const std::string& label : catalogue.Labels(PluginKind::kRenderer)) kinds.push_back(KindOf(label));
  throw ConfigurationError(fmt::format("there is no visualiser {}; this build has {}{}", Quoted(kind), Listed(kinds),
                                       DidYouMean(kind, kinds)));
}

void AddRendererOptions(CLI::App& app, const PluginDescription& renderer, std::vector<std::string>& parameters)
{
  constexpr int kNumbered = 10;
  const std::string group = "Options of " + renderer.label;
  for (const ParameterSpec& spec : renderer.parameters)
  {
    if (!IsNumbered(spec))
    {
      AddOption(app, spec.name, spec, group, parameters);
      continue;
    }
    // Only the first member of a family is shown.
    const std::string stem = spec.name.substr(0, spec.name.size() - 1);
    for (int number = 0; number < kNumbered; ++number)
      AddOption(app, stem + std::to_string(number), spec, number == 0 ? group : "", parameters);
  }
  for (const ParameterSpec& spec : renderer.parameters)
    for (const std::string& choice : spec.choices)
      if (const std::string names = FreeNames(app, choice); spec.name == "format" && !names.empty())
        app.add_flag_callback(
               names, [choice, &parameters] { parameters.push_back("format=" + choice); },
               fmt::format("The same as --format {}.", choice))
            ->group(group);
}

void AddParametersOf(const std::string& kind, CLI::App& app, std::vector<std::string>& parameters)
{
  app.add_option("PARAMETERS", parameters, "With --attach: the renderer's parameters, as NAME=VALUE");
  if (!kind.empty()) AddRendererOptions(app, FindRenderer(kind), parameters);
}

RenderConfiguration ConfigureRenderer(const PluginDescription& renderer, const std::vector<std::string>& parameters)
{
  auto node = std::make_shared<ConfigurationNode>();
  node->name = renderer.label;
  std::vector<std::string> known;
  for (const ParameterSpec& spec : renderer.parameters) known.push_back(spec.name);
  for (const std::string& parameter : parameters)
  {
    const std::size_t equals = std::min(parameter.find('='), parameter.size());
    const std::string name = parameter.substr(0, equals);
    const auto spec =
        std::ranges::find_if(renderer.parameters, [&](const ParameterSpec& s) { return Matches(s, name); });
    if (equals == parameter.size() || spec == renderer.parameters.end())
      throw ConfigurationError(fmt::format("{} is no parameter of {}; it has {}{}", Quoted(name), renderer.label,
                                           Listed(known), DidYouMean(name, known)));
    const std::string value = parameter.substr(equals + 1);
    if (const std::string mistake = MistakeIn(*spec, value, name); !mistake.empty()) throw ConfigurationError(mistake);
    node->attributes.push_back({name, value, {}});
  }
  RenderConfiguration configuration;
  configuration.tag = renderer.label;
  configuration.id = KindOf(renderer.label);
  configuration.tree = TConfigurationTree(std::move(node));
  return configuration;
}

}  // namespace swarmanoid
