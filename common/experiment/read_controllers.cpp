#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "common/configuration/parameter_table.h"
#include "common/configuration/wording.h"
#include "common/experiment/element_reader.h"
#include "common/experiment/sections.h"
#include "common/plugins/parameter_checks.h"
#include "common/plugins/plugin_library.h"
#include "common/plugins/script_parameters.h"

namespace swarmanoid
{
namespace
{

// Reports values that are valid alone but not together.
void CheckTogether(const TConfigurationTree& device, PluginKind kind, const PluginDescription& plugin, Reading& reading)
{
  const Parameters parameters(device, plugin.parameters);
  for (const ConfigurationError& mistake : ParameterChecks::Instance().Mistakes(kind, plugin, parameters))
    reading.diagnostics.Add(mistake.Location(), mistake.Message());
}

std::vector<DeviceConfiguration> ReadDevices(const TConfigurationTree& tree, const ElementSpec& spec, Reading& reading)
{
  std::vector<DeviceConfiguration> devices;
  if (!tree.Exists()) return devices;
  const ElementReader list(tree, spec, reading.diagnostics);
  std::map<std::string, int> lines;
  for (const TConfigurationTree& device : tree.Children())
  {
    const PluginDescription* plugin = FindPlugin(*spec.plugins, device, reading);
    // Without a description, which is reported elsewhere, the other parameters cannot be checked.
    if (plugin == nullptr) continue;
    const std::size_t mistakes = reading.diagnostics.Count();
    const ElementReader reader(device, spec.plugin_element.front(), reading.diagnostics, &plugin->parameters);
    if (reading.diagnostics.Count() == mistakes) CheckTogether(device, *spec.plugins, *plugin, reading);
    const auto [first, is_first] = lines.emplace(device.Name(), device.Location().line);
    if (!is_first)
    {
      reading.diagnostics.Add(device.Location(), fmt::format("<{}> is listed twice; the first is in line {}",
                                                             device.Name(), first->second));
      continue;
    }
    devices.push_back({device.Name(), reader.Text("implementation"), device});
  }
  return devices;
}

void CheckController(const ControllerConfiguration& controller, const TConfigurationTree& tree, Reading& reading)
{
  const PluginCatalogue& catalogue = PluginCatalogue::Instance();
  if (controller.library.empty())
  {
    if (catalogue.Find(PluginKind::kController, controller.tag) != nullptr) return;
    const auto labels = catalogue.Labels(PluginKind::kController);
    reading.diagnostics.Add(controller.location,
                            fmt::format("the program holds no controller <{}>; give the library that does, as "
                                        "library=\"name\"{}",
                                        controller.tag, DidYouMean(controller.tag, labels)));
    return;
  }
  const PluginLibrary& library = LoadPluginLibrary(controller.library, reading.experiment.controller_path);
  if (!library.error.empty())
  {
    reading.diagnostics.Add(tree.ValueLocation("library"), library.error);
    return;
  }
  std::vector<std::string> labels;
  for (const auto& [kind, label] : library.registrations.labels)
  {
    if (kind == PluginKind::kController) labels.push_back(label);
  }
  if (std::find(labels.begin(), labels.end(), controller.tag) != labels.end()) return;
  reading.diagnostics.Add(controller.location,
                          fmt::format("the library {} registers no controller <{}>; it registers: {}{}", library.path,
                                      controller.tag, Listed(labels), DidYouMean(controller.tag, labels)));
}

// Returns the parameters of a controller: checked and complete if it declared them, otherwise as they are in the file.
TConfigurationTree ReadParameters(const ControllerConfiguration& controller, const TConfigurationTree& given,
                                  Reading& reading)
{
  const PluginDescription* plugin = PluginCatalogue::Instance().Find(PluginKind::kController, controller.tag);
  if (plugin == nullptr || !plugin->declares_parameters) return given;
  const TConfigurationTree tree = OrEmpty(given, "parameters", controller.location);
  std::vector<ParameterSpec> parameters;
  try
  {
    parameters = ScriptParameters::Instance().TableOf(*plugin, tree, reading.experiment.folder);
  }
  catch (const ConfigurationError& mistake)
  {
    reading.diagnostics.Add(mistake.Location(), mistake.Message());
    return given;
  }
  const auto mistakes = MistakesIn(tree, parameters, "controller <" + controller.tag + ">");
  for (const ConfigurationError& mistake : mistakes) reading.diagnostics.Add(mistake.Location(), mistake.Message());
  if (mistakes.empty()) CheckTogether(tree, PluginKind::kController, *plugin, reading);
  return WithDefaults(tree, parameters, reading.experiment.folder);
}

ControllerConfiguration ReadController(const TConfigurationTree& tree, Reading& reading)
{
  const ElementSpec& spec = ExperimentSchema().Child("controllers").plugin_element.front();
  const ElementReader reader(tree, spec, reading.diagnostics);
  ControllerConfiguration controller;
  controller.tag = tree.Name();
  controller.id = reader.Text("id");
  controller.library = reader.Text("library");
  controller.parameters = tree.Child("parameters");
  const std::string on_failure = reader.Text("on_failure");
  if (on_failure == "stop_robot") controller.on_failure = OnFailure::kStopRobot;
  if (on_failure == "restart") controller.on_failure = OnFailure::kRestart;
  controller.time_budget_ms = reader.Number("time_budget_ms");
  if (controller.time_budget_ms > 0 && controller.on_failure == OnFailure::kRestart)
    reading.diagnostics.Add(
        reader.Place("time_budget_ms"),
        fmt::format(
            "the controller '{}' has a time_budget_ms and on_failure=\"restart\": one that is too slow would be "
            "so again; take on_failure=\"stop_robot\" or \"abort\"",
            controller.id));
  controller.location = tree.Location();
  if (reader.IsGiven("id")) CheckId(controller.id, reader.Place("id"), reading.diagnostics);
  controller.actuators = ReadDevices(tree.Child("actuators"), spec.Child("actuators"), reading);
  controller.sensors = ReadDevices(tree.Child("sensors"), spec.Child("sensors"), reading);
  if (reading.options.check_files) CheckController(controller, tree, reading);
  controller.parameters = ReadParameters(controller, controller.parameters, reading);
  return controller;
}

// Returns the first robot of each kind that uses the controller, with the number of these robots.
struct Use
{
  const EntityConfiguration* robot = nullptr;
  std::size_t count = 0;
};

// Returns whether a kind may carry a device. The simulator's devices fit its own robots; a row may name devices of
// libraries.
bool MayCarry(EntityKind kind, const DeviceConfiguration& device, const PluginDescription& plugin)
{
  if (!Carries(kind, device.type)) return false;
  const std::vector<std::string>& named = DescriptionOf(kind).devices;
  if (std::find(named.begin(), named.end(), device.type) == named.end()) return true;
  return std::none_of(plugin.robots.begin(), plugin.robots.end(),
                      [](const std::string& tag)
                      {
                        const auto robot = KindOfTag(tag);
                        return robot && IsBuiltIn(*robot);
                      });
}

// Checks devices that have the shape of the robot's kind, such as "wheels".
void CheckOneKind(const DeviceConfiguration& device, const ControllerConfiguration& controller,
                  const std::map<EntityKind, Use>& uses, Reading& reading)
{
  constexpr std::array<std::string_view, 6> kShaped{"wheels",           "joints",    "led_ring",
                                                    "directional_leds", "proximity", "ground"};
  if (uses.size() < 2 || std::find(kShaped.begin(), kShaped.end(), device.type) == kShaped.end()) return;
  const auto& [first_kind, first] = *uses.begin();
  const auto& [second_kind, second] = *std::next(uses.begin());
  reading.diagnostics.Add(
      device.tree.Location(),
      fmt::format(
          "<{}> has the shape of one kind of robot, but the {} '{}' and the {} '{}' both use the controller '{}'; "
          "list the controller once for each kind, with another id",
          device.type, TagName(first_kind), first.robot->id, TagName(second_kind), second.robot->id, controller.id));
}

void CheckDevices(const std::vector<DeviceConfiguration>& devices, PluginKind kind,
                  const ControllerConfiguration& controller, const std::map<EntityKind, Use>& uses, Reading& reading)
{
  for (const DeviceConfiguration& device : devices)
  {
    const PluginDescription* plugin = PluginCatalogue::Instance().Find(kind, device.type, device.implementation);
    CheckOneKind(device, controller, uses, reading);
    if (plugin == nullptr || plugin->robots.empty()) continue;
    for (const auto& [robot_kind, use] : uses)
    {
      const std::string tag(TagName(robot_kind));
      if (std::find(plugin->robots.begin(), plugin->robots.end(), tag) != plugin->robots.end()) continue;
      if (MayCarry(robot_kind, device, *plugin)) continue;
      const std::string more = use.count > 1 ? fmt::format(" and {} more {}s use", use.count - 1, tag) : " uses";
      reading.diagnostics.Add(device.tree.Location(),
                              fmt::format("the {} <{}> ({}) is for {} only, but the {} '{}'{} the controller '{}'",
                                          PluginKindName(kind), device.type, device.implementation,
                                          Listed(plugin->robots), tag, use.robot->id, more, controller.id));
    }
  }
}

}  // namespace

void ReadControllers(const TConfigurationTree& tree, Reading& reading)
{
  if (!tree.Exists()) return;
  const ElementReader list(tree, ExperimentSchema().Child("controllers"), reading.diagnostics);
  std::map<std::string, int> lines;
  for (const TConfigurationTree& child : tree.Children())
  {
    ControllerConfiguration controller = ReadController(child, reading);
    const auto [first, is_first] = lines.emplace(controller.id, child.Location().line);
    if (!is_first && !controller.id.empty())
    {
      reading.diagnostics.Add(
          child.ValueLocation("id"),
          fmt::format("two controllers have the id {}; the first is in line {}", Quoted(controller.id), first->second));
    }
    reading.experiment.controllers.push_back(std::move(controller));
  }
}

void CheckControllersOfRobots(Reading& reading)
{
  const Experiment& experiment = reading.experiment;
  std::vector<std::string> ids;
  std::map<std::string, std::map<EntityKind, Use>> uses;
  for (const ControllerConfiguration& controller : experiment.controllers)
  {
    ids.push_back(controller.id);
    uses[controller.id];
  }
  const ConfigurationNode* reported = nullptr;
  for (const EntityConfiguration& entity : experiment.entities)
  {
    if (entity.controller.empty()) continue;
    const auto found = uses.find(entity.controller);
    if (found != uses.end())
    {
      Use& use = found->second[entity.kind];
      if (use.robot == nullptr) use.robot = &entity;
      ++use.count;
    }
    else if (entity.tree.Node() != reported)
    {
      reported = entity.tree.Node();
      reading.diagnostics.Add(entity.tree.ValueLocation("controller"),
                              fmt::format("there is no controller with the id {}; there are: {}{}",
                                          Quoted(entity.controller), Listed(ids), DidYouMean(entity.controller, ids)));
    }
  }
  for (const ControllerConfiguration& controller : experiment.controllers)
  {
    CheckDevices(controller.actuators, PluginKind::kActuator, controller, uses[controller.id], reading);
    CheckDevices(controller.sensors, PluginKind::kSensor, controller, uses[controller.id], reading);
  }
}

}  // namespace swarmanoid
