// The controllers and loop functions of an experiment lie in libraries that the user compiled for ARGoS3. Nothing may
// be loaded while a file is only converted, so everything that depends on the code is judged from the file's bytes: a
// class that is registered under a label has this label as a text constant in its library, and a library that creates
// entities names their constructors among its undefined symbols. A hit that is wrong costs a reserve that is not used;
// it changes no result.
#include "argos3/converter/convert_code.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "argos3/converter/our_ids.h"
#include "argos3/converter/robot_rows.h"
#include "common/configuration/wording.h"
#include "common/plugins/plugin_library.h"

namespace swarmanoid::argos3
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* kPlugin = "argos3";

// Constructors and functions beside the constructors of robots.
constexpr std::pair<const char*, const char*> kFunctions[]{{"light_bulb", "12CLightEntityC"},
                                                           {"box", "10CBoxEntityC"},
                                                           {"cylinder", "15CCylinderEntityC"},
                                                           {"reset", "10CSimulator5ResetE"},
                                                           {"reset", "6CSpace5ResetE"},
                                                           {"configuration", "20GetConfigurationRootE"},
                                                           {"configuration", "22GetConfigForControllerE"}};

// Returns the kind for a controller that no robot of the file has, judged by its devices.
std::string KindByDevices(const ConfigurationNode& controller)
{
  for (const char* list : {"sensors", "actuators"})
  {
    const ConfigurationNode* devices = FindChild(controller, list);
    if (devices == nullptr) continue;
    for (const auto& device : devices->children)
    {
      if (device->name.starts_with("eyebot") || device->name.starts_with("quadrotor")) return "eyebot";
      if (device->name.starts_with("footbot")) return "footbot";
      if (const RobotRow* owner = OwnerOfDevice(device->name)) return std::string(owner->kind);
      if (device->name.starts_with("epuck")) return "argos3_epuck";
    }
  }
  return "";
}

// The controller of Kilobots that this library has.
constexpr const char* kKilobotController = "kilobot_controller";

constexpr int kSpareRobots = 100;  // for each controller
constexpr int kSpareLights = 20;

std::string BytesOf(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

bool& UserFunctionsMayBeMissing()
{
  static bool may_be = false;
  return may_be;
}

std::vector<std::string> LibraryNames(const std::string& library)
{
  const fs::path path(library);
  return {library, library + ".so", (path.parent_path() / ("lib" + path.filename().string() + ".so")).string()};
}

}  // namespace

void CodeConverter::ConvertControllers(ConfigurationNode& ours)
{
  const ConfigurationNode* controllers = Needed(root_, "controllers");
  if (controllers == nullptr) return;
  const Made made = AddNode(ours, "controllers", controllers->location);
  FindRadioChannels(*controllers);
  made_kinds_ = FindMadeKinds();
  if (made_kinds_.erase("light_bulb") != 0) arena_.KeepSpareLights(kSpareLights);
  asks_for_configuration_ = made_kinds_.erase("configuration") != 0;
  resets_runs_ = made_kinds_.erase("reset") != 0;
  makes_bodies_ = made_kinds_.erase("box") + made_kinds_.erase("cylinder") != 0;
  for (const auto& controller : controllers->children)
  {
    const std::string id = OurCharacters(NeededText(*controller, "id"));
    if (controller->name == "buzz_controller")
    {
      Mistake(controller->location,
              "<buzz_controller> runs Buzz, which has no counterpart here; write the rule in Lua or C++");
      continue;
    }
    if (arena_.IsOfUnknownRobots(id)) continue;
    KeepSpare(id, *controller);
    NoteOthers(*controller, controller->name == "lua_controller" ? std::set<std::string>{"id"}
                                                                 : std::set<std::string>{"id", "library"});
    NoteOtherChildren(*controller, {"actuators", "sensors", "params"});
    for (const ArenaConverter::Variant& variant : arena_.VariantsOf(id))
      ConvertController(*controller, id, variant, *made);
  }
}

void CodeConverter::NoteListsOf(const ConfigurationNode& controller)
{
  for (const char* list : {"sensors", "actuators"})
    if (const ConfigurationNode* devices = FindChild(controller, list)) NoteOthers(*devices, {});
}

