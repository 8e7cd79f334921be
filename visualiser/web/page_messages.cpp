#include "visualiser/web/page_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "common/messages/control_verbs.h"
#include "common/space/attributes.h"
#include "common/space/space.h"
#include "common/space/terrain/terrain.h"
#include "visualiser/scene/kind_model.h"
#include "visualiser/scene/meshes_json.h"
#include "visualiser/scene/object_model.h"
#include "visualiser/scene/painted_floor.h"
#include "visualiser/status_line.h"

namespace swarmanoid
{
namespace
{

using Json = nlohmann::ordered_json;

constexpr double kLastTick = 1e15;
constexpr std::size_t kMostEvents = 1000;  // the most marks of a timeline
constexpr int kTerrainSamples = 128;       // along each side
constexpr int kPicturePixels = 256;        // for a picture on the floor, along each side

std::string Text(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json Vector(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

// Returns the surface seen from above on a grid, in the terrain's frame; null for cells without ground.
Json TerrainSurface(const EntityConfiguration& configuration, const std::string& folder)
{
  const std::shared_ptr<const Terrain> terrain = LoadTerrain(configuration, folder);
  const Vector3 low = terrain->Low();
  const Vector3 high = terrain->High();
  const double cell = std::max({(high - low).x() / kTerrainSamples, (high - low).y() / kTerrainSamples, 1e-3});
  const int columns = std::max(2, static_cast<int>(std::floor((high - low).x() / cell)));
  const int rows = std::max(2, static_cast<int>(std::floor((high - low).y() / cell)));
  Json heights = Json::array();
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
    {
      const Vector3 above(low.x() + (column + 0.5) * (high - low).x() / columns,
                          low.y() + (row + 0.5) * (high - low).y() / rows, high.z() + 1e-6);
      const std::optional<double> ground = terrain->GroundBelow(above);
      heights.push_back(ground ? Json(std::round(*ground * 1e4) / 1e4) : Json(nullptr));
    }
  return {{"low", Vector(low)}, {"high", Vector(high)}, {"columns", columns}, {"rows", rows}, {"heights", heights}};
}

// Returns rows from the top, as runs of pixels: their number and their index in the palette.
Json Picture(const FloorPicture& picture)
{
  const PaintedFloor floor = Simplified(picture, kPicturePixels);
  Json runs = Json::array();
  for (std::size_t first = 0; first < floor.pixels.size();)
  {
    std::size_t end = first;
    while (end < floor.pixels.size() && floor.pixels[end] == floor.pixels[first]) ++end;
    runs.push_back(end - first);
    runs.push_back(floor.pixels[first]);
    first = end;
  }
  return {{"columns", floor.columns}, {"rows", floor.rows}, {"palette", floor.palette}, {"runs", runs}};
}

// The meshes of objects, each once.
struct ObjectMeshes
{
  Json models = Json::array();
  std::map<std::string, std::size_t> numbers{};
};

Json Body(const CSwarmanoidSpaceEntity& entity, const std::string& folder, ObjectMeshes& meshes)
{
  const EntityConfiguration& configuration = entity.GetConfiguration();
  const Pose pose = entity.GetPose();
  Json body{{"entity", entity.GetIndex()},
            {"size", Vector(entity.GetSize())},
            {"position", Vector(pose.position)},
            {"orientation", {pose.orientation.x(), pose.orientation.y(), pose.orientation.z(), pose.orientation.w()}},
            {"colour", configuration.colour}};
  const EntityRole role = DescriptionOf(entity.GetKind()).role;
  if (role == EntityRole::kTerrain) body["terrain"] = TerrainSurface(configuration, folder);
  if (role == EntityRole::kPatch)
    if (const auto picture = LoadFloorPicture(configuration, folder)) body["picture"] = Picture(*picture);
  if (const std::string name = ObjectModelName(configuration, folder); role == EntityRole::kObject && !name.empty())
  {
    const auto [number, is_new] = meshes.numbers.emplace(name, meshes.models.size());
    if (is_new) meshes.models.push_back(Json::parse(ModelAsJson(ObjectModel(configuration, folder))));
    body["mesh"] = number->second;
  }
  return body;
}

Json AttributeTable()
{
  Json table = Json::object();
  for (std::size_t kind = 0; kind < EntityKindCount(); ++kind)
  {
    Json specs = Json::array();
    for (const AttributeSpec& spec : AttributesOf(static_cast<EntityKind>(kind)))
      specs.push_back({{"name", spec.name}, {"count", spec.count}, {"description", spec.description}});
    table[std::string(TagName(static_cast<EntityKind>(kind)))] = specs;
  }
  return table;
}

bool IsThere(EntityKind kind, const Experiment& experiment)
{
  return std::ranges::find(experiment.entities, kind, &EntityConfiguration::kind) != experiment.entities.end();
}

// Returns what a page needs to draw a kind. For kinds in the experiment that the page's own meshes lack, this includes
// the model.
Json Look(EntityKind kind, const Experiment& experiment)
{
  const EntityKindDescription& row = DescriptionOf(kind);
  const bool is_box = row.form == BodyForm::kBox;
  constexpr const char* kRoles[] = {"robot", "object", "light", "sound", "patch", "hole", "terrain"};
  Json look{{"role", kRoles[static_cast<std::size_t>(row.role)]},
            {"form", row.form == BodyForm::kNone ? "none"
                     : is_box                    ? "box"
                                                 : "cylinder"},
            {"based", row.origin == BodyOrigin::kBase}};
  if (row.proximity)
  {
    Json sensors = Json::array();
    for (const auto& [place, direction] : row.proximity->sensors) sensors.push_back({place.x(), place.y(), direction});
    look["proximity"] = {{"height", row.proximity->height_m}, {"range", row.proximity->range_m}, {"sensors", sensors}};
  }
  if (IsBuiltIn(kind) || row.role != EntityRole::kRobot) return look;
  look["radius"] = is_box ? row.size.head<2>().norm() / 2 : row.size.x();
  look["height"] = row.size.z();
  look["colour"] = row.colour;
  // Links that move come with the drawing (DrawnLinks).
  if (IsThere(kind, experiment)) look["model"] = Json::parse(ModelAsJson(LinkModels(row, experiment).front()));
  return look;
}

// Returns {"left": [1.5, "m/s"], …} as columns.
Json Devices(const std::vector<DeviceStatus>& devices)
{
  Json list = Json::array();
  for (const DeviceStatus& device : devices)
  {
    Json names = Json::array(), units = Json::array(), values = Json::array();
    for (const CCI_Reading& reading : device.readings)
    {
      names.push_back(reading.name);
      units.push_back(reading.unit);
      values.push_back(reading.value);
    }
    list.push_back({{"type", device.type}, {"names", names}, {"units", units}, {"values", values}});
  }
  return list;
}

Json Inside(const RobotStatus& robot)
{
  return {{"tick", robot.tick},   {"controller", robot.controller},    {"text", robot.text},
          {"state", robot.state}, {"sensors", Devices(robot.sensors)}, {"actuators", Devices(robot.actuators)}};
}

Json Attributes(const CSwarmanoidSpaceEntity& entity)
{
  Json attributes = Json::object();
  for (const AttributeSpec& spec : AttributesOf(entity.GetKind()))
  {
    Json values = Json::array();
    for (int i = 0; i < spec.count; ++i) values.push_back(entity.GetAttribute(spec.name, i));
    attributes[std::string(spec.name)] = values;
  }
  return attributes;
}

Json ViewpointList(const Viewpoints& viewpoints)
{
  Json list = Json::array();
  for (int number = 0; number < Viewpoints::kCount; ++number)
    if (const std::optional<Camera>& camera = viewpoints.At(number))
      list.push_back({{"number", number},
                      {"position", Vector(camera->position)},
                      {"heading", camera->heading},
                      {"pitch", camera->pitch},
                      {"roll", camera->roll}});
  return list;
}

// The next functions read the requests of pages.

[[noreturn]] void Refuse(const std::string& text) { throw std::invalid_argument(text); }

double NumberIn(const Json& json, const char* name, double low, double high)
{
  const auto found = json.find(name);
  if (found == json.end() || !found->is_number()) Refuse(fmt::format("the request needs a number '{}'", name));
  const double value = found->get<double>();
  if (!(value >= low && value <= high)) Refuse(fmt::format("'{}' is {}; it must be {} to {}", name, value, low, high));
  return value;
}

std::vector<std::uint32_t> EntitiesIn(const Json& json, const char* name, std::size_t most)
{
  const auto found = json.find(name);
  if (found == json.end() || !found->is_array() || found->size() > most)
    Refuse(fmt::format("the request needs a list '{}' of at most {} entities", name, most));
  std::vector<std::uint32_t> entities;
  for (const Json& entity : *found)
  {
    if (!entity.is_number_unsigned() || entity.get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max())
      Refuse(fmt::format("'{}' names entities by their number", name));
    entities.push_back(entity.get<std::uint32_t>());
  }
  return entities;
}

PageRequest LookBackIn(const Json& json)
{
  LookBackRequest request{static_cast<std::uint64_t>(NumberIn(json, "tick", 0, kLastTick)),
                          EntitiesIn(json, "entities", kMostWatched)};
  if (json.contains("earlier") && json.at("earlier") == true) return EarlierRequest{std::move(request)};
  return request;
}

ProveRequest ProofIn(const Json& json)
{
  const auto proof = json.find("proof");
  if (proof == json.end() || !proof->is_string()) Refuse("'prove' needs a text 'proof'");
  return {proof->get<std::string>()};
}

bool IsNumbers(const Json& json)
{
  return json.is_array() && std::ranges::all_of(json, [](const Json& item) { return item.is_number(); });
}

// The members of a request that say a pose.
constexpr const char* kPosition = "position";
constexpr const char* kAngles = "angles";

std::optional<ControlValue> PoseIn(const Json& json)
{
  std::vector<double> pose;
  for (const char* name : {kPosition, kAngles})
  {
    const auto found = json.find(name);
    if (found == json.end()) continue;
    if (!IsNumbers(*found) || found->size() != 3) Refuse(fmt::format("the request needs three numbers '{}'", name));
    for (const Json& number : *found) pose.push_back(number.get<double>());
  }
  return pose.empty() ? std::nullopt : std::optional<ControlValue>(std::move(pose));
}

std::optional<ControlValue> ValueIn(const Json& json, const ControlParameter& parameter)
{
  if (parameter.type == ArgumentType::kPose) return PoseIn(json);
  const auto found = json.find(parameter.name);
  if (found == json.end()) return std::nullopt;
  if (found->is_string()) return found->get<std::string>();
  if (parameter.type == ArgumentType::kNumber && found->is_number()) return found->get<double>();
  if (found->is_number_unsigned() && found->get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max())
    Refuse(fmt::format("'{}' is out of all bounds", parameter.name));
  if (found->is_number_integer()) return found->get<std::int64_t>();
  Refuse(fmt::format("'{}' must be the {}", parameter.name, parameter.meaning));
}

// Reads {"do": VERB, PARAMETER: value, …}.
ControlOrder OrderIn(const Json& json, const std::string& name)
{
  const ControlVerb* const verb = FindControlVerb(name, Asker::kMember);
  if (verb == nullptr) Refuse(NoVerbText(name.substr(0, 40), Asker::kMember));
  ControlOrder order{name};
  std::size_t known = 1;  // "do"
  for (const ControlParameter& parameter : verb->parameters)
  {
    auto value = ValueIn(json, parameter);
    if (!value) continue;
    known += parameter.type == ArgumentType::kPose && json.contains(kAngles) ? 2 : 1;
    order.arguments.push_back({parameter.name, std::move(*value)});
  }
  if (known != json.size())
    Refuse(fmt::format("{}: a member of the request is unknown; write {}", name, FormOf(*verb)));
  if (const std::string error = OrderError(order, Asker::kMember); !error.empty()) Refuse(error);
  return order;
}

}  // namespace

std::string WelcomeText(bool control_possible, const std::string& challenge, bool edits)
{
  Json welcome{{"type", "welcome"}, {"protocol", 3}, {"control", control_possible ? "token needed" : "read-only"}};
  if (control_possible) welcome["challenge"] = challenge;
  if (edits) welcome["edits"] = true;
  return Text(welcome);
}

std::string AuthorityText(Authority authority)
{
  const char* control = authority == Authority::kControl      ? "granted"
                        : authority == Authority::kWrongToken ? "wrong token"
                                                              : "read-only";
  return Text({{"type", "authority"}, {"control", control}});
}

std::string WorldText(const CSwarmanoidSpace& space, const Assignment& assignment, const Viewpoints& viewpoints,
                      bool begins_there)
{
  const Experiment& experiment = space.GetExperiment();
  Json kinds = Json::array();
  Json looks = Json::object();
  for (std::size_t kind = 0; kind < EntityKindCount(); ++kind)
  {
    kinds.push_back(TagName(static_cast<EntityKind>(kind)));
    looks[std::string(TagName(static_cast<EntityKind>(kind)))] = Look(static_cast<EntityKind>(kind), experiment);
  }
  Json engines = Json::array();
  for (const EngineConfiguration& engine : experiment.engines)
    engines.push_back({{"id", engine.id}, {"tag", engine.tag}});
  Json controllers = Json::array();
  for (const ControllerConfiguration& controller : experiment.controllers)
    controllers.push_back({{"id", controller.id}, {"tag", controller.tag}});

  ObjectMeshes meshes;
  Json id = Json::array(), kind = Json::array(), movable = Json::array(), engine = Json::array(), host = Json::array(),
       controller = Json::array(), bodies = Json::array();
  for (std::size_t e = 0; e < space.Size(); ++e)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(e);
    id.push_back(entity.GetId());
    kind.push_back(static_cast<int>(entity.GetKind()));
    movable.push_back(entity.IsMovable() ? 1 : 0);
    engine.push_back(assignment.owner[e]);
    host.push_back(assignment.host[e]);
    int number = -1;
    for (std::size_t c = 0; c < experiment.controllers.size(); ++c)
      if (experiment.controllers[c].id == entity.GetConfiguration().controller) number = static_cast<int>(c);
    controller.push_back(number);
    if (!IsRobot(entity.GetKind())) bodies.push_back(Body(entity, experiment.folder, meshes));
  }
  Json reserves = Json::array();
  for (std::size_t e = 0; e < space.Size(); ++e)
  {
    const std::string& reserve = space.GetEntity(e).GetConfiguration().reserve;
    if (reserve.empty()) continue;
    if (reserves.empty() || reserves.back()["id"] != reserve)
      reserves.push_back({{"id", reserve}, {"first", e}, {"count", 0}});
    reserves.back()["count"] = reserves.back()["count"].get<std::size_t>() + 1;
  }
  return Text({{"type", "world"},
               {"experiment", experiment.name},
               {"seed", experiment.seed},
               {"tick_seconds", experiment.TickSeconds()},
               {"last_tick", experiment.max_clock},
               {"arena", Vector(experiment.arena_size)},
               {"kinds", kinds},
               {"looks", looks},
               {"engines", engines},
               {"hosts", assignment.hosts.size()},
               {"controllers", controllers},
               {"attributes", AttributeTable()},
               {"viewpoints", ViewpointList(viewpoints)},
               {"begins_at_viewpoint", begins_there},
               {"entities",
                {{"id", id},
                 {"kind", kind},
                 {"movable", movable},
                 {"engine", engine},
                 {"host", host},
                 {"controller", controller}}},
               {"reserves", reserves},
               {"bodies", bodies},
               {"meshes", meshes.models}});
}

std::string ColoursText(const CSwarmanoidSpace& space)
{
  Json entities = Json::array(), colours = Json::array(), intensities = Json::array();
  for (std::size_t e = 0; e < space.Size(); ++e)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(e);
    const bool in_frames = entity.IsMovable() && !IsBodiless(entity.GetKind());
    if (in_frames || AttributeOffset(entity.GetKind(), "colour") < 0) continue;
    entities.push_back(e);
    colours.push_back(static_cast<std::uint32_t>(entity.GetAttribute("colour")));
    intensities.push_back(AttributeOffset(entity.GetKind(), "intensity") < 0 ? 1.0 : entity.GetAttribute("intensity"));
  }
  return Text({{"type", "colours"}, {"entities", entities}, {"colours", colours}, {"intensities", intensities}});
}

std::string LogText(std::uint64_t tick, const std::string& source, const std::string& level, const std::string& text)
{
  return Text({{"type", "log"}, {"tick", tick}, {"source", source}, {"level", level}, {"text", text}});
}

std::string StatusText(const CSwarmanoidSpace& space, const RunStatus& status, std::size_t clients)
{
  Json processes = Json::array();
  for (const ProcessStatus& process : status.processes)
    processes.push_back({{"name", process.name},
                         {"process", process.process},
                         {"tick", process.tick},
                         {"late_s", process.late_s},
                         {"doing", process.doing}});
  return Text({{"type", "status"},
               {"tick", space.GetTick()},
               {"time_s", space.GetTime()},
               {"phase", PhaseName(status.phase)},
               {"speed_wanted", status.speed_wanted},
               {"real_time_factor", status.real_time_factor},
               {"ticks_per_second", status.ticks_per_second},
               {"ended", status.ended},
               {"clients", clients},
               {"processes", processes}});
}

std::string WatchedText(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities, RunMonitor* monitor)
{
  Json list = Json::array();
  for (const std::uint32_t e : entities)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(e);
    Json item{{"entity", e}, {"attributes", Attributes(entity)}};
    if (const RobotStatus* robot = monitor == nullptr ? nullptr : monitor->Robot(e)) item.update(Inside(*robot));
    list.push_back(item);
  }
  return Text({{"type", "watched"}, {"tick", space.GetTick()}, {"time_s", space.GetTime()}, {"entities", list}});
}

