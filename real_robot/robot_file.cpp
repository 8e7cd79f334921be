// One controller of an experiment file is run on a robot, and the file stays the one of the simulator: its world is
// ignored, and only what a robot needs is read (period, seed, controller, device lists). A robot file adds what the
// simulator does not know, namely id, name space and drivers. Its elements are checked against the names that may stand
// in it, with a proposal for a misspelt one; all errors have file and line.
#include "real_robot/robot_file.h"

#include <unistd.h>

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>

#include "common/configuration/parameter.h"
#include "common/configuration/regular_file.h"
#include "common/configuration/wording.h"
#include "common/configuration/xml_reader.h"
#include "common/plugins/plugin_library.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* kShippedDrivers = "ros2_drivers";
const std::vector<std::string> kKinds{"footbot", "eyebot", "handbot"};

struct File
{
  TConfigurationTree root;
  std::string folder;
};

File Read(const std::string& path)
{
  const fs::path folder = fs::absolute(path).parent_path();
  return {TConfigurationTree(ReadXml(ReadTextFile(path), path)), folder.string()};
}

// Refuses attributes and elements that a robot file may not have at this place.
void CheckNames(const TConfigurationTree& tree, const std::vector<std::string>& attributes,
                const std::vector<std::string>& children)
{
  for (const auto& attribute : tree.Node()->attributes)
    if (std::ranges::find(attributes, attribute.name) == attributes.end())
      throw ConfigurationError(attribute.location, fmt::format("<{}> has no attribute {}; allowed are: {}{}",
                                                               tree.Name(), Quoted(attribute.name), Listed(attributes),
                                                               DidYouMean(attribute.name, attributes)));
  for (const TConfigurationTree& child : tree.Children())
    if (std::ranges::find(children, child.Name()) == children.end())
      throw ConfigurationError(child.Location(),
                               fmt::format("<{}> cannot stand in <{}>; allowed are: {}{}", child.Name(), tree.Name(),
                                           Listed(children), DidYouMean(child.Name(), children)));
}

std::vector<std::string> SplitNames(const std::string& text)
{
  std::vector<std::string> names;
  for (std::size_t start = 0; start <= text.size();)
  {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    const std::string name(TrimBlanks(text.substr(start, comma - start)));
    if (!name.empty()) names.push_back(name);
    start = comma + 1;
  }
  return names;
}

// Returns the kind of the first robot of the arena that uses the controller, also in a <distribute>.
std::string KindInArena(const TConfigurationTree& tree, const std::string& controller)
{
  for (const TConfigurationTree& child : tree.Children())
  {
    if (std::ranges::find(kKinds, child.Name()) != kKinds.end() && child.Value("controller") == controller)
      return child.Name();
    if (std::string kind = KindInArena(child, controller); !kind.empty()) return kind;
  }
  return {};
}

TConfigurationTree ChooseController(const TConfigurationTree& experiment, const std::string& id, const char* how)
{
  const auto controllers = experiment.Child("controllers").Children();
  std::vector<std::string> ids;
  for (const TConfigurationTree& controller : controllers) ids.push_back(controller.GetText("id", ""));
  if (controllers.empty())
    throw ConfigurationError(experiment.Location(), "the file has no controllers: nothing to run");
  if (id.empty() && controllers.size() == 1) return controllers.front();
  if (id.empty())
    throw ConfigurationError(experiment.Child("controllers").Location(),
                             fmt::format("the file has the controllers {}; choose one by {}", Listed(ids), how));
  const auto found = std::ranges::find(ids, id);
  if (found != ids.end()) return controllers[static_cast<std::size_t>(found - ids.begin())];
  throw ConfigurationError(experiment.Child("controllers").Location(),
                           fmt::format("there is no controller with the id {}; there are: {}{}", Quoted(id),
                                       Listed(ids), DidYouMean(id, ids)));
}

std::vector<RobotDevice> ListedDevices(const TConfigurationTree& list)
{
  std::vector<RobotDevice> devices;
  for (const TConfigurationTree& device : list.Children())
  {
    for (const RobotDevice& other : devices)
      if (other.type == device.Name())
        throw ConfigurationError(device.Location(), fmt::format("<{}> is listed twice; the first is in line {}",
                                                                device.Name(), other.location.line));
    devices.push_back({device.Name(), "", {}, device.Location()});
  }
  return devices;
}

void AddFolders(std::vector<std::string>& folders, const std::string& list, const std::string& base)
{
  for (std::string& folder : SplitSearchPath(list, base)) folders.push_back(std::move(folder));
}

// Reads the parts of an experiment file that a robot needs.
void ReadExperiment(const File& file, const std::string& controller_id, const char* how, RobotConfiguration& robot)
{
  const TConfigurationTree framework = file.root.Child("framework");
  const auto number = [&framework](const char* name, long long fallback, long long least, long long most)
  {
    const long long value = framework.GetInteger(name, fallback);
    if (value >= least && value <= most) return value;
    throw ConfigurationError(framework.ValueLocation(name),
                             fmt::format("<{}> is {}; it must be {} to {}", name, value, least, most));
  };
  robot.clock_tick_ms = static_cast<std::uint32_t>(number("clocktick", 100, 1, 60000));
  robot.seed = static_cast<std::uint64_t>(number("seed", 1, 0, std::numeric_limits<long long>::max()));

  const TConfigurationTree controller = ChooseController(file.root, controller_id, how);
  robot.controller_tag = controller.Name();
  robot.controller_id = controller.GetText("id", "");
  robot.controller_library = controller.GetText("library", "");
  robot.parameters = controller.Child("parameters");
  robot.folder = file.folder;
  robot.location = controller.Location();
  robot.library_location =
      robot.controller_library.empty() ? controller.Location() : controller.ValueLocation("library");
  robot.sensors = ListedDevices(controller.Child("sensors"));
  robot.actuators = ListedDevices(controller.Child("actuators"));
  if (robot.kind.empty()) robot.kind = KindInArena(file.root.Child("arena"), robot.controller_id);

  AddFolders(robot.controller_path, framework.GetText("controller_path", ""), file.folder);
  robot.controller_path.push_back(file.folder);
}

