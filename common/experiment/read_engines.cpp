#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <map>
#include <unordered_map>

#include "common/configuration/wording.h"
#include "common/experiment/element_reader.h"
#include "common/experiment/sections.h"

namespace swarmanoid
{

// fnmatch also treats '[' specially, but no id contains it.
bool FitsPattern(const std::string& id, const std::string& pattern)
{
  return pattern.find('[') == std::string::npos && fnmatch(pattern.c_str(), id.c_str(), FNM_NOESCAPE) == 0;
}

namespace
{

bool CanSimulate(const PluginDescription& engine, EntityKind kind)
{
  return (engine.any_kind && !IsBuiltIn(kind)) ||
         std::any_of(engine.entity_tags.begin(), engine.entity_tags.end(),
                     [&](const std::string& tag) { return KindOfTag(tag) == kind; });
}

std::string OthersThatSplit()
{
  std::vector<std::string> tags;
  for (const PluginDescription* plugin : PluginCatalogue::Instance().Of(PluginKind::kEngine))
    if (plugin->can_split) tags.push_back(plugin->label);
  return tags.empty() ? "" : ", or take " + Listed(tags);
}

// Reads the entities of one engine.
class MembersReader
{
public:
  MembersReader(EngineConfiguration& engine, const PluginDescription* plugin,
                const std::unordered_map<std::string_view, std::uint32_t>& index_of_id, Reading& reading)
      : engine_(engine),
        plugin_(plugin),
        index_of_id_(index_of_id),
        entities_(reading.experiment.entities),
        reading_(reading),
        member_(entities_.size(), false)
  {
  }

  void Read(const TConfigurationTree& tree, const ElementSpec& spec)
  {
    for (const TConfigurationTree& child : tree.Children())
    {
      const ElementSpec* element = spec.FindChild(child.Name());
      if (element == nullptr) continue;
      const ElementReader reader(child, *element, reading_.diagnostics);
      if (element->HasTag("all"))
      {
        AddAll(reader);
      }
      else if (reader.IsGiven("id"))
      {
        AddEntity(reader);
      }
    }
    for (std::size_t i = 0; i < member_.size(); ++i)
    {
      if (member_[i]) engine_.entities.push_back(static_cast<std::uint32_t>(i));
    }
  }

private:
  void AddEntity(const ElementReader& reader)
  {
    const std::string id = reader.Text("id");
    if (id.find_first_of("*?") != std::string::npos)
    {
      std::vector<std::uint32_t> fitting;
      for (std::size_t i = 0; i < entities_.size(); ++i)
      {
        if (FitsPattern(entities_[i].id, id)) fitting.push_back(static_cast<std::uint32_t>(i));
      }
      const auto fits = [&](const std::string& lost) { return FitsPattern(lost, id) || FitsPattern(lost + "_0", id); };
      if (fitting.empty() && !reading_.diagnostics.HasLost(fits))
        reading_.diagnostics.Add(reader.Place("id"), fmt::format("no entity fits {}", Quoted(id)));
      return AddSupported(fitting, reader.Place("id"));
    }
    const auto found = index_of_id_.find(id);
    if (found == index_of_id_.end())
    {
      if (reading_.diagnostics.IsLost(id)) return;
      // The message lists only some ids of a large arena.
      std::vector<std::string> ids;
      for (const EntityConfiguration& entity : entities_)
      {
        if (ids.size() < 1000) ids.push_back(entity.id);
      }
      const std::string known = ids.size() <= 20 ? "; there are: " + Listed(ids) : "";
      reading_.diagnostics.Add(reader.Place("id"),
                               fmt::format("there is no entity {}{}{}", Quoted(id), known, DidYouMean(id, ids)));
      return;
    }
    if (!named_.emplace(id, reader.Place("id").line).second)
    {
      reading_.diagnostics.Add(reader.Place("id"),
                               fmt::format("{} is listed twice in the engine '{}'; the first is in line {}", Quoted(id),
                                           engine_.id, named_[id]));
      return;
    }
    AddSupported({found->second}, reader.Place("id"));
  }