std::optional<std::string> CodeConverter::RadioMediumOf(const ConfigurationNode& controller)
{
  const ConfigurationNode* sensors = FindChild(controller, "sensors");
  const ConfigurationNode* radio = sensors == nullptr ? nullptr : FindChild(*sensors, "range_and_bearing");
  for (const char* own : {"kilobot_communication", "epuck_range_and_bearing"})
    if (sensors != nullptr && radio == nullptr) radio = FindChild(*sensors, own);
  if (radio == nullptr) return std::nullopt;
  const auto* medium = FindAttributeOf(*radio, "medium");
  return medium == nullptr ? "" : medium->value;
}

void CodeConverter::FindRadioChannels(const ConfigurationNode& controllers)
{
  for (const auto& controller : controllers.children)
  {
    const auto* id = FindAttributeOf(*controller, "id");
    const auto medium = RadioMediumOf(*controller);
    if (id == nullptr || !medium) continue;
    for (const ArenaConverter::Variant& variant : arena_.VariantsOf(OurCharacters(id->value)))
      radio_channels_.insert({*medium, variant.bearers.radio_bytes});
  }
  constexpr std::size_t kMost = 256;
  if (radio_channels_.size() > kMost)
    Mistake(controllers.location,
            fmt::format("robots have {} different media and sizes of messages; {} are possible here",
                        radio_channels_.size(), kMost));
}

void CodeConverter::SetKilobotMedium(const std::string& medium, ConfigurationNode& options)
{
  const ConfigurationNode* media = FindChild(root_, "media");
  if (media == nullptr) return;
  for (const auto& one : media->children)
  {
    const auto* id = FindAttributeOf(*one, "id");
    if (one->name != "kilobot_communication" || id == nullptr || id->value != medium) continue;
    if (const double drops = Number(*one, "message_drop_prob", 0); drops > 0)
      SetValue(options, "message_drop_prob", TextOf(drops), one->location);
    if (Flag(*one, "ignore_conflicts", false)) SetValue(options, "ignore_conflicts", "true", one->location);
  }
}

void CodeConverter::FindBehavior(const ConfigurationNode& theirs, ConfigurationNode& params)
{
  for (ConfigurationNode::Attribute& attribute : params.attributes)
  {
    if (attribute.name != "behavior") continue;
    std::string searched;
    if (const auto file = Found(Folders(), {attribute.value}, searched))
      attribute.value = *file;
    else if (theirs.name == kKilobotController)
      Mistake(attribute.location, "the behaviour " + Quoted(attribute.value) +
                                      " is not found; build it, or start in the folder from which the path leads to " +
                                      "it; searched:" + searched);
  }
}

bool CodeConverter::ChecksOcclusions(const std::string& medium) const
{
  const ConfigurationNode* media = FindChild(root_, "media");
  if (media == nullptr) return true;
  for (const auto& one : media->children)
  {
    const auto* id = FindAttributeOf(*one, "id");
    if (one->name != "range_and_bearing" || id == nullptr || id->value != medium) continue;
    const auto* checks = FindAttributeOf(*one, "check_occlusions");
    return checks == nullptr || checks->value != "false";
  }
  return true;
}

std::set<std::string> CodeConverter::FindMadeKinds() const
{
  const ConfigurationNode* functions = FindChild(root_, "loop_functions");
  std::set<std::string> kinds;
  if (functions == nullptr) return kinds;
  const auto* library = FindAttributeOf(*functions, "library");
  const auto* label = FindAttributeOf(*functions, "label");
  std::string searched;
  const auto file = library != nullptr ? Found(Folders(), LibraryNames(library->value), searched)
                    : label != nullptr ? LibraryThatNames(label->value, searched)
                                       : std::nullopt;
  if (!file) return kinds;
  const std::string bytes = BytesOf(*file);
  for (const RobotRow& robot : RobotRows())
    if (!robot.constructor.empty() && bytes.find(robot.constructor) != std::string::npos) kinds.emplace(robot.kind);
  for (const auto& [kind, name] : kFunctions)
    if (bytes.find(name) != std::string::npos) kinds.insert(kind);
  return kinds;
}

