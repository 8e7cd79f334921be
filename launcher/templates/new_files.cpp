#include "launcher/templates/new_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <vector>

#include "common/configuration/wording.h"
#include "common/program/shell_word.h"
#include "common/program/usage_error.h"
#include "launcher/system/installation.h"
#include "launcher/templates/template_files.h"

namespace swarmanoid
{

namespace fs = std::filesystem;

fs::path UserDirectoryHere()
{
  for (fs::path folder = fs::current_path();; folder = folder.parent_path())
  {
    if (fs::is_directory(folder / "controllers") && fs::exists(folder / "build.sh")) return folder;
    if (folder == folder.root_path()) return {};
  }
}

namespace
{

constexpr double kLeastTerrain_m = 0.8;

struct RobotKind
{
  const char* name;
  const char* state;
  const char* state_header;
  const char* example;  // example of a behaviour's step
};

constexpr std::array kRobots{
    RobotKind{
        "footbot", "CCI_FootBotState", "ci_footbot_state.h",
        "  // For example: stands still before what is ahead. If nothing is set, earlier behaviours decide.\n"
        "  if (cRobotState.GetProximitySensorReading(0) > 0.5) cRobotState.SetFootBotWheelsLinearVelocity(0, 0);"},
    RobotKind{
        "handbot", "CCI_HandBotState", "ci_handbot_state.h",
        "  // For example: stops the winch near the ceiling. If nothing is set, earlier behaviours decide.\n"
        "  if (cRobotState.GetJoint(CCI_HandBotJointsSensor::ROPE_LENGTH) < 0.5) cRobotState.SetWinchVelocity(0);"},
    RobotKind{"eyebot", "CCI_EyeBotState", "ci_eyebot_state.h",
              "  // For example: rises if it is too low. If nothing is set, earlier behaviours decide.\n"
              "  if (cRobotState.GetAltitude() < 0.5) cRobotState.SetVelocity(0, 0, 0.1, 0);"}};

const RobotKind& Robot(const std::string& name)
{
  std::vector<std::string> names;
  for (const RobotKind& robot : kRobots)
  {
    if (robot.name == name) return robot;
    names.emplace_back(robot.name);
  }
  throw UsageError(
      fmt::format("there is no robot {}; the robots are {}{}", Quoted(name), Listed(names), DidYouMean(name, names)));
}

fs::path RequireUserDirectory()
{
  fs::path folder = UserDirectoryHere();
  if (folder.empty())
    throw UsageError(
        "this is no user directory; make a user directory first and go there:\n"
        "  swarmanoid new user my_robots && cd my_robots");
  return folder;
}

// Refuses a name that cannot be a target of the user's build, or that is taken.
void RefuseTakenTarget(const fs::path& user, const std::string& name)
{
  const std::vector<std::string> taken{"all",     "clean", "codegen", "depend",     "edit_cache",    "help",
                                       "install", "list",  "package", "simulation", "rebuild_cache", "test"};
  if (std::find(taken.begin(), taken.end(), name) != taken.end())
    throw UsageError(fmt::format("'{}' cannot be a name: the build has a target of that name; choose another", name));
  for (const char* folder : {"controllers", "devices", "engines", "entities", "functions", "renderers"})
    RefuseExisting(user / folder / name);
}

void RequireIdentifier(const std::string& name)
{
  if (!IsIdentifier(name))
    throw UsageError(
        fmt::format("'{}' cannot be a name: use small letters, digits and '_', starting with a letter, "
                    "for example wall_follower",
                    name));
}

void RequireClassName(const std::string& name)
{
  if (!IsClassName(name))
    throw UsageError(
        fmt::format("'{}' cannot be the name of a class: use letters, digits and '_', starting with a capital letter, "
                    "for example CWallFollower",
                    name));
}

void MakeFile(const std::string& from, const fs::path& to, const TemplateValues& values)
{
  WriteFromTemplate(fs::path(UserFilesFolder()) / "templates" / from, to, values);
  fmt::print("  {}\n", fs::relative(to).string());
}

// Returns the command by which the user calls this program: its name if the PATH finds it, otherwise its path.
std::string ProgramName()
{
  const fs::path own = OwnProgram();
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
  {
    std::error_code error;
    if (fs::equivalent(fs::path(folder) / own.filename(), own, error)) return own.filename();
  }
  return own;
}

void TellRun(const fs::path& experiment)
{
  fmt::print("Next:\n  {} run {}\n", ShellWord(ProgramName()), ShellWord(fs::relative(experiment)));
}

void TellNext(const fs::path& user, const fs::path& experiment)
{
  const std::string build = fs::relative(user / "build.sh").string();
  fmt::print("Next:\n  {}\n", ShellWord(build.starts_with("..") ? build : "./" + build));
  if (!experiment.empty()) fmt::print("  {} run {}\n", ShellWord(ProgramName()), ShellWord(fs::relative(experiment)));
}

// Makes a plug-in in `folder` of the user directory, and an experiment with it. `templates`: their folder, and the
// start of their names. `with_controller`: also makes a controller that uses it.
void NewPlugin(const std::string& name, const char* what, const char* folder, const std::string& templates,
               const std::vector<std::string>& endings, bool with_controller = false)
{
  RequireIdentifier(name);
  const fs::path user = RequireUserDirectory();
  const fs::path experiment = user / "experiments" / (name + ".xml");
  const std::string controller = "with_" + name;
  RefuseTakenTarget(user, name);
  if (with_controller) RefuseTakenTarget(user, controller);
  RefuseExisting(experiment);
  const TemplateValues values{{"name", name}, {"class", ClassName(name)}, {"stem", ClassName(name).substr(1)}};
  fmt::print("Made {} {}:\n", what, name);
  for (const std::string& ending : endings)
    MakeFile(templates + "/" + templates + ending + ".in", user / folder / name / (name + ending), values);
  if (with_controller)
    MakeFile(templates + "/controller.cpp.in", user / "controllers" / controller / (controller + ".cpp"), values);
  MakeFile(templates + "/experiment.xml.in", experiment, values);
  TellNext(user, experiment);
}

std::string WithArticle(const RobotKind& robot)
{
  return std::string(robot.name[0] == 'e' ? "an " : "a ") + robot.name;
}

std::string TextOf(const fs::path& file)
{
  std::ifstream input(file);
  return {std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
}

// Returns the robot of the behaviour controller in a folder, or nullptr if it has none.
const RobotKind* RobotOfControllerIn(const fs::path& folder)
{
  for (const auto& entry : fs::directory_iterator(folder))
  {
    if (entry.path().extension() != ".h") continue;
    const std::string text = TextOf(entry.path());
    for (const RobotKind& robot : kRobots)
      if (text.find(fmt::format("CCI_BehaviorController<{}>", robot.state)) != std::string::npos) return &robot;
  }
  return nullptr;
}

}  // namespace

// Makes a user directory by a script, since build_framework makes one before anything is built.
void NewUserDirectory(const std::string& directory)
{
  const std::string script = fs::path(UserFilesFolder()) / "user_scripts" / "create_user_directory.sh";
  RefuseExisting(directory);
  execl(script.c_str(), script.c_str(), directory.c_str(), nullptr);
  throw std::runtime_error(fmt::format("cannot start '{}': {}", script, std::strerror(errno)));
}

void NewController(const std::string& name)
{
  NewPlugin(name, "controller", "controllers", "controller", {".h", ".cpp"});
}

void NewExperiment(const std::string& name)
{
  RequireIdentifier(name);
  const fs::path user = UserDirectoryHere();
  const fs::path file = (user.empty() ? fs::current_path() : user / "experiments") / (name + ".xml");
  RefuseExisting(file);
  fmt::print("Made experiment {}:\n", name);
  MakeFile("experiment/experiment.xml.in", file, {{"name", name}});
  TellRun(file);
}

void NewFunctions(const std::string& name)
{
  NewPlugin(name, "experiment functions", "functions", "functions", {".cpp"});
}

void NewEngine(const std::string& name) { NewPlugin(name, "physics engine", "engines", "engine", {".h", ".cpp"}); }

void NewRenderer(const std::string& name) { NewPlugin(name, "visualisation", "renderers", "renderer", {".cpp"}); }

void NewDevice(const std::string& name) { NewPlugin(name, "sensor", "devices", "device", {".h", ".cpp"}, true); }

void NewEntity(const std::string& name) { NewPlugin(name, "kind of robot", "entities", "entity", {".cpp"}, true); }

namespace
{

// Makes a controller in a script. The simulator reads it, so nothing must be built.
void NewScript(const std::string& name, const std::string& language, const std::string& ending)
{
  RequireIdentifier(name);
  const fs::path user = RequireUserDirectory();
  const fs::path experiment = user / "experiments" / (name + ".xml");
  RefuseTakenTarget(user, name);
  RefuseExisting(experiment);
  fmt::print("Made controller {} in {}:\n", name, language == "lua" ? "Lua" : "Python");
  const TemplateValues values{{"name", name}, {"language", language}, {"ending", ending}};
  MakeFile("script/controller." + ending + ".in", user / "controllers" / name / (name + "." + ending), values);
  MakeFile("script/experiment.xml.in", experiment, values);
  TellRun(experiment);
}

}  // namespace

void NewLua(const std::string& name) { NewScript(name, "lua", "lua"); }

void NewPython(const std::string& name) { NewScript(name, "python", "py"); }

void NewTerrain(const std::string& name, const RoughTerrain& terrain)
{
  RequireIdentifier(name);
  const fs::path user = UserDirectoryHere();
  const fs::path folder = user.empty() ? fs::current_path() : user / "experiments";
  const fs::path map = folder / "terrain" / (name + ".bt");
  const fs::path experiment = folder / (name + ".xml");
  RefuseExisting(map);
  RefuseExisting(experiment);
  if (!(terrain.size.minCoeff() >= kLeastTerrain_m))
    throw UsageError(fmt::format("--size: robots need {} m and more in x and y", kLeastTerrain_m));
  fs::create_directories(map.parent_path());
  try
  {
    WriteRoughTerrain(map.string(), terrain);
  }
  catch (const std::invalid_argument& error)
  {
    throw UsageError(error.what());
  }
  const double area = terrain.size.x() * terrain.size.y();
  const TemplateValues values{
      {"name", name},
      {"size_x", fmt::format("{}", terrain.size.x())},
      {"size_y", fmt::format("{}", terrain.size.y())},
      {"middle_x", fmt::format("{:.6g}", terrain.size.x() / 2)},
      {"middle_y", fmt::format("{:.6g}", terrain.size.y() / 2)},
      {"far_x", fmt::format("{:.6g}", terrain.size.x() - 0.2)},
      {"far_y", fmt::format("{:.6g}", terrain.size.y() - 0.2)},
      {"start", fmt::format("{:.6g}", terrain.roughness + 0.01)},
      {"roughness", fmt::format("{}", terrain.roughness)},
      {"resolution", fmt::format("{}", terrain.resolution)},
      {"robots", fmt::format("{}", std::clamp(static_cast<int>(area), 1, 20))},
      {"options", fmt::format("--size {},{} --resolution {} --roughness {} --holes {} --depth {} --seed {}",
                              terrain.size.x(), terrain.size.y(), terrain.resolution, terrain.roughness, terrain.holes,
                              terrain.depth, terrain.seed)}};
  fmt::print("Made terrain {}:\n  {}\n", name, fs::relative(map).string());
  MakeFile("terrain/experiment.xml.in", experiment, values);
  TellRun(experiment);
}

void NewBehaviorController(BehaviorControllerNames names)
{
  RequireIdentifier(names.name);
  const RobotKind& robot = Robot(names.robot);
  if (names.class_name.empty()) names.class_name = ClassName(names.name);
  if (names.behavior.empty()) names.behavior = fmt::format("bt_{}_{}", robot.name, names.name);
  if (names.behavior_class.empty()) names.behavior_class = BehaviorClassName(names.behavior);
  RequireIdentifier(names.behavior);
  RequireClassName(names.class_name);
  RequireClassName(names.behavior_class);
  if (names.behavior == names.name || names.behavior_class == names.class_name)
    throw UsageError("the controller and its root behaviour need different names");

  const fs::path user = RequireUserDirectory();
  const fs::path folder = user / "controllers" / names.name;
  const fs::path experiment = names.experiment ? user / "experiments" / (names.name + ".xml") : fs::path();
  RefuseTakenTarget(user, names.name);
  if (names.experiment) RefuseExisting(experiment);
  const TemplateValues values{{"name", names.name},
                              {"class", names.class_name},
                              {"behavior", names.behavior},
                              {"behavior_class", names.behavior_class},
                              {"robot", WithArticle(robot)},
                              {"state", robot.state},
                              {"state_header", robot.state_header}};
  const std::string of_robot = fmt::format("behavior_controller/{}", robot.name);
  fmt::print("Made behavior controller {} of {}:\n", names.name, WithArticle(robot));
  MakeFile("behavior_controller/controller.h.in", folder / (names.name + ".h"), values);
  MakeFile("behavior_controller/controller.cpp.in", folder / (names.name + ".cpp"), values);
  MakeFile(of_robot + ".h.in", folder / (names.behavior + ".h"), values);
  MakeFile(of_robot + ".cpp.in", folder / (names.behavior + ".cpp"), values);
  if (names.experiment) MakeFile(of_robot + ".xml.in", experiment, values);
  TellNext(user, experiment);
}

void NewBehavior(BehaviorNames names)
{
  RequireIdentifier(names.name);
  if (names.class_name.empty()) names.class_name = BehaviorClassName(names.name);
  RequireClassName(names.class_name);
  if (!names.robot.empty()) Robot(names.robot);
  const fs::path user = RequireUserDirectory();
  const fs::path folder = names.controller.empty() ? fs::current_path() : user / "controllers" / names.controller;
  if (!fs::is_directory(folder))
    throw UsageError(fmt::format("there is no controller {} in {}", Quoted(names.controller),
                                 fs::relative(user / "controllers").string()));
  const RobotKind* robot = RobotOfControllerIn(folder);
  if (robot == nullptr)
    throw UsageError(fmt::format(
        "there is no behavior controller in {}; go into the folder of one, or name it by --controller. To make one:\n"
        "  swarmanoid new behavior-controller NAME",
        names.controller.empty() ? "this folder" : Quoted(fs::relative(folder).string())));
  if (!names.robot.empty() && names.robot != robot->name)
    throw UsageError(
        fmt::format("the controller in {} is of {}: a behavior there cannot be of {}; choose another controller, or "
                    "leave --robot out",
                    Quoted(fs::relative(folder, user).string()), WithArticle(*robot), WithArticle(Robot(names.robot))));
  const fs::path header = folder / (names.name + ".h");
  const fs::path source = folder / (names.name + ".cpp");
  RefuseExisting(header);
  RefuseExisting(source);
  const TemplateValues values{
      {"behavior", names.name}, {"behavior_class", names.class_name},  {"robot", WithArticle(*robot)},
      {"state", robot->state},  {"state_header", robot->state_header}, {"example", robot->example}};
  fmt::print("Made behavior {} of {}:\n", names.class_name, WithArticle(*robot));
  MakeFile("behavior/behavior.h.in", header, values);
  MakeFile("behavior/behavior.cpp.in", source, values);
  fmt::print(
      "To use it: include \"{}.h\" where the root behavior is declared, give that one a member of this class,\n"
      "and call the member's Step(cRobotState) in the root's Step.\n",
      names.name);
  TellNext(user, {});
}

}  // namespace swarmanoid