  void AddAll(const ElementReader& reader)
  {
    const std::string tag = reader.Text("kind");
    const auto kind = KindOfTag(tag);
    std::vector<std::string> tags;
    for (const ElementSpec& element : EntityElements()) tags.push_back(element.Name());
    if (!tag.empty() && !kind)
    {
      if (reading_.diagnostics.IsLost(tag)) return;
      reading_.diagnostics.Add(reader.Place("kind"), fmt::format("there is no kind of entity {}; known: {}{}",
                                                                 Quoted(tag), Listed(tags), DidYouMean(tag, tags)));
      return;
    }
    std::vector<std::uint32_t> fitting;
    for (std::size_t i = 0; i < entities_.size(); ++i)
    {
      const bool wanted =
          kind ? entities_[i].kind == *kind : plugin_ == nullptr || CanSimulate(*plugin_, entities_[i].kind);
      if (wanted) fitting.push_back(static_cast<std::uint32_t>(i));
    }
    AddSupported(fitting, kind ? reader.Place("kind") : reader.Tree().Location());
  }

  // Adds the entities; reports the first one that the engine cannot simulate.
  void AddSupported(const std::vector<std::uint32_t>& fitting, const SourceLocation& place)
  {
    bool reported = false;
    for (const std::uint32_t i : fitting)
    {
      const EntityConfiguration& entity = entities_[i];
      if (plugin_ == nullptr || CanSimulate(*plugin_, entity.kind))
      {
        member_[i] = true;
      }
      else if (!reported)
      {
        reported = true;
        reading_.diagnostics.Add(
            place, fmt::format("the engine '{}' ({}) cannot simulate the {} '{}'; it can: {}", engine_.id, engine_.tag,
                               TagName(entity.kind), entity.id, Listed(plugin_->entity_tags)));
      }
    }
  }