void CodeConverter::KeepSpare(const std::string& controller, const ConfigurationNode& theirs)
{
  if (made_kinds_.empty()) return;
  std::string kind = KindByDevices(theirs);
  if (kind.empty()) kind = *made_kinds_.begin();
  const std::set<std::string>& kinds = arena_.VariantsOf(controller).front().bearers.kinds;
  if (!kinds.empty()) kind = *kinds.begin();
  if (made_kinds_.contains(kind)) arena_.KeepSpare(controller, kind, kSpareRobots);
}

void CodeConverter::ConvertController(const ConfigurationNode& theirs, const std::string& id,
                                      const ArenaConverter::Variant& variant, ConfigurationNode& parent)
{
  const SourceLocation& at = theirs.location;
  const Made made = AddNode(parent, "argos3_controller", at);
  SetValue(*made, "id", variant.id, at);
  SetValue(*made, "library", kPlugin, at);
  const Bearers& bearers = variant.bearers;
  const auto is_generic = [](const std::string& kind) { return RobotOfKind(kind)->is_generic; };
  if (bearers.kinds.size() > 1 && std::ranges::any_of(bearers.kinds, is_generic))
    Mistake(at, "robots of several kinds have the controller " + Quoted(id) +
                    ", and their devices differ; give each kind a controller of its own");
  const ConfigurationNode* framework = FindChild(root_, "framework");
  const ConfigurationNode* experiment = framework == nullptr ? nullptr : FindChild(*framework, "experiment");
  const double ticks = experiment == nullptr ? 10 : Number(*experiment, "ticks_per_second", 10);
  const auto radio_medium = RadioMediumOf(theirs);
  const DeviceContext context{bearers,
                              !arena_.FloorId().empty(),
                              ticks,
                              arena_.LargestRadioRange(),
                              radio_channels_.size() > 1,
                              radio_medium.has_value(),
                              media_,
                              [this](const std::string& medium) { return ChecksOcclusions(medium); },
                              [this](const SourceLocation& place, const std::string& text) { Mistake(place, text); },
                              [this](const SourceLocation& place, const std::string& text) { Note(place, text); }};
  NoteListsOf(theirs);
  DeviceLists lists;
  const std::string sensors = ConvertDevices(theirs, "sensors", ConvertSensor, context, lists);
  std::string actuators = ConvertDevices(theirs, "actuators", ConvertActuator, context, lists);
  const std::string own_sensors = TakeOwn(theirs, "sensors", lists.sensors);
  const std::string own_actuators = TakeOwn(theirs, "actuators", lists.actuators);
  // In ARGoS3 the sensor brings a robot into the medium, where others hear it.
  const bool is_kilobot = bearers.kinds.contains("kilobot");
  const auto has_own_messages = [](const std::string& kind) { return RobotOfKind(kind)->has_own_messages; };
  if (radio_medium && !bearers.kinds.empty() && std::ranges::none_of(bearers.kinds, has_own_messages) &&
      !lists.actuators.contains("range_and_bearing"))
  {
    AddSender(at, context, lists);
    actuators += " range_and_bearing";
  }
  for (const auto& [name, devices] : {std::pair("actuators", &lists.actuators), std::pair("sensors", &lists.sensors)})
  {
    const Made list = AddNode(*made, name, at);
    for (const auto& [type, device] : *devices) list->children.push_back(device);
  }
  const ConfigurationNode* params = bearers.params != nullptr ? bearers.params : FindChild(theirs, "params");
  const Made parameters = AddNode(*made, "parameters", at);
  const Made options = AddNode(*parameters, "argos3", at);
  if (theirs.name == "lua_controller")
  {
    SetScript(theirs, params, *options);
  }
  else
  {
    SetValue(*options, "label", theirs.name, at);
    if (theirs.name != kKilobotController || FindAttributeOf(theirs, "library") != nullptr)
      SetLibrary(theirs, theirs.name, "library", *options);
    if (const auto* library = FindAttributeOf(*options, "library"))
      controller_libraries_ += (controller_libraries_.empty() ? "" : ":") + library->value;
  }
  SetValue(*options, "sensors", sensors, at);
  SetValue(*options, "actuators", actuators, at);
  if (!own_sensors.empty()) SetValue(*options, "own_sensors", own_sensors, at);
  if (!own_actuators.empty()) SetValue(*options, "own_actuators", own_actuators, at);
  if (!arena_.FloorId().empty()) SetValue(*options, "floor", "loop_functions", at);
  const auto set_noise =
      [&](const char* name, std::initializer_list<const char*> devices, const char* attribute = "noise_level")
  {
    const auto level = ParseNumber(NoiseOf(theirs, devices, attribute));
    if (level && *level > 0) SetValue(*options, name, TextOf(*level), at);
  };
  set_noise("ground_noise",
            {"footbot_motor_ground", "footbot_base_ground", "ground", "kheperaiv_ground", "epuck_ground"});
  set_noise("proximity_noise", {"proximity", "epuck_proximity", "eyebot_proximity", "kheperaiv_proximity"});
  set_noise("ultrasound_noise", {"kheperaiv_ultrasound"});
  if (const auto ring = lists.sensors.find("proximity"); ring != lists.sensors.end())
    if (const auto* range = FindAttributeOf(*ring->second, "range"))
      SetValue(*options, "proximity_range", range->value, at);
  set_noise("lidar_noise", {"kheperaiv_lidar"});
  set_noise("camera_noise", {"colored_blob_omnidirectional_camera", "epuck_omnidirectional_camera"}, "noise_std_dev");
  set_noise("radio_loss", {"epuck_range_and_bearing"}, "loss_probability");
  set_noise("radio_noise", {"range_and_bearing", "kilobot_communication", "epuck_range_and_bearing"}, "noise_std_dev");
  for (const auto& [ours_name, attribute] :
       {std::pair("max_packets", "max_packets"), std::pair("radio_data_size", "data_size"),
        std::pair("real_range_noise", "real_range_noise")})
    if (const std::string text = NoiseOf(theirs, {"epuck_range_and_bearing"}, attribute); !text.empty())
      SetValue(*options, ours_name, text, at);
  if (is_kilobot && radio_medium) SetKilobotMedium(*radio_medium, *options);
  for (const auto& [name, sensor, attribute] :
       {std::tuple("speed", "differential_steering", "vel_noise_range"),
        std::tuple("distance", "differential_steering", "dist_noise_range"),
        std::tuple("axis", "positioning", "axis_noise_range"), std::tuple("battery", "battery", "noise_range")})
  {
    const std::string range = NoiseOf(theirs, {sensor}, attribute);
    const std::size_t colon = range.find(':');
    if (colon == std::string::npos) continue;
    SetValue(*options, std::string(name) + "_noise_low", range.substr(0, colon), at);
    SetValue(*options, std::string(name) + "_noise_high", range.substr(colon + 1), at);
  }
  const ConfigurationNode* told = FindChild(theirs, "actuators");
  const ConfigurationNode* wheels = told == nullptr ? nullptr : FindChild(*told, "differential_steering");
  const ConfigurationNode* epuck_wheels = told == nullptr ? nullptr : FindChild(*told, "epuck_wheels");
  if (const auto* noise = epuck_wheels == nullptr ? nullptr : FindAttributeOf(*epuck_wheels, "noise_std_dev"))
    SetValue(*options, "wheel_noise", noise->value, at);
  if (wheels != nullptr && std::ranges::any_of(bearers.kinds, is_generic))
    for (const std::string name : kWheelNoise)
      for (const char* side : {"_left", "_right"})
      {
        const auto* own = FindAttributeOf(*wheels, name + side);
        if (own == nullptr) own = FindAttributeOf(*wheels, name);
        if (own != nullptr) SetValue(*options, name + side, own->value, at);
      }
  if (const std::string spare = arena_.SpareOf(id); !spare.empty()) SetValue(*options, "spare", spare, at);
  if (lists.sensors.contains("footbot_perspective_camera") || lists.sensors.contains("eyebot_pan_tilt_camera"))
    SetValue(*options, "camera_aperture", TextOf(bearers.perspective_aperture), at);
  if (bearers.battery != nullptr)
    for (const char* charge : {"start_charge", "full_charge"})
      SetValue(*options, charge, TextOf(Number(*bearers.battery, charge, 1)), at);
  SetValue(*options, "rab_data_size", std::to_string(bearers.radio_bytes), at);
  if (radio_medium && radio_channels_.size() > 1)
  {
    const auto channel = radio_channels_.find({*radio_medium, bearers.radio_bytes});
    SetValue(*options, "radio_channel", std::to_string(std::distance(radio_channels_.begin(), channel)), at);
  }
  if (bearers.battery != nullptr && !lists.sensors.contains("battery"))
    Note(bearers.battery->location,
         "<battery> has no effect without the sensor <battery> in the controller " + Quoted(id));
  options_.push_back(options);
  for (const char* list : {"sensors", "actuators"}) CopyRegistered(theirs, list, *parameters);
  if (params == nullptr)
  {
    if (theirs.name == kKilobotController) Mistake(at, "<kilobot_controller> has no <params behavior=\"PROGRAM\"/>");
    return;
  }
  const auto copy = std::make_shared<ConfigurationNode>(*params);
  if (is_kilobot) FindBehavior(theirs, *copy);
  parameters->children.push_back(copy);
}

