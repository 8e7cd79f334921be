#include "argos3/files/convert.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

#include "argos3/files/devices.h"
#include "argos3/files/nodes.h"
#include "common/configuration/wording.h"
#include "common/experiment/foreign_experiments.h"
#include "common/math/pose.h"
#include "common/plugins/library.h"

namespace swarmanoid
{
namespace argos3
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* kPlugin = "argos3";

class Converter
{
public:
  Converter(const ConfigurationNode& root, const std::string& folder) : root_(root), folder_(folder) {}

  ConvertedExperiment Convert()
  {
    auto ours = MakeNode("ahss-config", root_.location);
    arena_ = Needed(root_, "arena");
    if (arena_ == nullptr) return std::move(result_);
    const ConfigurationNode* floor = FindChild(*arena_, "floor");
    ReadFloor(floor);
    FindArena();
    FindBearers(*arena_);
    ConvertFramework(*ours);
    ConvertControllers(*ours);
    ConvertArena(*ours);
    ConvertEngines(*ours);
    ConvertLoopFunctions(*ours);
    for (const auto& child : root_.children)
      if (child->name == "visualization")
      {
        if (!child->children.empty())
          Note(child->location, "<visualization> has no effect here; `swarmanoid attach` shows a run");
      }
      else if (!kSections.contains(child->name))
        Mistake(child->location, "<" + child->name + "> has no counterpart; leave it out");
    result_.root = ours;
    return std::move(result_);
  }

private:
  inline static const std::set<std::string> kSections{"framework",       "controllers", "arena",
                                                      "physics_engines", "media",       "loop_functions"};

  void Mistake(const SourceLocation& at, const std::string& message) { result_.mistakes.push_back({at, message}); }
  void Note(const SourceLocation& at, const std::string& message) { result_.notes.push_back({at, message}); }

  const ConfigurationNode* Needed(const ConfigurationNode& node, const std::string& name)
  {
    const ConfigurationNode* child = FindChild(node, name);
    if (child == nullptr) Mistake(node.location, "<" + node.name + "> has no <" + name + ">; add it");
    return child;
  }

  // Attributes. What is not there or of another form is told, if it is needed.
  std::optional<std::string> Text(const ConfigurationNode& node, const std::string& name)
  {
    const ConfigurationNode::Attribute* attribute = FindAttributeOf(node, name);
    return attribute == nullptr ? std::nullopt : std::optional(attribute->value);
  }
  std::string NeededText(const ConfigurationNode& node, const std::string& name)
  {
    const auto text = Text(node, name);
    if (!text) Mistake(node.location, "<" + node.name + "> has no '" + name + "'; add it");
    return text.value_or("");
  }
  template <class Value>
  Value Parsed(const ConfigurationNode& node, const std::string& name, const Value& fallback,
               std::optional<Value> (*parse)(std::string_view), const char* form)
  {
    const ConfigurationNode::Attribute* attribute = FindAttributeOf(node, name);
    if (attribute == nullptr) return fallback;
    if (const std::optional<Value> value = parse(attribute->value)) return *value;
    Mistake(attribute->location, "'" + name + "' of <" + node.name + "> is '" + attribute->value + "'; write " + form);
    return fallback;
  }
  double Number(const ConfigurationNode& node, const std::string& name, double fallback)
  {
    return Parsed<double>(node, name, fallback, ParseNumber, "a number");
  }
  long long Whole(const ConfigurationNode& node, const std::string& name, long long fallback)
  {
    return Parsed<long long>(node, name, fallback, ParseInteger, "a whole number");
  }
  bool Flag(const ConfigurationNode& node, const std::string& name, bool fallback)
  {
    return Parsed<bool>(node, name, fallback, ParseBoolean, "true or false");
  }
  static std::optional<Vector3> ParseVector(std::string_view text)
  {
    const auto numbers = ParseNumbers(text);
    if (!numbers || numbers->size() != 3) return std::nullopt;
    return Vector3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
  }
  Vector3 Vector(const ConfigurationNode& node, const std::string& name, const Vector3& fallback = Vector3::Zero())
  {
    return Parsed<Vector3>(node, name, fallback, ParseVector, "three numbers with commas between them");
  }
  Vector3 NeededVector(const ConfigurationNode& node, const std::string& name)
  {
    NeededText(node, name);
    return Vector(node, name);
  }
  // Attributes that are no parameters here are told.
  void NoteOthers(const ConfigurationNode& node, const std::set<std::string>& known)
  {
    for (const ConfigurationNode::Attribute& attribute : node.attributes)
      if (!known.contains(attribute.name))
        Note(attribute.location, "'" + attribute.name + "' of <" + node.name + "> has no effect here");
  }