// Reads <drivers>: the driver of each device, with its parameters.
void ReadDriverChoices(const TConfigurationTree& list, const char* what, std::vector<RobotDevice>& devices)
{
  std::vector<std::string> types;
  for (const RobotDevice& device : devices) types.push_back(device.type);
  for (const TConfigurationTree& choice : list.Children())
  {
    const auto found = std::ranges::find(types, choice.Name());
    if (found == types.end())
      throw ConfigurationError(choice.Location(),
                               fmt::format("the controller lists no {} <{}>; it lists: {}{}", what, choice.Name(),
                                           Listed(types), DidYouMean(choice.Name(), types)));
    RobotDevice& device = devices[static_cast<std::size_t>(found - types.begin())];
    if (device.tree.Exists())
      throw ConfigurationError(choice.Location(), fmt::format("<{}> has a driver already, in line {}", choice.Name(),
                                                              device.tree.Location().line));
    device.driver = choice.Attribute("driver");
    device.tree = choice;
  }
}

void ReadOwnFile(const File& file, const RobotChoice& choice, RobotConfiguration& robot)
{
  const TConfigurationTree& root = file.root;
  CheckNames(root, {"id", "kind", "namespace"}, {"experiment", "drivers"});
  if (robot.id.empty()) robot.id = root.Attribute("id");
  if (robot.kind.empty()) robot.kind = root.Attribute("kind");
  if (robot.name_space.empty()) robot.name_space = root.Attribute("namespace");

  const TConfigurationTree experiment = root.Child("experiment");
  if (!experiment.Exists() || !experiment.HasAttribute("file"))
    throw ConfigurationError((experiment.Exists() ? experiment : root).Location(),
                             "a robot file names the experiment whose controller is to run: "
                             "<experiment file=\"experiment.xml\" controller=\"its id\"/>");
  CheckNames(experiment, {"file", "controller"}, {});
  const std::string path = (fs::path(file.folder) / experiment.Attribute("file")).lexically_normal().string();
  if (const std::string mistake = FileMistake(path); !mistake.empty())
    throw ConfigurationError(experiment.ValueLocation("file"), fmt::format("{}: {}", Quoted(path), mistake));
  ReadExperiment(Read(path), choice.controller.empty() ? experiment.Attribute("controller") : choice.controller,
                 "<experiment controller=\"…\"/> or --controller", robot);

  const TConfigurationTree drivers = root.Child("drivers");
  if (!drivers.Exists()) return;
  CheckNames(drivers, {"library", "path", "prefer"}, {"sensors", "actuators"});
  if (robot.driver_libraries.empty()) robot.driver_libraries = SplitNames(drivers.Attribute("library"));
  AddFolders(robot.driver_path, drivers.Attribute("path"), file.folder);
  robot.preferred_driver = drivers.Attribute("prefer");
  ReadDriverChoices(drivers.Child("sensors"), "sensor", robot.sensors);
  ReadDriverChoices(drivers.Child("actuators"), "actuator", robot.actuators);
}

std::string HostName()
{
  char name[256] = {};
  gethostname(name, sizeof(name) - 1);
  return name;
}

}  // namespace

RobotConfiguration ReadRobotFile(const std::string& path, const RobotChoice& choice)
{
  const File file = Read(path);
  RobotConfiguration robot;
  robot.id = choice.id;
  robot.kind = choice.kind;
  robot.name_space = choice.name_space;
  robot.controller_path = choice.controller_path;
  robot.driver_libraries = choice.driver_libraries;
  robot.driver_path = choice.driver_path;

  if (file.root.Name() == "ahss-config")
    ReadExperiment(file, choice.controller, "--controller ID", robot);
  else if (file.root.Name() == "ahss-robot")
    ReadOwnFile(file, choice, robot);
  else
    throw ConfigurationError(
        file.root.Location(),
        fmt::format("<{}> is neither an experiment (<ahss-config>) nor a robot (<ahss-robot>)", file.root.Name()));

  if (robot.kind.empty())
    throw ConfigurationError(robot.location,
                             fmt::format("no robot of the arena uses the controller {}, so its kind is unknown; give "
                                         "it: --kind footbot, eyebot or handbot",
                                         Quoted(robot.controller_id)));
  if (std::ranges::find(kKinds, robot.kind) == kKinds.end())
    throw ConfigurationError(file.root.Location(),
                             fmt::format("{} is no kind of robot; there are: {}{}", Quoted(robot.kind), Listed(kKinds),
                                         DidYouMean(robot.kind, kKinds)));
  if (robot.id.empty()) robot.id = HostName();
  if (robot.driver_libraries.empty()) robot.driver_libraries = {kShippedDrivers};
  if (robot.preferred_driver.empty()) robot.preferred_driver = "ros2";
  robot.driver_path.push_back(file.folder);
  for (const std::string& folder : StandardPluginFolders())
  {
    robot.controller_path.push_back(folder);
    robot.driver_path.push_back(folder);
  }
  return robot;
}

}  // namespace swarmanoid