std::string CodeConverter::NoiseOf(const ConfigurationNode& controller, std::initializer_list<const char*> names,
                                   const char* attribute)
{
  const ConfigurationNode* sensors = FindChild(controller, "sensors");
  for (const char* name : names)
  {
    const ConfigurationNode* sensor = sensors == nullptr ? nullptr : FindChild(*sensors, name);
    const auto* noise = sensor == nullptr ? nullptr : FindAttributeOf(*sensor, attribute);
    if (noise != nullptr) return noise->value;
  }
  return "";
}

void CodeConverter::SetScript(const ConfigurationNode& theirs, const ConfigurationNode* params,
                              ConfigurationNode& options)
{
  const auto* script = params == nullptr ? nullptr : FindAttributeOf(*params, "script");
  if (script == nullptr)
  {
    SetValue(options, "script_name", "", theirs.location);
    return Note(theirs.location, "without <params script=\"FILE.lua\"/> its robots do nothing");
  }
  std::string searched;
  const auto file = Found({fs::current_path(), folder_, fs::path(folder_).parent_path()}, {script->value}, searched);
  if (!file)
    return Mistake(script->location, "the script " + Quoted(script->value) +
                                         " is not found; start in the folder from which the path leads to it; " +
                                         "searched:" + searched);
  SetValue(options, "script", *file, script->location);
  SetValue(options, "script_name", script->value, script->location);
}