  // --- What stands in the arena ---

  void ReadFloor(const ConfigurationNode* floor)
  {
    if (floor == nullptr) return;
    const std::string source = NeededText(*floor, "source");
    if (source == "loop_functions")
      floor_id_ = NeededText(*floor, "id");
    else if (source != "image")
      Mistake(floor->location,
              "a floor of source " + Quoted(source) + " has no counterpart; take an image, or loop_functions");
  }

  // Found as libraries are: from the working folder, or from that of the file.
  std::string PictureOf(const ConfigurationNode& floor)
  {
    const std::string path = NeededText(floor, "path");
    const fs::path here = fs::current_path() / path;
    std::error_code none;
    return fs::is_regular_file(here, none) ? here.lexically_normal().string() : path;
  }

  // Over all of their arena.
  void ConvertFloor(const ConfigurationNode& theirs, ConfigurationNode& parent)
  {
    if (Text(theirs, "source").value_or("") != "image") return;
    const SourceLocation& at = theirs.location;
    const Vector3 size = NeededVector(*arena_, "size");
    Vector3 middle = Vector(*arena_, "center") + origin_;
    middle.z() = 0;
    const Made made = AddNode(parent, "ground_patch", at);
    SetValue(*made, "id", NeededText(theirs, "id"), at);
    SetValue(*made, "picture", PictureOf(theirs), at);
    SetValue(*made, "size", fmt::format("{:.17g}, {:.17g}", size.x(), size.y()), at);
    SetValue(*made, "position", TextOf(middle), at);
    NoteOthers(theirs, {"id", "source", "path"});
  }

  // Ours starts at 0, 0, 0 and holds all that the file places; its floor is where theirs is, at height 0.
  void FindArena()
  {
    const Vector3 size = NeededVector(*arena_, "size");
    const Vector3 center = Vector(*arena_, "center");
    low_ = center - size / 2;
    high_ = center + size / 2;
    low_.z() = 0;
    for (const auto& child : arena_->children)
    {
      const ConfigurationNode* body = FindChild(*child, "body");
      const ConfigurationNode& placed = body != nullptr ? *body : *child;
      if (FindAttributeOf(placed, "position") == nullptr) continue;
      const Vector3 at = Vector(placed, "position");
      low_ = low_.cwiseMin(at);
      high_ = high_.cwiseMax(at);
      if (child->name == "box") high_.z() = std::max(high_.z(), at.z() + Vector(*child, "size").z());
    }
    origin_ = -low_;
  }

  void FindBearers(const ConfigurationNode& within)
  {
    for (const auto& child : within.children)
    {
      if (child->name == "distribute" || child->name == "entity") FindBearers(*child);
      const std::string kind = KindOf(child->name);
      const ConfigurationNode* controller = FindChild(*child, "controller");
      if (kind.empty() || controller == nullptr) continue;
      Bearers& bearers = bearers_[NeededText(*controller, "config")];
      bearers.kinds.insert(kind);
      if (kind == "footbot") bearers.camera_aperture = Number(*child, "omnidirectional_camera_aperture", 70);
      bearers.radio_range = Number(*child, "rab_range", 3);
      bearers.radio_bytes = Whole(*child, "rab_data_size", 10);
      if (bearers.radio_bytes < 1 || bearers.radio_bytes > 10)
        Mistake(child->location, "'rab_data_size' is " + std::to_string(bearers.radio_bytes) +
                                     "; range-and-bearing messages have 1 to 10 bytes here");
    }
  }

  static std::string KindOf(const std::string& tag)
  {
    return tag == "foot-bot" ? "footbot" : tag == "eye-bot" ? "eyebot" : "";
  }

