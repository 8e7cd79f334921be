#include "common/experiment/notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "common/experiment/urdf_kind.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid
{
namespace
{

bool Has(const EngineConfiguration& engine, std::uint32_t entity)
{
  return std::binary_search(engine.entities.begin(), engine.entities.end(), entity);
}

bool Ignores(const EngineConfiguration& engine, const std::string& name)
{
  const PluginDescription* plugin = PluginCatalogue::Instance().Find(PluginKind::kEngine, engine.tag);
  return plugin != nullptr && std::find(plugin->ignores.begin(), plugin->ignores.end(), name) != plugin->ignores.end();
}

// Returns the engine that ignores a parameter of an entity, if all engines of the entity do; nullptr otherwise.
const EngineConfiguration* OnlyIgnoredBy(const Experiment& experiment, std::uint32_t entity, const std::string& name)
{
  const EngineConfiguration* found = nullptr;
  for (const EngineConfiguration& engine : experiment.engines)
  {
    if (!Has(engine, entity)) continue;
    if (!Ignores(engine, name)) return nullptr;
    found = &engine;
  }
  return found;
}

constexpr std::size_t kMostNamed = 3;

// Returns the note about robots without a controller, at the first of them; nothing if all have one.
std::optional<Diagnostic> NoteOnStillRobots(const Experiment& experiment)
{
  std::vector<std::string> ids;
  const EntityConfiguration* first = nullptr;
  std::size_t count = 0;
  for (const EntityConfiguration& entity : experiment.entities)
  {
    if (!IsRobot(entity.kind) || !entity.controller.empty()) continue;
    if (first == nullptr) first = &entity;
    if (++count <= kMostNamed) ids.push_back(entity.id);
  }
  if (first == nullptr) return std::nullopt;
  return Diagnostic{first->location,
                    count == 1
                        ? fmt::format("the robot '{}' has no controller, and does nothing by itself", ids.front())
                        : fmt::format("{} robots have no controller, and do nothing by themselves: {}{}", count,
                                      fmt::join(ids, ", "), count > kMostNamed ? " …" : "")};
}

}  // namespace

std::vector<Diagnostic> NotesOn(const Experiment& experiment)
{
  std::vector<Diagnostic> notes;
  std::set<std::string> places;
  const auto note = [&](const SourceLocation& place, std::string text)
  {
    if (places.insert(place.Text()).second) notes.push_back({place, std::move(text)});
  };
  for (const EntityKindConfiguration& kind : experiment.entity_kinds)
    if (const UrdfKind* urdf = FindUrdfKind(kind.tag))
      for (const Diagnostic& found : urdf->notes) note(found.location, found.message);
  if (const auto still = NoteOnStillRobots(experiment)) note(still->location, still->message);
  for (const EngineConfiguration& engine : experiment.engines)
    if (engine.entities.empty() && engine.volume.IsWhole())
      note(engine.location,
           fmt::format("the engine '{}' ({}) has no entities; list some in <arena_physics>", engine.id, engine.tag));
  for (std::uint32_t i = 0; i < experiment.entities.size(); ++i)
  {
    const EntityConfiguration& entity = experiment.entities[i];
    const EntityKindDescription& kind = DescriptionOf(entity.kind);
    for (const ParameterSpec& parameter : kind.parameters)
    {
      if (!entity.tree.Value(parameter.name)) continue;
      if (const EngineConfiguration* engine = OnlyIgnoredBy(experiment, i, parameter.name))
        note(entity.tree.ValueLocation(parameter.name),
             fmt::format("the {} of the {} '{}' has no effect: its engine '{}' ({}) does not use it", parameter.name,
                         TagName(entity.kind), entity.id, engine->id, engine->tag));
    }
    if (kind.role != EntityRole::kHole) continue;
    const auto heeds = [&](const EngineConfiguration& engine) { return Has(engine, i) && !Ignores(engine, kind.tag); };
    if (std::none_of(experiment.engines.begin(), experiment.engines.end(), heeds))
      note(entity.location,
           fmt::format("nothing can fall into the hole '{}': none of the engines that have it knows holes, so robots "
                       "drive over it; list it in an engine of three dimensions, such as dynamics3d, with its robots",
                       entity.id));
  }
  return notes;
}

}  // namespace swarmanoid