std::string TimelineText(const std::string& run_folder, std::uint64_t first, std::uint64_t end,
                         std::span<const TimelineEvent> events)
{
  Json list = Json::array();
  for (const TimelineEvent& event : events.first(std::min(events.size(), kMostEvents)))
    list.push_back({{"tick", event.tick}, {"what", event.what}, {"entity", event.entity}, {"from", event.from}});
  return Text({{"type", "timeline"},
               {"run", run_folder},
               {"first", first},
               {"last", end > first ? end - 1 : first},
               {"events", list},
               {"all_events", events.size()}});
}

std::string PastText(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities)
{
  Json past = Json::parse(WatchedText(space, entities, nullptr));
  past["type"] = "past";
  past["colours"] = Json::parse(ColoursText(space));
  return Text(past);
}

std::string RobotPlaybackText(const RobotPlaybackAnswer& answer)
{
  Json list = Json::array();
  for (const RobotStatus& robot : answer.robots)
  {
    Json item = Inside(robot);
    item["entity"] = robot.entity;
    item["attributes"] = Json::object();
    list.push_back(item);
  }
  return Text({{"type", "past_inside"}, {"tick", answer.tick}, {"entities", list}, {"error", answer.error}});
}

std::string BranchedText(const RunBranches::Answer& answer)
{
  return Text({{"type", "branched"}, {"tick", answer.tick}, {"url", answer.url}, {"error", answer.error}});
}

std::string RefusalText(const std::string& text) { return Text({{"type", "reply"}, {"ok", false}, {"text", text}}); }

PageRequest ParseRequest(std::string_view text)
{
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) Refuse("a request is a JSON object");
  const auto verb = json.find("do");
  if (verb == json.end() || !verb->is_string()) Refuse("a request needs a text 'do'");
  const std::string name = verb->get<std::string>();
  if (name == "watch") return WatchRequest{EntitiesIn(json, "entities", kMostWatched)};
  if (name == "look_back") return LookBackIn(json);
  if (name == "branch") return StartBranchRequest{static_cast<std::uint64_t>(NumberIn(json, "tick", 0, kLastTick))};
  if (name == "prove") return ProofIn(json);
  if (name == "marks")
    return MarksRequest{EntitiesIn(json, "rays", kMostMarked), EntitiesIn(json, "bodies", kMostMarked),
                        EntitiesIn(json, "links", kMostMarked)};
  if (name == "frame_period") return FrameRateRequest{static_cast<unsigned>(NumberIn(json, "ms", 0, 60000))};
  return OrderIn(json, name);
}

}  // namespace swarmanoid