  void ConvertArena(ConfigurationNode& ours)
  {
    const SourceLocation& at = arena_->location;
    const Made made = AddNode(ours, "arena", at);
    SetValue(*made, "size", TextOf(Vector3(high_ - low_)), at);
    NoteOthers(*arena_, {"size", "center", "positional_index", "positional_grid_size"});
    for (const auto& child : arena_->children)
      if (child->name == "distribute")
        ConvertDistribute(*child, *made);
      else if (child->name == "floor")
        ConvertFloor(*child, *made);
      else
        ConvertEntity(*child, *made, true);
    SetValue(*made, "optimization", kinds_.contains("eyebot") ? "3D" : "2D", at);
  }

  // `placed`: with a place of its own; otherwise <distribute> gives it one.
  void ConvertEntity(const ConfigurationNode& theirs, ConfigurationNode& parent, bool placed)
  {
    const SourceLocation& at = theirs.location;
    const std::string id = NeededText(theirs, "id");
    const std::string robot = KindOf(theirs.name);
    Made made;
    double lift = 0;
    if (!robot.empty())
    {
      made = AddNode(parent, robot, at);
      if (const ConfigurationNode* controller = FindChild(theirs, "controller"))
        SetValue(*made, "controller", NeededText(*controller, "config"), controller->location);
      NoteOthers(theirs, {"id", "omnidirectional_camera_aperture", "rab_range", "rab_data_size"});
    }
    else if (theirs.name == "box")
    {
      made = AddNode(parent, "block", at);
      const Vector3 size = NeededVector(theirs, "size");
      lift = size.z() / 2;
      SetValue(*made, "size", TextOf(size), at);
      SetMovable(theirs, *made);
      NoteOthers(theirs, {"id", "size", "movable", "mass"});
    }
    else if (theirs.name == "cylinder")
    {
      made = AddNode(parent, "cylindric_prey", at);
      SetValue(*made, "radius", NeededText(theirs, "radius"), at);
      SetValue(*made, "height", NeededText(theirs, "height"), at);
      // Cameras of ARGoS3 see LEDs and lights, not bodies.
      SetValue(*made, "colour", "black", at);
      SetMovable(theirs, *made);
      NoteOthers(theirs, {"id", "radius", "height", "movable", "mass"});
    }
    else if (theirs.name == "light")
    {
      made = AddNode(parent, "light_bulb", at);
      SetValue(*made, "intensity", Text(theirs, "intensity").value_or("1"), at);
      SetValue(*made, "colour", Text(theirs, "color").value_or("yellow"), at);
      NoteOthers(theirs, {"id", "position", "orientation", "color", "intensity", "medium"});
    }
    else
    {
      Mistake(at,
              "<" + theirs.name +
                  "> has no counterpart; those that have: foot-bot, eye-bot, box, cylinder, light, floor, distribute");
      return;
    }
    kinds_.insert(made->name);
    SetValue(*made, "id", id, at);
    if (FindChild(theirs, "leds") != nullptr)
      Mistake(FindChild(theirs, "leds")->location, "LEDs on <" + theirs.name + "> have no counterpart; leave them out");
    if (placed) SetPlace(theirs, *made, lift);
  }

  void SetMovable(const ConfigurationNode& theirs, ConfigurationNode& made)
  {
    NeededText(theirs, "movable");
    const bool movable = Flag(theirs, "movable", false);
    SetValue(made, "movable", movable ? "true" : "false", theirs.location);
    if (movable) SetValue(made, "mass", TextOf(Number(theirs, "mass", 1)), theirs.location);
  }

  void SetPlace(const ConfigurationNode& theirs, ConfigurationNode& made, double lift)
  {
    const bool is_light = theirs.name == "light";
    const ConfigurationNode* body = is_light ? &theirs : Needed(theirs, "body");
    if (body == nullptr) return;
    const Vector3 zyx = Vector(*body, "orientation");
    const Quaternion orientation = Quaternion(Eigen::AngleAxisd(zyx.z() * kRadians, Vector3::UnitX())) *
                                   Eigen::AngleAxisd(zyx.y() * kRadians, Vector3::UnitY()) *
                                   Eigen::AngleAxisd(zyx.x() * kRadians, Vector3::UnitZ());
    const Vector3 position = NeededVector(*body, "position") + origin_ + orientation * Vector3(0, 0, lift);
    SetValue(made, "position", TextOf(position), body->location);
    // The same three angles about fixed axes; a heading stays as it was written.
    const EulerAngles fixed = EulerFromQuaternion(orientation);
    const Vector3 xyz = zyx.y() == 0 && zyx.z() == 0
                            ? Vector3(0, 0, zyx.x())
                            : Vector3(Vector3(fixed.alpha, fixed.beta, fixed.gamma) / kRadians);
    if (!is_light) SetValue(made, "orientation", TextOf(xyz), body->location);
  }

