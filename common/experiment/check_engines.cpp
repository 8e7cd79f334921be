#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "common/configuration/wording.h"
#include "common/experiment/body.h"
#include "common/experiment/sections.h"
#include "common/math/elementary.h"

namespace swarmanoid
{
namespace
{

// Reports each channel that the robots of a controller need and their engine does not serve, once.
void CheckChannels(const EngineConfiguration& engine, const PluginDescription& plugin,
                   const ControllerConfiguration& controller, const EntityConfiguration& robot, Reading& reading)
{
  const auto check = [&](const std::vector<DeviceConfiguration>& devices, PluginKind kind)
  {
    for (const DeviceConfiguration& device : devices)
    {
      const PluginDescription* found = PluginCatalogue::Instance().Find(kind, device.type, device.implementation);
      if (found == nullptr || found->channel.empty()) continue;
      if (std::find(plugin.channels.begin(), plugin.channels.end(), found->channel) != plugin.channels.end()) continue;
      reading.diagnostics.Add(
          device.tree.Location(),
          fmt::format(
              "the {} <{}> ({}) of the robot '{}' needs '{}' from its engine, which '{}' ({}) does not offer; it "
              "offers: {}. Use another implementation or another engine",
              PluginKindName(kind), device.type, device.implementation, robot.id, found->channel, engine.id, engine.tag,
              Listed(plugin.channels)));
    }
  };
  check(controller.actuators, PluginKind::kActuator);
  check(controller.sensors, PluginKind::kSensor);
}

// Returns the first device of a controller that needs an engine, nullptr if none does.
const DeviceConfiguration* FirstSpecificDevice(const ControllerConfiguration& controller)
{
  const auto find = [](const std::vector<DeviceConfiguration>& devices, PluginKind kind) -> const DeviceConfiguration*
  {
    for (const DeviceConfiguration& device : devices)
    {
      const PluginDescription* found = PluginCatalogue::Instance().Find(kind, device.type, device.implementation);
      if (found != nullptr && !found->channel.empty()) return &device;
    }
    return nullptr;
  };
  const DeviceConfiguration* actuator = find(controller.actuators, PluginKind::kActuator);
  return actuator != nullptr ? actuator : find(controller.sensors, PluginKind::kSensor);
}

// Reports robots without an engine whose devices need one, once for each controller. These robots stay where they are,
// so their devices would do nothing, unnoticed.
void CheckRobotsWithoutEngine(const std::vector<bool>& owned, Reading& reading)
{
  const Experiment& experiment = reading.experiment;
  std::map<std::string, bool> checked;
  for (std::size_t i = 0; i < owned.size(); ++i)
  {
    const EntityConfiguration& robot = experiment.entities[i];
    if (owned[i] || robot.controller.empty() || !checked.emplace(robot.controller, true).second) continue;
    const ControllerConfiguration* controller = experiment.FindController(robot.controller);
    const DeviceConfiguration* device = controller == nullptr ? nullptr : FirstSpecificDevice(*controller);
    if (device == nullptr) continue;
    reading.diagnostics.Add(
        robot.location,
        fmt::format("the robot '{}' is in no engine, but <{}> ({}) of its controller '{}' needs one; list the robot "
                    "under an engine in <arena_physics>, or leave the device out",
                    robot.id, device->type, device->implementation, controller->id));
  }
}

// Reports the first robot of an engine that cannot move its links.
void CheckLinks(const EngineConfiguration& engine, const std::vector<int>& engine_of, Reading& reading)
{
  const auto number = &engine - reading.experiment.engines.data();
  const auto moves = [&](std::uint32_t entity)
  {
    const auto choices = reading.experiment.engine_choices.Of(entity);
    return engine_of[entity] == number || (choices.size() > 1 && std::ranges::find(choices, number) != choices.end());
  };
  const PluginDescription* plugin = PluginCatalogue::Instance().Find(PluginKind::kEngine, engine.tag);
  if (plugin == nullptr || plugin->moves_links) return;
  for (const std::uint32_t i : engine.entities)
  {
    const EntityConfiguration& entity = reading.experiment.entities[i];
    if (!StandsOnLinks(entity.kind) || !moves(i)) continue;
    return reading.diagnostics.Add(
        entity.location, fmt::format("the {} '{}' stands on links that joints move, which the engine '{}' ({}) cannot "
                                     "move; use dynamics3d",
                                     TagName(entity.kind), entity.id, engine.id, engine.tag));
  }
}

// An entity farther than this from its plane would jump to it in the first tick (m).
constexpr double kOnPlane = 1e-3;

// A body that leans more is straightened in the first tick (rad).
constexpr double kUpright = 1e-3;

// The plane of an engine, if it has one.
struct Plane
{
  Vector3 normal;
  double distance;  // m, from the origin along the normal
};

std::optional<Plane> PlaneOf(const EngineConfiguration& engine)
{
  if (!MovesOnPlane(engine)) return std::nullopt;
  const PluginDescription& plugin = *PluginCatalogue::Instance().Find(PluginKind::kEngine, engine.tag);
  const Parameters parameters(engine.tree, plugin.parameters);
  const std::string axis = parameters.Text("perpendicular_axis");
  const Vector3 tilt = parameters.Vector3Of("tilt");
  const Vector3 upright = axis == "x" ? Vector3::UnitX() : axis == "y" ? Vector3::UnitY() : Vector3::UnitZ();
  const Quaternion turn =
      QuaternionFromEuler({DegreesToRadians(tilt.x()), DegreesToRadians(tilt.y()), DegreesToRadians(tilt.z())});
  return Plane{turn * upright, parameters.Number("distance")};
}

}  // namespace

bool MovesOnPlane(const EngineConfiguration& engine)
{
  const PluginDescription* plugin = PluginCatalogue::Instance().Find(PluginKind::kEngine, engine.tag);
  if (plugin == nullptr) return false;
  const auto takes = [&](std::string_view name)
  {
    return std::any_of(plugin->parameters.begin(), plugin->parameters.end(),
                       [name](const ParameterSpec& spec) { return spec.name == name; });
  };
  return takes("perpendicular_axis") && takes("tilt") && takes("distance");
}

namespace
{

// On a level plane an entity must stand upright. On other planes the engine uses only its heading.
void CheckLean(const EntityConfiguration& entity, const EngineConfiguration& engine, const Plane& plane,
               Reading& reading)
{
  if (plane.normal.z() < std::cos(kUpright)) return;
  const double cosine = (entity.pose.orientation * Vector3::UnitZ()).z();
  const double lean = std::acos(std::clamp(cosine, -1.0, 1.0));
  if (!(lean > kUpright)) return;
  reading.diagnostics.Add(
      entity.tree.ValueLocation("orientation"),
      fmt::format("the {} '{}' leans by {:.4g} degrees; it must stand upright on the plane of the engine '{}', which "
                  "turns it about the vertical only: write the orientation 0, 0, {:.6g}, or use an engine of three "
                  "dimensions, such as dynamics3d",
                  TagName(entity.kind), entity.id, RadiansToDegrees(lean), engine.id,
                  RadiansToDegrees(YawOf(entity.pose.orientation))));
}

}  // namespace

// Robots and preys stand on the plane of the engine that moves them; blocks keep their height.
void CheckPlanes(Reading& reading)
{
  const Experiment& experiment = reading.experiment;
  const std::vector<int> engine_of = StartEngines(experiment);
  for (const EngineConfiguration& engine : experiment.engines)
  {
    const std::optional<Plane> plane = PlaneOf(engine);
    for (const std::uint32_t i : engine.entities)
    {
      const EntityConfiguration& entity = experiment.entities[i];
      const bool ours = engine_of[i] == &engine - experiment.engines.data();
      if (!plane || !ours || !entity.movable || entity.waits || IsBodiless(entity.kind) || IsFreeBox(entity.kind))
        continue;
      CheckLean(entity, engine, *plane, reading);
      const double height = plane->normal.dot(entity.pose.position) - plane->distance;
      if (!(std::fabs(height) > kOnPlane)) continue;
      const Vector3 foot = entity.pose.position - height * plane->normal;
      reading.diagnostics.Add(
          entity.tree.ValueLocation("position"),
          fmt::format(
              "the {} '{}' is {:.4g} m off the plane of the engine '{}', which moves it on that plane only; put "
              "it to {:.6g}, {:.6g}, {:.6g}, or move the plane",
              TagName(entity.kind), entity.id, std::fabs(height), engine.id, foot.x(), foot.y(), foot.z()));
    }
  }
}

void CheckDevicesOfEngines(Reading& reading)
{
  const Experiment& experiment = reading.experiment;
  const std::vector<int> engine_of = StartEngines(experiment);
  std::vector<bool> owned(experiment.entities.size(), false);
  for (const EngineConfiguration& engine : experiment.engines)
  {
    CheckLinks(engine, engine_of, reading);
    const PluginDescription* plugin = PluginCatalogue::Instance().Find(PluginKind::kEngine, engine.tag);
    std::map<std::string, bool> checked;
    for (const std::uint32_t i : engine.entities)
    {
      const EntityConfiguration& entity = experiment.entities[i];
      const bool ours = engine_of[i] == &engine - experiment.engines.data();
      owned[i] = true;
      if (!ours || plugin == nullptr || entity.controller.empty() || !checked.emplace(entity.controller, true).second)
        continue;
      const ControllerConfiguration* controller = experiment.FindController(entity.controller);
      if (controller != nullptr) CheckChannels(engine, *plugin, *controller, entity, reading);
    }
  }
  // A mistake in the lists of engines would make the robots look wrong.
  if (reading.diagnostics.Empty()) CheckRobotsWithoutEngine(owned, reading);
}

// Entities of engines with volumes must start in a volume, and engines that share them must be able to hand over.
void CheckVolumes(Reading& reading)
{
  const Experiment& experiment = reading.experiment;
  const EngineChoices& choices = experiment.engine_choices;
  std::vector<bool> reported(experiment.engines.size(), false);
  for (std::size_t k = 0; k < choices.entities.size(); ++k)
  {
    const EntityConfiguration& entity = experiment.entities[choices.entities[k]];
    const std::vector<std::uint32_t>& engines = choices.sets[choices.set_of[k]];
    for (const std::uint32_t e : engines)
    {
      const EngineConfiguration& engine = experiment.engines[e];
      const PluginDescription* plugin = PluginCatalogue::Instance().Find(PluginKind::kEngine, engine.tag);
      if (plugin == nullptr || plugin->hands_over || reported[e]) continue;
      reported[e] = true;
      reading.diagnostics.Add(engine.location,
                              fmt::format("the engine '{}' ({}) cannot take over or hand over the {} '{}', which it "
                                          "shares with engines that have a volume; list it in the others alone",
                                          engine.id, engine.tag, TagName(entity.kind), entity.id));
    }
    if (entity.waits || experiment.outside_volumes == OutsideVolumes::kKeep) continue;
    const Vector3& at = entity.pose.position;
    // A height on a terrain that cannot be read has been reported already.
    if (!at.allFinite() || EngineAt(experiment, engines, at) != EngineChoices::kNoEngine) continue;
    reading.diagnostics.Add(
        entity.tree.ValueLocation("position"),
        fmt::format("the {} '{}' starts at {:g}, {:g}, {:g}, outside the volumes of all engines "
                    "that can move it: {}; put it into one, or write outside=\"keep\" at "
                    "<arena_physics>",
                    TagName(entity.kind), entity.id, at.x(), at.y(), at.z(), VolumesText(experiment, engines)));
  }
}

void CheckOverlaps(Reading& reading)
{
  const Experiment& experiment = reading.experiment;
  if (!(experiment.arena_size.minCoeff() > 0)) return;
  for (const EngineConfiguration& engine : experiment.engines)
  {
    placement::BodyGrid grid(experiment.arena_size, 0.25);
    const auto add = [&](bool movable)
    {
      for (const std::uint32_t i : engine.entities)
      {
        const EntityConfiguration& entity = experiment.entities[i];
        if (entity.movable != movable || !entity.reserve.empty()) continue;
        const auto body = placement::BodyOf(entity);
        if (!body || !(entity.size.minCoeff() > 0) || !entity.pose.position.allFinite()) continue;
        // Furniture is made of overlapping blocks, so only movable bodies must be free.
        if (const auto other = movable ? grid.Find(*body) : std::nullopt)
        {
          const EntityConfiguration& there = experiment.entities[*other];
          reading.diagnostics.Add(
              entity.tree.ValueLocation("position"),
              fmt::format("the {} '{}' overlaps the {} '{}' (line {}) in the engine '{}'; move one of them",
                          TagName(entity.kind), entity.id, TagName(there.kind), there.id, there.location.line,
                          engine.id));
        }
        grid.Add(*body, i);
      }
    };
    add(false);
    add(true);
  }
}

}  // namespace swarmanoid
