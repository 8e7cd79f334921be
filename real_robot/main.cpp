// The program of a real robot. It runs the same controller library as the simulator, on the drivers of the robot.
#include <fmt/format.h>

#include <cstdio>

#include "common/configuration/regular_file.h"
#include "common/logging/log.h"
#include "common/plugins/plugin_library.h"
#include "common/program/interrupts.h"
#include "common/program/option_parser.h"
#include "common/program/program.h"
#include "common/program/usage_error.h"
#include "real_robot/control_loop.h"
#include "real_robot/robot.h"

namespace swarmanoid
{
namespace
{

constexpr const char* kExamples =
    "FILE is an experiment file, of which one controller is run, or a robot file that names one and chooses drivers.\n"
    "\n"
    "Examples:\n"
    "  swarmanoid_robot diffusion.xml --robot fb_1          run its controller; Ctrl-C stops the robot and ends\n"
    "  swarmanoid_robot prey_retrieval.xml --controller retriever --namespace fb_1\n"
    "  swarmanoid_robot my_footbot.xml --check              show drivers and topics, without running\n"
    "  swarmanoid_robot --list-drivers                      all drivers of the library ros2_drivers\n"
    "\n"
    "Environment: ROS_DOMAIN_ID and ROS_LOCALHOST_ONLY for the ros2 drivers; SWARMANOID_PLUGIN_PATH, further folders\n"
    "of libraries. Exit codes: 0 done or stopped by Ctrl-C, 2 wrong usage, 3 the file is invalid, 4 the robot failed.";

struct Options
{
  std::string file;
  RobotChoice choice;
  std::string controller_path;
  std::string driver_path;
  std::string log_folder;
  LoopOptions loop;
  bool check = false;
  bool list_drivers = false;
  bool quiet = false;
};

std::vector<OptionSpec> OptionTable(Options& o)
{
  using enum ParameterType;
  constexpr double kYear_s = 31'536'000;
  constexpr double kMostSteps = 1e15;
  return {
      {Path("FILE", "Experiment file or robot file"), &o.file, "diffusion.xml", "", FileMistake},
      {Text("controller", "Id of the controller, where the file has several"), &o.choice.controller, "retriever"},
      {Text("robot", "Id of this robot; otherwise the file's, else the machine's name"), &o.choice.id, "fb_1"},
      {{.name = "kind",
        .type = kChoice,
        .description = "Kind of the robot; otherwise as in the file's arena",
        .choices = {"footbot", "eyebot", "handbot"}},
       &o.choice.kind},
      {Text("namespace", "Put before the names of all topics: fb_1/cmd_vel"), &o.choice.name_space, "fb_1"},
      {Whole("steps", "End after so many control steps; 0: run until Ctrl-C", 0, kMostSteps), &o.loop.steps, "100"},
      {Number("wait", "s", "Time to wait for the first value of each sensor; 0: for ever", 0, kYear_s), &o.loop.wait_s,
       "30"},
      {Flag("end-on-silence", "End when a sensor falls silent; otherwise the robot stands until it is back"),
       &o.loop.end_on_silence},
      {Text("drivers", "Libraries of drivers; otherwise the file's, else ros2_drivers"),
       &o.choice.driver_libraries,
       "ros2_drivers",
       "A,B,...",
       {},
       false,
       true},
      {Text("driver-path", "Folders of drivers' libraries, separated by colons"), &o.driver_path,
       "drivers:/opt/drivers"},
      {Text("controller-path", "Folders of controllers' libraries, separated by colons"), &o.controller_path,
       "real_robot_build/controllers"},
      {Path("log", "Folder of the log; otherwise it goes to standard error alone"), &o.log_folder, "logs"},
      {Flag("quiet", "Only warnings and errors on standard error"), &o.quiet},
      {Flag("check", "Show drivers and topics, then end"), &o.check},
      {Flag("list-drivers", "List the drivers there are, then end"), &o.list_drivers},
  };
}

int ListDrivers(const Options& options)
{
  RobotConfiguration configuration;
  configuration.driver_libraries = options.choice.driver_libraries;
  if (configuration.driver_libraries.empty()) configuration.driver_libraries = {"ros2_drivers"};
  configuration.driver_path = options.choice.driver_path;
  for (const std::string& folder : StandardPluginFolders()) configuration.driver_path.push_back(folder);
  LoadDriverLibraries(configuration);
  fmt::print("{}", DriverList());
  return kExitDone;
}

int RunRobot(Options& options)
{
  LogSettings log;
  log.process = "swarmanoid_robot";
  log.folder = options.log_folder;
  log.stderr_level = options.quiet || options.check ? LogLevel::kWarning : LogLevel::kInfo;
  OpenLog(log);

  Robot robot(ReadRobotFile(options.file, options.choice));
  const RobotConfiguration& configuration = robot.Configuration();
  const std::string title =
      fmt::format("robot {} ({}), controller {} of library {}", configuration.id, configuration.kind,
                  configuration.controller_id, configuration.controller_library);
  if (options.check)
  {
    fmt::print("{}\n", title);
    for (const std::string& line : robot.Wiring()) fmt::print("  {}\n", line);
    return kExitDone;
  }
  LogInfo("{}", title);
  for (const std::string& line : robot.Wiring()) LogInfo("{}", line);

  options.loop.told_to_stop = [] { return Interrupted(); };
  const LoopReport report = RunControlLoop(robot, options.loop, MonotonicClock());
  LogInfo("stopped");
  fmt::print("finished: {} steps, {:.3f} s, {} overruns, longest step {:.3f} ms, {:.1f} s without sensors\n",
             report.steps, report.seconds, report.overruns, report.longest_step_s * 1e3, report.silent_s);
  return kExitDone;
}

int Run(Options& options)
{
  if (options.file.empty() && !options.list_drivers)
    throw UsageError(
        "give the FILE whose controller is to run; for example swarmanoid_robot diffusion.xml --robot fb_1");
  options.choice.driver_path = SplitSearchPath(options.driver_path, ".");
  options.choice.controller_path = SplitSearchPath(options.controller_path, ".");
  return options.list_drivers ? ListDrivers(options) : RunRobot(options);
}

}  // namespace
}  // namespace swarmanoid

int main(int count, char** arguments)
{
  using namespace swarmanoid;

  Options options;
  return RunProgram(
      {"swarmanoid_robot", "Runs a controller on a real robot.", kExamples}, count, arguments,
      [&](CLI::App& app) { AddOptions(app, OptionTable(options)); }, [&] { return Run(options); });
}