std::vector<fs::path> CodeConverter::Folders() const
{
  std::vector<fs::path> folders{fs::current_path()};
  if (const char* list = std::getenv("ARGOS_PLUGIN_PATH"))
    for (const std::string& one : SplitSearchPath(list, fs::current_path().string())) folders.emplace_back(one);
  folders.emplace_back(folder_);
  folders.push_back(fs::path(folder_).parent_path());
  return folders;
}

std::optional<std::string> CodeConverter::LibraryThatNames(const std::string& label, std::string& searched)
{
  const char* list = std::getenv("ARGOS_PLUGIN_PATH");
  if (list == nullptr || label.empty()) return std::nullopt;
  for (const std::string& folder : SplitSearchPath(list, fs::current_path().string()))
  {
    searched += "\n    " + folder;
    std::error_code none;
    std::set<std::string> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
      if (entry.is_regular_file(none) && entry.path().extension() == ".so") files.insert(entry.path().string());
    // Compilers store equal texts once, so the label is a separate constant, or the end of another one.
    for (const std::string& constant : {std::string(1, '\0') + label + '\0', label + '\0'})
      for (const std::string& file : files)
        if (BytesOf(file).find(constant) != std::string::npos) return file;
  }
  return std::nullopt;
}

std::string CodeConverter::TakeOwn(const ConfigurationNode& controller, const char* name, Devices& devices)
{
  const ConfigurationNode* theirs = FindChild(controller, name);
  std::string tags;
  if (theirs == nullptr) return tags;
  for (const auto& device : theirs->children)
  {
    if (FindAttributeOf(*device, "library") == nullptr) continue;
    const Made own = devices[device->name] = MakeNode(device->name, device->location);
    SetLibrary(*device, device->name, "library", *own);
    for (const ConfigurationNode::Attribute& attribute : device->attributes)
      if (attribute.name != "library") own->attributes.push_back(attribute);
    tags += (tags.empty() ? "" : " ") + device->name;
  }
  return tags;
}

