// Problem: find the engine that moves an entity at a place, with the same answer in all processes, and without a gap or
// an overlap between volumes that share an edge.
//
// Method: a ray from the point to larger x crosses the edges of all outlines; an odd number of crossings means inside
// (M. Shimrat, "Algorithm 112: position of point relative to polygon", 1962). An edge counts for y from its lower end
// on, to below its upper end.
//
// Invariant: an edge is evaluated from its lower to its upper end, whichever way its outline runs. So two outlines that
// share an edge find a point on the same side of it, to the bit.
#include "common/experiment/engine_volumes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/experiment/experiment.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid
{
namespace
{

bool IsLeftOf(const Vector3& point, const Vector2& from, const Vector2& to)
{
  const Vector2& lower = from.y() < to.y() ? from : to;
  const Vector2& upper = from.y() < to.y() ? to : from;
  if (!(lower.y() <= point.y() && point.y() < upper.y())) return false;
  return point.x() < lower.x() + (point.y() - lower.y()) / (upper.y() - lower.y()) * (upper.x() - lower.x());
}

bool ServesAll(const PluginDescription& engine, const std::vector<DeviceConfiguration>& devices, PluginKind kind)
{
  return std::ranges::all_of(devices,
                             [&](const DeviceConfiguration& device)
                             {
                               const PluginDescription* plugin =
                                   PluginCatalogue::Instance().Find(kind, device.type, device.implementation);
                               return plugin == nullptr || plugin->channel.empty() ||
                                      std::ranges::find(engine.channels, plugin->channel) != engine.channels.end();
                             });
}

bool ServesRobotsOf(const EngineConfiguration& engine, const ControllerConfiguration& controller)
{
  const PluginDescription* plugin = PluginCatalogue::Instance().Find(PluginKind::kEngine, engine.tag);
  return plugin != nullptr && ServesAll(*plugin, controller.actuators, PluginKind::kActuator) &&
         ServesAll(*plugin, controller.sensors, PluginKind::kSensor);
}

// Returns the engines that list each entity.
std::vector<std::vector<std::uint32_t>> ListingEngines(const Experiment& experiment)
{
  std::vector<std::vector<std::uint32_t>> engines(experiment.entities.size());
  for (std::uint32_t e = 0; e < experiment.engines.size(); ++e)
    for (const std::uint32_t entity : experiment.engines[e].entities) engines[entity].push_back(e);
  return engines;
}

bool HasVolumes(const Experiment& experiment)
{
  return std::ranges::any_of(experiment.engines,
                             [](const EngineConfiguration& engine) { return !engine.volume.IsWhole(); });
}

}  // namespace

bool EngineVolume::Holds(const Vector3& point) const
{
  if (!(low <= point.z() && point.z() < high)) return false;
  if (outlines.empty()) return true;
  bool inside = false;
  for (const std::vector<Vector2>& outline : outlines)
    for (std::size_t k = 0; k < outline.size(); ++k)
      inside ^= IsLeftOf(point, outline[k], outline[(k + 1) % outline.size()]);
  return inside;
}

std::string EngineVolume::Text() const
{
  if (IsWhole()) return "everywhere";
  std::string all = outlines.empty() ? "everywhere" : "within " + text;
  if (std::isfinite(low) || std::isfinite(high)) all += fmt::format(" from {:g} to {:g} m high", low, high);
  return all;
}

std::string EngineVolume::ReadOutlines(std::string_view from)
{
  text = std::string(TrimBlanks(from));
  outlines.clear();
  std::size_t corners = 0;
  for (std::string_view rest = text; !text.empty();)
  {
    const std::size_t end = std::min(rest.find(';'), rest.size());
    const auto numbers = ParseNumbers(rest.substr(0, end));
    if (!numbers || numbers->size() % 2 != 0 || numbers->size() < 4)
      return "an outline has x and y of at least two corners, in m";
    std::vector<Vector2> outline;
    for (std::size_t k = 0; k < numbers->size(); k += 2) outline.emplace_back((*numbers)[k], (*numbers)[k + 1]);
    if (outline.size() == 2)
    {
      const Vector2 a = outline[0];
      const Vector2 b = outline[1];
      if (a.x() == b.x() || a.y() == b.y())
        return "two corners are opposite corners of a rectangle, so both x and y must differ";
      outline = {a, {b.x(), a.y()}, b, {a.x(), b.y()}};
    }
    corners += outline.size();
    outlines.push_back(std::move(outline));
    if (end == rest.size()) break;
    rest.remove_prefix(end + 1);
  }
  return corners > kMostCorners ? fmt::format("it has {} corners, more than {}", corners, kMostCorners) : std::string();
}

std::size_t EngineChoices::PlaceOf(std::uint32_t entity) const
{
  const auto at = std::ranges::lower_bound(entities, entity);
  return at == entities.end() || *at != entity ? entities.size() : static_cast<std::size_t>(at - entities.begin());
}

std::span<const std::uint32_t> EngineChoices::Of(std::uint32_t entity) const
{
  const std::size_t place = PlaceOf(entity);
  if (place == entities.size()) return {};
  return sets[set_of[place]];
}

EngineChoices FindEngineChoices(const Experiment& experiment)
{
  EngineChoices choices;
  if (!HasVolumes(experiment)) return choices;
  const std::vector<std::vector<std::uint32_t>> listing = ListingEngines(experiment);
  std::map<std::pair<std::string, std::uint32_t>, bool> serves;  // by controller and engine
  std::map<std::vector<std::uint32_t>, std::uint32_t> numbers;   // of the sets
  for (std::uint32_t i = 0; i < listing.size(); ++i)
  {
    const EntityConfiguration& entity = experiment.entities[i];
    if (listing[i].empty() || !entity.movable || IsBodiless(entity.kind) || IsFreeBox(entity.kind)) continue;
    if (std::ranges::all_of(listing[i], [&](std::uint32_t e) { return experiment.engines[e].volume.IsWhole(); }))
      continue;
    const ControllerConfiguration* controller =
        entity.controller.empty() ? nullptr : experiment.FindController(entity.controller);
    std::vector<std::uint32_t> engines;
    for (const std::uint32_t e : listing[i])
    {
      if (controller != nullptr)
      {
        const auto [known, is_new] = serves.try_emplace({entity.controller, e}, false);
        if (is_new) known->second = ServesRobotsOf(experiment.engines[e], *controller);
        if (!known->second) continue;
      }
      engines.push_back(e);
    }
    // If no engine serves its devices, the check of devices reports it for the first one.
    if (engines.empty()) engines = listing[i];
    const auto number = static_cast<std::uint32_t>(choices.sets.size());
    const auto [set, is_new] = numbers.try_emplace(engines, number);
    if (is_new) choices.sets.push_back(std::move(engines));
    choices.entities.push_back(i);
    choices.set_of.push_back(set->second);
  }
  return choices;
}

std::uint32_t EngineAt(const Experiment& experiment, std::span<const std::uint32_t> engines, const Vector3& point)
{
  for (const std::uint32_t engine : engines)
    if (experiment.engines[engine].volume.Holds(point)) return engine;
  return EngineChoices::kNoEngine;
}

std::string VolumesText(const Experiment& experiment, std::span<const std::uint32_t> engines)
{
  std::string all;
  for (const std::uint32_t e : engines)
  {
    const EngineConfiguration& engine = experiment.engines[e];
    all += fmt::format("{}'{}' {}", all.empty() ? "" : ", ", engine.id, engine.volume.Text());
  }
  return all;
}

std::vector<int> StartEngines(const Experiment& experiment)
{
  std::vector<int> engines(experiment.entities.size(), -1);
  const auto is_moved = [&](std::uint32_t i)
  { return experiment.entities[i].movable && !IsBodiless(experiment.entities[i].kind); };
  if (!HasVolumes(experiment))
  {
    for (std::size_t e = 0; e < experiment.engines.size(); ++e)
      for (const std::uint32_t entity : experiment.engines[e].entities)
        if (is_moved(entity) && engines[entity] < 0) engines[entity] = static_cast<int>(e);
    return engines;
  }
  const std::vector<std::vector<std::uint32_t>> listing = ListingEngines(experiment);
  for (std::uint32_t i = 0; i < listing.size(); ++i)
  {
    if (listing[i].empty() || !is_moved(i)) continue;
    const std::span<const std::uint32_t> choices = experiment.engine_choices.Of(i);
    const std::span<const std::uint32_t> all = choices.empty() ? std::span<const std::uint32_t>(listing[i]) : choices;
    const std::uint32_t first = EngineAt(experiment, all, experiment.entities[i].pose.position);
    engines[i] = static_cast<int>(first == EngineChoices::kNoEngine ? all.front() : first);
  }
  return engines;
}

}  // namespace swarmanoid