  void ConvertDistribute(const ConfigurationNode& theirs, ConfigurationNode& parent)
  {
    const SourceLocation& at = theirs.location;
    const ConfigurationNode* position = Needed(theirs, "position");
    const ConfigurationNode* orientation = Needed(theirs, "orientation");
    const ConfigurationNode* entity = Needed(theirs, "entity");
    if (position == nullptr || orientation == nullptr || entity == nullptr) return;
    const Made made = AddNode(parent, "distribute", at);
    SetValue(*made, "quantity", NeededText(*entity, "quantity"), entity->location);
    SetValue(*made, "max_trials", NeededText(*entity, "max_trials"), entity->location);
    ConvertPositions(*position, *AddNode(*made, "position", position->location));
    ConvertOrientations(*orientation, *AddNode(*made, "orientation", orientation->location));
    if (entity->children.size() != 1)
      return Mistake(entity->location, "<entity> holds one element: what is distributed");
    const ConfigurationNode& what = *entity->children.front();
    if (const auto id = Text(what, "id"))
      distributed_ += (distributed_.empty() ? "" : " ") + *id + ":" + std::to_string(Whole(*entity, "base_num", 0));
    ConvertEntity(what, *made, false);
  }

  void ConvertPositions(const ConfigurationNode& theirs, ConfigurationNode& made)
  {
    const std::string method = NeededText(theirs, "method");
    const auto shifted = [&](const char* from, const char* to)
    { SetValue(made, to, TextOf(Vector3(NeededVector(theirs, from) + origin_)), theirs.location); };
    const auto same = [&](const char* from, const char* to)
    { SetValue(made, to, TextOf(NeededVector(theirs, from)), theirs.location); };
    SetValue(made, "method", method == "constant" ? "uniform" : method, theirs.location);
    if (method == "uniform")
    {
      shifted("min", "min");
      shifted("max", "max");
    }
    else if (method == "gaussian")
    {
      shifted("mean", "mean");
      same("std_dev", "deviation");
    }
    else if (method == "constant")
    {
      shifted("values", "min");
      shifted("values", "max");
    }
    else if (method == "grid")
    {
      shifted("center", "centre");
      same("distances", "spacing");
      same("layout", "layout");
    }
    else
      Mistake(theirs.location, Quoted(method) + " is no method; uniform, gaussian, constant and grid are");
  }

  // Theirs are z, y, x, and only rotations about z are the same in both orders.
  void ConvertOrientations(const ConfigurationNode& theirs, ConfigurationNode& made)
  {
    const std::string method = NeededText(theirs, "method");
    const auto turned = [&](const char* from, const char* to)
    {
      const Vector3 zyx = NeededVector(theirs, from);
      if (zyx.y() != 0 || zyx.z() != 0)
        Mistake(theirs.location, std::string("'") + from + "' tilts what it distributes, which has no counterpart; " +
                                     "leave y and x at 0");
      SetValue(made, to, TextOf(Vector3(0, 0, zyx.x())), theirs.location);
    };
    SetValue(made, "method", method, theirs.location);
    if (method == "uniform")
    {
      turned("min", "min");
      turned("max", "max");
    }
    else if (method == "gaussian")
    {
      turned("mean", "mean");
      turned("std_dev", "deviation");
    }
    else if (method == "constant")
      turned("values", "value");
    else
      Mistake(theirs.location, Quoted(method) + " is no method; uniform, gaussian and constant are");
  }

  // --- The rest ---

