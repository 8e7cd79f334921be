// Method: the tree of the experiment is read again with the other engine, which finds all mistakes that this would
// make. The differences of its devices come from the table of engines, and those of its entities from the notes before
// and after.
#include "launcher/command/engine_exchange.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "common/configuration/xml_writer.h"
#include "common/experiment/notes.h"
#include "common/experiment/source_places.h"
#include "common/plugin_descriptions/engine_differences.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid
{
namespace
{

bool IsSame(const std::string& a, const std::string& b)
{
  const auto name = [](const std::string& tag) { return tag == "dummy_engine" ? "kinematics2d" : tag; };
  return name(a) == name(b);
}

const PluginDescription& PluginOf(const std::string& engine)
{
  return *PluginCatalogue::Instance().Find(PluginKind::kEngine, engine);
}

bool HasParameter(const PluginDescription& plugin, const std::string& name)
{
  return std::ranges::find(plugin.parameters, name, &ParameterSpec::name) != plugin.parameters.end();
}

// Returns the element of an engine with the tag of another one. Parameters that this one lacks are left out.
std::shared_ptr<const ConfigurationNode> Renamed(const ConfigurationNode& engine, const std::string& tag,
                                                 std::vector<Diagnostic>& changes)
{
  auto renamed = std::make_shared<ConfigurationNode>(engine);
  const PluginDescription& before = PluginOf(engine.name);
  const PluginDescription& after = PluginOf(tag);
  const auto is_lost = [&](const std::string& name, const SourceLocation& location)
  {
    if (!HasParameter(before, name) || HasParameter(after, name)) return false;
    changes.push_back({location, fmt::format("'{}' is no parameter of {}, and is left out", name, tag)});
    return true;
  };
  std::erase_if(renamed->attributes,
                [&](const auto& attribute) { return is_lost(attribute.name, attribute.location); });
  std::erase_if(renamed->children, [&](const auto& child) { return is_lost(child->name, child->location); });
  renamed->name = tag;
  return renamed;
}

std::shared_ptr<const ConfigurationNode> WithEngine(const ConfigurationNode& root, const std::string& tag,
                                                    std::vector<Diagnostic>& changes)
{
  auto changed = std::make_shared<ConfigurationNode>(root);
  for (auto& section : changed->children)
  {
    if (section->name != "engines") continue;
    auto engines = std::make_shared<ConfigurationNode>(*section);
    for (auto& engine : engines->children)
      if (!IsSame(engine->name, tag)) engine = Renamed(*engine, tag, changes);
    section = engines;
  }
  return changed;
}

class DeviceChanges
{
public:
  DeviceChanges(const EngineConfiguration& before, const std::string& after, std::vector<Diagnostic>& changes)
      : before_(before.tag), after_(after), changes_(changes)
  {
    for (const EngineDifference& row : EngineDifferences())
      if (row.channels.empty()) Add(before.location, row);
  }

  void Add(const ControllerConfiguration& controller)
  {
    std::set<const EngineDifference*> added;
    const auto add = [&](PluginKind kind, const std::vector<DeviceConfiguration>& devices)
    {
      for (const DeviceConfiguration& device : devices)
      {
        const PluginDescription* plugin = PluginCatalogue::Instance().Find(kind, device.type, device.implementation);
        if (plugin == nullptr || plugin->channel.empty()) continue;
        for (const EngineDifference& row : EngineDifferences())
          if (std::ranges::find(row.channels, plugin->channel) != row.channels.end() && added.insert(&row).second)
            Add(device.tree.Location(), row);
      }
    };
    add(PluginKind::kActuator, controller.actuators);
    add(PluginKind::kSensor, controller.sensors);
  }

private:
  void Add(const SourceLocation& location, const EngineDifference& row)
  {
    const std::string_view now = row.In(before_);
    const std::string_view then = row.In(after_);
    if (now == then || then.empty()) return;
    changes_.push_back({location, fmt::format("{}: {}{}", row.subject, then,
                                              now.empty() ? "" : fmt::format("; with {}: {}", before_, now))});
  }

  const std::string& before_;
  const std::string& after_;
  std::vector<Diagnostic>& changes_;
};

// Adds the notes that one of the two experiments has alone.
void CompareNotes(const Experiment& before, const Experiment& after, std::vector<Diagnostic>& changes)
{
  const std::vector<Diagnostic> old_notes = NotesOn(before);
  const std::vector<Diagnostic> new_notes = NotesOn(after);
  const auto has = [](const std::vector<Diagnostic>& notes, const Diagnostic& note)
  { return std::ranges::find(notes, note.Text(), &Diagnostic::Text) != notes.end(); };
  for (const Diagnostic& note : new_notes)
    if (!has(old_notes, note)) changes.push_back(note);
  for (const Diagnostic& note : old_notes)
    if (!has(new_notes, note)) changes.push_back({note.location, "it is no longer so that " + note.message});
}

}  // namespace

EngineExchange ExchangeEngines(const Experiment& experiment, const std::string& places, const std::string& engine)
{
  EngineExchange exchange;
  std::set<std::string> seen;
  std::vector<bool> owned(experiment.entities.size(), false);
  for (const EngineConfiguration& before : experiment.engines)
  {
    std::set<std::string> controllers;
    for (const std::uint32_t entity : before.entities)
    {
      if (!owned[entity]) controllers.insert(experiment.entities[entity].controller);
      owned[entity] = true;
    }
    if (IsSame(before.tag, engine)) continue;
    DeviceChanges devices(before, engine, exchange.changes);
    for (const ControllerConfiguration& controller : experiment.controllers)
      if (controllers.contains(controller.id) && seen.insert(controller.id + " " + before.tag).second)
        devices.Add(controller);
  }
  const auto root = ReadXmlWithPlaces(experiment.effective_xml + places, experiment.name);
  const auto changed = WithEngine(*root, engine, exchange.changes);
  LoadedExperiment loaded =
      LoadExperimentText(WriteXml(*changed) + WritePlaces(*changed), experiment.name, experiment.folder);
  exchange.errors = std::move(loaded.errors);
  if (loaded.experiment) CompareNotes(experiment, *loaded.experiment, exchange.changes);
  return exchange;
}

}  // namespace swarmanoid