std::optional<std::string> CodeConverter::LibraryOfDevice(const ConfigurationNode& controller, const std::string& list,
                                                          const ConfigurationNode& device)
{
  const auto* implementation = FindAttributeOf(device, "implementation");
  if (implementation == nullptr) return std::nullopt;
  const std::string label =
      "argos3 " + list.substr(0, list.size() - 1) + " " + device.name + " (" + implementation->value + ")";
  const auto [known, is_new] = libraries_of_devices_.try_emplace(label);
  if (!is_new) return known->second;
  for (const ConfigurationNode* user : {&controller, FindChild(root_, "loop_functions")})
  {
    const auto* library = user == nullptr ? nullptr : FindAttributeOf(*user, "library");
    std::string searched;
    const auto file = library == nullptr ? std::nullopt : Found(Folders(), LibraryNames(library->value), searched);
    if (file && BytesOf(*file).find(label + '\0') != std::string::npos) return known->second = file;
  }
  std::string searched;
  return known->second = LibraryThatNames(label, searched);
}

void CodeConverter::CopyRegistered(const ConfigurationNode& controller, const std::string& list,
                                   ConfigurationNode& parameters)
{
  const ConfigurationNode* theirs = FindChild(controller, list);
  if (theirs == nullptr) return;
  Made copies;
  for (const auto& device : theirs->children)
  {
    const auto library = LibraryOfDevice(controller, list, *device);
    if (!library || FindAttributeOf(*device, "library") != nullptr) continue;
    if (controller.name == "lua_controller")
      Mistake(device->location, "<" + device->name + "> is registered by " + *library +
                                    ", and only controllers in C++ reach such devices; scripts use devices with "
                                    "columns (docs/own_device.md)");
    if (copies == nullptr) copies = AddNode(parameters, "registered_" + list, theirs->location);
    const auto copy = std::make_shared<ConfigurationNode>(*device);
    SetValue(*copy, "argos3_library", *library, device->location);
    copies->children.push_back(copy);
    has_registered_devices_ = true;
  }
}

void CodeConverter::SetLibrary(const ConfigurationNode& theirs, const std::string& label, const char* ours,
                               ConfigurationNode& options)
{
  std::string searched;
  const auto* attribute = FindAttributeOf(theirs, "library");
  if (attribute == nullptr)
  {
    if (const auto file = LibraryThatNames(label, searched)) return SetValue(options, ours, *file, theirs.location);
    return Mistake(theirs.location, "<" + theirs.name + "> has no 'library', and no library in the folders of " +
                                        "ARGOS_PLUGIN_PATH names " + Quoted(label) + "; add the one or the other" +
                                        (searched.empty() ? "" : "; searched:" + searched));
  }
  const std::string& library = attribute->value;
  const SourceLocation& at = attribute->location;
  if (const auto file = Found(Folders(), LibraryNames(library), searched)) return SetValue(options, ours, *file, at);
  Mistake(at, "the library " + Quoted(library) +
                  " is not found; build it, name its folder in ARGOS_PLUGIN_PATH, or start in the folder from which " +
                  "the path leads to it; searched:" + searched);
}

std::optional<std::string> CodeConverter::Found(const std::vector<fs::path>& folders,
                                                const std::vector<std::string>& names, std::string& searched)
{
  for (const fs::path& folder : folders)
    for (const std::string& name : names)
    {
      const fs::path file = (folder / name).lexically_normal();
      std::error_code none;
      if (fs::is_regular_file(file, none)) return file.string();
      const std::string line = "\n    " + file.string();
      if ((searched + "\n").find(line + "\n") == std::string::npos) searched += line;
    }
  return std::nullopt;
}

// Loop functions may reset a run that then continues. So they get the length of one trial, and not the framework.
void CodeConverter::MoveLength(ConfigurationNode& ours, ConfigurationNode& functions)
{
  for (auto& child : ours.children)
  {
    const auto* length = child->name == "framework" ? FindAttributeOf(*child, "maxclock") : nullptr;
    if (length == nullptr) continue;
    SetValue(functions, "length", length->value, length->location);
    const auto endless = std::make_shared<ConfigurationNode>(*child);
    std::erase_if(endless->attributes, [](const auto& attribute) { return attribute.name == "maxclock"; });
    child = endless;
  }
}