  void ConvertFramework(ConfigurationNode& ours)
  {
    const ConfigurationNode* framework = Needed(root_, "framework");
    const ConfigurationNode* experiment = framework == nullptr ? nullptr : Needed(*framework, "experiment");
    if (experiment == nullptr) return;
    const SourceLocation& at = experiment->location;
    const Made made = AddNode(ours, "framework", at);
    NeededText(*experiment, "ticks_per_second");
    const long long ticks = Whole(*experiment, "ticks_per_second", 10);
    if (ticks < 1 || ticks > 1000 || 1000 % ticks != 0)
      Mistake(at,
              "'ticks_per_second' is " + std::to_string(ticks) +
                  "; a tick has whole milliseconds here: 1, 2, 4, 5, 8, 10, 20, 25, 40, 50, 100, 125, 200, 250, 500 "
                  "or 1000 are possible");
    else
      SetValue(*made, "clocktick", std::to_string(1000 / ticks), at);
    const double length = Number(*experiment, "length", 0);
    // The tick before the first step of controllers is theirs, too.
    if (length > 0)
      SetValue(*made, "maxclock", std::to_string(static_cast<long long>(length * static_cast<double>(ticks)) + 1), at);
    const long long seed = Whole(*experiment, "random_seed", 0);
    if (seed == 0) Note(at, "without a random_seed ARGoS3 takes the time; here it is 1, and --seed gives another one");
    SetValue(*made, "seed", std::to_string(seed == 0 ? 1 : seed), at);
    NoteOthers(*experiment, {"length", "ticks_per_second", "random_seed", "real_time"});
    if (const ConfigurationNode* profiling = FindChild(*framework, "profiling"))
      Note(profiling->location, "<profiling> has no effect here");
  }

  void ConvertControllers(ConfigurationNode& ours)
  {
    const ConfigurationNode* controllers = Needed(root_, "controllers");
    if (controllers == nullptr) return;
    const Made made = AddNode(ours, "controllers", controllers->location);
    const bool somebody_hears = [&]
    {
      for (const auto& controller : controllers->children)
        if (const ConfigurationNode* sensors = FindChild(*controller, "sensors"))
          if (FindChild(*sensors, "range_and_bearing") != nullptr) return true;
      return false;
    }();
    for (const auto& controller : controllers->children) ConvertController(*controller, *made, somebody_hears);
  }

  void ConvertController(const ConfigurationNode& theirs, ConfigurationNode& parent, bool somebody_hears)
  {
    const SourceLocation& at = theirs.location;
    const Made made = AddNode(parent, "argos3_controller", at);
    const std::string id = NeededText(theirs, "id");
    SetValue(*made, "id", id, at);
    SetValue(*made, "library", kPlugin, at);
    const Bearers& bearers = bearers_[id];
    const DeviceContext context{bearers, !floor_id_.empty(),
                                [this](const SourceLocation& place, const std::string& text) { Mistake(place, text); },
                                [this](const SourceLocation& place, const std::string& text) { Note(place, text); }};
    DeviceLists lists;
    const std::string sensors = ConvertDevices(theirs, "sensors", ConvertSensor, context, lists);
    std::string actuators = ConvertDevices(theirs, "actuators", ConvertActuator, context, lists);
    if (somebody_hears && !bearers.kinds.empty() && !lists.actuators.contains("range_and_bearing"))
    {
      AddSender(at, lists);
      actuators += " range_and_bearing";
    }
    for (const auto& [name, devices] : {std::pair("actuators", &lists.actuators), std::pair("sensors", &lists.sensors)})
    {
      const Made list = AddNode(*made, name, at);
      for (const auto& [type, device] : *devices) list->children.push_back(device);
    }
    const Made parameters = AddNode(*made, "parameters", at);
    const Made options = AddNode(*parameters, "argos3", at);
    if (theirs.name == "lua_controller")
    {
      SetScript(theirs, *options);
    }
    else
    {
      SetValue(*options, "label", theirs.name, at);
      SetLibrary(theirs, "library", *options);
    }
    SetValue(*options, "sensors", sensors, at);
    SetValue(*options, "actuators", actuators, at);
    if (!floor_id_.empty()) SetValue(*options, "floor", "loop_functions", at);
    if (const double noise = GroundNoise(theirs); noise > 0) SetValue(*options, "ground_noise", TextOf(noise), at);
    SetValue(*options, "rab_data_size", std::to_string(bearers.radio_bytes), at);
    options_.push_back(options);
    for (const auto& child : theirs.children)
      if (child->name == "params") parameters->children.push_back(child);
  }