  EngineConfiguration& engine_;
  const PluginDescription* plugin_;
  const std::unordered_map<std::string_view, std::uint32_t>& index_of_id_;
  const std::vector<EntityConfiguration>& entities_;
  Reading& reading_;
  std::vector<bool> member_;
  std::map<std::string, int> named_;
};

void ReadSplit(const ElementReader& reader, const PluginDescription* plugin, EngineConfiguration& engine,
               Reading& reading)
{
  if (!reader.IsGiven("split")) return;
  const std::string text = reader.Text("split");
  const std::optional<EngineSplit> split = EngineSplit::Parse(text);
  if (!split)
    reading.diagnostics.Add(reader.Place("split"),
                            fmt::format("split is {}; it must be a number of regions from 1 to {} (\"4\"), or columns "
                                        "and rows of as many (\"2x2\")",
                                        Quoted(text), EngineSplit::kMostRegions));
  else if (split->regions > 1 && plugin != nullptr && !plugin->can_split)
    reading.diagnostics.Add(reader.Place("split"), fmt::format("the engine {} ({}) cannot be split; leave out split{}",
                                                               Quoted(engine.id), engine.tag, OthersThatSplit()));
  else
    engine.split = *split;
}

// Reads the volume of an engine, from its element in <arena_physics>.
void ReadVolume(const ElementReader& reader, const PluginDescription* plugin, EngineConfiguration& engine,
                Reading& reading)
{
  if (!reader.IsGiven("volume") && !reader.IsGiven("heights")) return;
  EngineVolume& volume = engine.volume;
  const std::string mistake = volume.ReadOutlines(reader.Text("volume"));
  if (!mistake.empty())
    reading.diagnostics.Add(reader.Place("volume"),
                            fmt::format("the volume of the engine '{}' is {}: {}; for example \"0, 0, 4, 3\" is a "
                                        "rectangle, and \"0, 0, 4, 0, 4, 3\" a triangle",
                                        engine.id, Quoted(volume.text), mistake));
  if (reader.IsGood("heights"))
  {
    const Vector3 heights = reader.Vector("heights");
    volume.low = heights.x();
    volume.high = heights.y();
    if (!(volume.low < volume.high))
      reading.diagnostics.Add(reader.Place("heights"),
                              fmt::format("the volume of the engine '{}' reaches from {:g} to {:g} m; the first height "
                                          "must be the lower one",
                                          engine.id, volume.low, volume.high));
  }
  if (plugin != nullptr && !plugin->hands_over)
    reading.diagnostics.Add(
        reader.Place(reader.IsGiven("volume") ? "volume" : "heights"),
        fmt::format("the engine '{}' ({}) cannot hand over entities, so it has no volume; leave volume and heights out",
                    engine.id, engine.tag));
}

}  // namespace

void ReadEngines(const TConfigurationTree& tree, Reading& reading)
{
  if (!tree.Exists()) return;
  const ElementSpec& spec = ExperimentSchema().Child("engines");
  const ElementReader list(tree, spec, reading.diagnostics);
  std::map<std::string, int> lines;
  for (const TConfigurationTree& child : tree.Children())
  {
    const PluginDescription* plugin = FindPlugin(PluginKind::kEngine, child, reading);
    const ElementReader reader(child, spec.plugin_element.front(), reading.diagnostics,
                               plugin != nullptr ? &plugin->parameters : nullptr, plugin == nullptr);
    EngineConfiguration engine;
    engine.tag = child.Name();
    engine.id = reader.Text("id");
    engine.subclock = static_cast<int>(reader.Integer("subclock"));
    ReadSplit(reader, plugin, engine, reading);
    engine.tree = child;
    engine.location = child.Location();
    if (reader.IsGiven("id")) CheckId(engine.id, reader.Place("id"), reading.diagnostics);
    const auto [first, is_first] = lines.emplace(engine.id, child.Location().line);
    if (!is_first && !engine.id.empty())
    {
      reading.diagnostics.Add(reader.Place("id"), fmt::format("two engines have the id {}; the first is in line {}",
                                                              Quoted(engine.id), first->second));
    }
    reading.experiment.engines.push_back(std::move(engine));
  }
}

void ReadArenaPhysics(const TConfigurationTree& tree, Reading& reading)
{
  if (!tree.Exists()) return;
  const ElementSpec& spec = ExperimentSchema().Child("arena_physics");
  const ElementReader list(tree, spec, reading.diagnostics);
  Experiment& experiment = reading.experiment;
  if (list.Text("outside") == "keep") experiment.outside_volumes = OutsideVolumes::kKeep;

  std::unordered_map<std::string_view, std::uint32_t> index_of_id;
  index_of_id.reserve(experiment.entities.size());
  for (std::size_t i = 0; i < experiment.entities.size(); ++i)
  {
    index_of_id.emplace(experiment.entities[i].id, static_cast<std::uint32_t>(i));
  }
  std::vector<std::string> ids;
  for (const EngineConfiguration& engine : experiment.engines) ids.push_back(engine.id);

  std::map<std::string, int> lines;
  for (const TConfigurationTree& child : tree.Children())
  {
    if (!spec.FindChild(child.Name())) continue;
    const ElementReader reader(child, spec.Child("engine"), reading.diagnostics);
    if (!reader.IsGiven("id")) continue;
    const std::string id = reader.Text("id");
    const auto engine = std::find_if(experiment.engines.begin(), experiment.engines.end(),
                                     [&](const EngineConfiguration& one) { return one.id == id; });
    const auto [first, is_first] = lines.emplace(id, child.Location().line);
    if (engine == experiment.engines.end())
    {
      reading.diagnostics.Add(reader.Place("id"), fmt::format("there is no engine {}; there are: {}{}", Quoted(id),
                                                              Listed(ids), DidYouMean(id, ids)));
    }
    else if (!is_first)
    {
      reading.diagnostics.Add(reader.Place("id"),
                              fmt::format("the entities of the engine {} are given twice; the first time in "
                                          "line {}",
                                          Quoted(id), first->second));
    }
    else
    {
      const PluginDescription* plugin = PluginCatalogue::Instance().Find(PluginKind::kEngine, engine->tag);
      MembersReader(*engine, plugin, index_of_id, reading).Read(child, spec.Child("engine"));
      ReadVolume(reader, plugin, *engine, reading);
    }
  }
}

}  // namespace swarmanoid