const ConfigurationNode* CodeConverter::UserFunctions() const
{
  const ConfigurationNode* visualization = FindChild(root_, "visualization");
  const ConfigurationNode* window = visualization == nullptr ? nullptr : FindChild(*visualization, "qt-opengl");
  return window == nullptr ? nullptr : FindChild(*window, "user_functions");
}

std::optional<std::string> CodeConverter::UserLibrary(const ConfigurationNode& theirs) const
{
  const std::string label = FindAttributeOf(theirs, "label") == nullptr ? "" : FindAttributeOf(theirs, "label")->value;
  std::string searched;
  if (const auto* library = FindAttributeOf(theirs, "library"))
    return Found(Folders(), LibraryNames(library->value), searched);
  // The library of the loop functions may have them, too.
  const ConfigurationNode* functions = FindChild(root_, "loop_functions");
  const auto* library = functions == nullptr ? nullptr : FindAttributeOf(*functions, "library");
  if (library != nullptr)
    if (auto file = Found(Folders(), LibraryNames(library->value), searched))
      if (BytesOf(*file).find(label + '\0') != std::string::npos) return file;
  return LibraryThatNames(label, searched);
}

bool CodeConverter::SetUserFunctions(const ConfigurationNode& theirs, ConfigurationNode& functions)
{
  const std::string label = NeededText(theirs, "label");
  const auto file = UserLibrary(theirs);
  if (!file && UserFunctionsMayBeMissing())
  {
    Note(theirs.location, "the library of the user functions " + Quoted(label) + " is not found, and none is needed");
    return false;
  }
  if (file)
    SetValue(functions, "user_file", *file, theirs.location);
  else
    SetLibrary(theirs, label, "user_file", functions);
  SetValue(functions, "user_label", label, theirs.location);
  functions.children.push_back(std::make_shared<ConfigurationNode>(theirs));
  return true;
}

void CodeConverter::ConvertLoopFunctions(ConfigurationNode& ours, bool for_rehearsal)
{
  for (const Made& options : options_)
  {
    SetValue(*options, "origin", TextOf(arena_.Origin()), options->location);
    SetValue(*options, "distributed", arena_.Distributed(), options->location);
  }
  const ConfigurationNode* theirs = FindChild(root_, "loop_functions");
  const ConfigurationNode* user = UserFunctions();
  if (theirs == nullptr && user == nullptr && !has_registered_devices_) return;
  const SourceLocation& at = theirs != nullptr ? theirs->location : user != nullptr ? user->location : root_.location;
  const Made list = AddNode(ours, "experiment_functions", at);
  const Made made = AddNode(*list, "argos3_loop_functions", at);
  SetValue(*made, "id", "loop_functions", at);
  SetValue(*made, "library", kPlugin, at);
  if (theirs != nullptr)
  {
    const std::string label = NeededText(*theirs, "label");
    SetLibrary(*theirs, label, "file", *made);
    SetValue(*made, "label", label, at);
  }
  SetValue(*made, "origin", TextOf(arena_.Origin()), at);
  SetValue(*made, "distributed", arena_.Distributed(), at);
  SetValue(*made, "floor", arena_.FloorId(), at);
  SetValue(*made, "controllers", controller_libraries_, at);
  if (resets_runs_) MoveLength(ours, *made);
  if (for_rehearsal) SetValue(*made, "rehearsal", "true", at);
  if (theirs != nullptr) made->children.push_back(std::make_shared<ConfigurationNode>(*theirs));
  const bool draws = user != nullptr && SetUserFunctions(*user, *made);
  if (!draws && theirs == nullptr && !has_registered_devices_) std::erase(ours.children, list);
  if (!asks_for_configuration_) return;
  const Made configuration = AddNode(*made, "configuration", at);
  configuration->children = root_.children;
}

}  // namespace swarmanoid::argos3

namespace swarmanoid
{

void LetUserFunctionsBeMissing() { argos3::UserFunctionsMayBeMissing() = true; }

}  // namespace swarmanoid