  static double GroundNoise(const ConfigurationNode& controller)
  {
    const ConfigurationNode* sensors = FindChild(controller, "sensors");
    for (const char* name : {"footbot_motor_ground", "footbot_base_ground"})
    {
      const ConfigurationNode* ground = sensors == nullptr ? nullptr : FindChild(*sensors, name);
      const auto* level = ground == nullptr ? nullptr : FindAttributeOf(*ground, "noise_level");
      if (level != nullptr) return ParseNumber(level->value).value_or(0);
    }
    return 0;
  }

  // The tags of theirs, with blanks between them.
  template <class ConvertOne>
  std::string ConvertDevices(const ConfigurationNode& controller, const char* name, ConvertOne convert,
                             const DeviceContext& context, DeviceLists& lists)
  {
    const ConfigurationNode* theirs = FindChild(controller, name);
    std::string tags;
    if (theirs == nullptr) return tags;
    for (const auto& device : theirs->children)
    {
      convert(*device, context, lists);
      tags += (tags.empty() ? "" : " ") + device->name;
    }
    return tags;
  }

  void SetScript(const ConfigurationNode& theirs, ConfigurationNode& options)
  {
    const ConfigurationNode* params = FindChild(theirs, "params");
    const auto* script = params == nullptr ? nullptr : FindAttributeOf(*params, "script");
    if (script == nullptr) return Mistake(theirs.location, "a <lua_controller> needs <params script=\"FILE.lua\"/>");
    std::string searched;
    const auto file = Found({fs::current_path(), folder_, fs::path(folder_).parent_path()}, {script->value}, searched);
    if (!file)
      return Mistake(script->location, "the script " + Quoted(script->value) +
                                           " is not found; start in the folder from which the path leads to it; " +
                                           "searched:" + searched);
    SetValue(options, "script", *file, script->location);
    SetValue(options, "script_name", script->value, script->location);
  }

  void SetLibrary(const ConfigurationNode& theirs, const char* ours, ConfigurationNode& options)
  {
    const std::string library = NeededText(theirs, "library");
    if (library.empty()) return;
    const SourceLocation& at = FindAttributeOf(theirs, "library")->location;
    std::vector<fs::path> folders{fs::current_path()};
    if (const char* list = std::getenv("ARGOS_PLUGIN_PATH"))
      for (const std::string& one : SplitSearchPath(list, fs::current_path().string())) folders.emplace_back(one);
    folders.emplace_back(folder_);
    folders.push_back(fs::path(folder_).parent_path());
    std::string searched;
    if (const auto file = Found(folders, {library, library + ".so", "lib" + library + ".so"}, searched))
      return SetValue(options, ours, *file, at);
    Mistake(at,
            "the library " + Quoted(library) +
                " is not found; build it, name its folder in ARGOS_PLUGIN_PATH, or start in the folder from which " +
                "the path leads to it; searched:" + searched);
  }

  // The first file of one of the names in one of the folders; otherwise where it is not, a line each.
  static std::optional<std::string> Found(const std::vector<fs::path>& folders, const std::vector<std::string>& names,
                                          std::string& searched)
  {
    for (const fs::path& folder : folders)
      for (const std::string& name : names)
      {
        const fs::path file = (folder / name).lexically_normal();
        std::error_code none;
        if (fs::is_regular_file(file, none)) return file.string();
        searched += "\n    " + file.string();
      }
    return std::nullopt;
  }

  void ConvertEngines(ConfigurationNode& ours)
  {
    const ConfigurationNode* engines = Needed(root_, "physics_engines");
    if (engines == nullptr) return;
    const Made list = AddNode(ours, "engines", engines->location);
    const Made physics = AddNode(ours, "arena_physics", engines->location);
    std::map<std::string, std::string> made;  // ours to their ids
    for (const auto& theirs : engines->children)
    {
      const SourceLocation& at = theirs->location;
      const bool flat = theirs->name == "dynamics2d";
      if (!flat && theirs->name != "pointmass3d" && theirs->name != "dynamics3d")
      {
        Mistake(at,
                "the engine <" + theirs->name + "> has no counterpart; dynamics2d, pointmass3d and dynamics3d have");
        continue;
      }
      const std::string tag = flat ? "dynamics2d" : "dynamics3d";
      const std::string id = NeededText(*theirs, "id");
      if (!made.emplace(tag, id).second)
      {
        Note(at, "<" + theirs->name + "> of id '" + id + "' and the one before are one engine here");
        continue;
      }
      const Made engine = AddNode(*list, tag, at);
      SetValue(*engine, "id", id, at);
      if (flat) SetValue(*engine, "distance", TextOf(Number(*theirs, "elevation", 0) + origin_.z()), at);
      NoteOthers(*theirs, {"id", "elevation", "iterations"});
      if (FindChild(*theirs, "boundaries") != nullptr)
        Note(FindChild(*theirs, "boundaries")->location, "<boundaries> have no effect here: one engine has all");
      if (theirs->name == "pointmass3d") Note(at, "<pointmass3d> is dynamics3d here: bodies that meet collide");
    }
    for (const auto& [tag, id] : made)
    {
      const Made binding = AddNode(*physics, "engine", engines->location);
      SetValue(*binding, "id", id, engines->location);
      for (const std::string& kind : kinds_)
      {
        if (kind == "light_bulb") continue;
        // Where there are both, eye-bots fly and foot-bots drive; what stands in the way stands in both.
        if (made.size() > 1 && kind == (tag == "dynamics2d" ? "eyebot" : "footbot")) continue;
        SetValue(*AddNode(*binding, "all", engines->location), "kind", kind, engines->location);
      }
    }
  }

  void ConvertLoopFunctions(ConfigurationNode& ours)
  {
    for (const Made& options : options_)
    {
      SetValue(*options, "origin", TextOf(origin_), options->location);
      SetValue(*options, "distributed", distributed_, options->location);
    }
    const ConfigurationNode* theirs = FindChild(root_, "loop_functions");
    if (theirs == nullptr)
    {
      if (!floor_id_.empty())
        Mistake(arena_->location, "the source of the floor is loop_functions, and there are none; add them");
      return;
    }
    const SourceLocation& at = theirs->location;
    const Made list = AddNode(ours, "experiment_functions", at);
    const Made made = AddNode(*list, "argos3_loop_functions", at);
    SetValue(*made, "id", "loop_functions", at);
    SetValue(*made, "library", kPlugin, at);
    SetLibrary(*theirs, "file", *made);
    SetValue(*made, "label", NeededText(*theirs, "label"), at);
    SetValue(*made, "origin", TextOf(origin_), at);
    SetValue(*made, "distributed", distributed_, at);
    SetValue(*made, "floor", floor_id_, at);
    made->children.push_back(std::make_shared<ConfigurationNode>(*theirs));
  }

  const ConfigurationNode& root_;
  const std::string folder_;
  ConvertedExperiment result_;
  const ConfigurationNode* arena_ = nullptr;
  std::string floor_id_;  // of a floor that loop functions paint
  Vector3 low_ = Vector3::Zero();
  Vector3 high_ = Vector3::Zero();
  Vector3 origin_ = Vector3::Zero();
  std::map<std::string, Bearers> bearers_;  // by controller
  std::set<std::string> kinds_;
  std::string distributed_;
  std::vector<Made> options_;  // of the controllers
};

}  // namespace
}  // namespace argos3

ConvertedExperiment ConvertArgos3(const ConfigurationNode& root, const std::string& folder)
{
  return argos3::Converter(root, folder).Convert();
}

void ReadArgos3Experiments()
{
  AddExperimentConverter("argos-configuration",
                         [](const ConfigurationNode& root, const std::string& folder, std::vector<Diagnostic>& mistakes)
                         {
                           ConvertedExperiment converted = ConvertArgos3(root, folder);
                           for (const Diagnostic& note : converted.notes)
                             fmt::print(stderr, "{}: note: {}\n", note.location.Text(), note.message);
                           mistakes = std::move(converted.mistakes);
                           return std::shared_ptr<const ConfigurationNode>(std::move(converted.root));
                         });
}

}  // namespace swarmanoid
