// The program of a real robot: runs a controller library, the one that the simulator runs, on the drivers of the robot.
#include <CLI/CLI.hpp>

#include <fmt/format.h>
#include <csignal>
#include <cstdio>

#include "common/logging/log.h"
#include "common/plugins/library.h"
#include "real_robot/control_loop.h"
#include "real_robot/robot.h"

namespace swarmanoid
{
namespace
{

// As for the command `swarmanoid`.
constexpr int kDone = 0;
constexpr int kUsage = 2;
constexpr int kInvalidFile = 3;
constexpr int kFailed = 4;

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

volatile std::sig_atomic_t told_to_stop = 0;

void CatchSignals()
{
  struct sigaction action
  {
  };
  action.sa_handler = [](int) { told_to_stop = 1; };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

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

void AddOptions(CLI::App& app, Options& options)
{
  app.footer(kExamples);
  app.add_option("FILE", options.file, "Experiment file or robot file")->check(CLI::ExistingFile);
  app.add_option("--controller", options.choice.controller, "Id of the controller, where the file has several");
  app.add_option("--robot", options.choice.id, "Id of this robot; otherwise the file's, else the machine's name");
  app.add_option("--kind", options.choice.kind, "footbot, eyebot or handbot; otherwise as in the file's arena");
  app.add_option("--namespace", options.choice.name_space, "Put before the names of all topics: fb_1/cmd_vel");
  app.add_option("--steps", options.loop.steps, "End after so many control steps; 0: run until Ctrl-C")
      ->capture_default_str();
  app.add_option("--wait", options.loop.wait_s, "Seconds to wait for the first value of each sensor; 0: for ever")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_flag("--end-on-silence", options.loop.end_on_silence,
               "End when a sensor falls silent; otherwise the robot stands until it is back");
  app.add_option("--drivers", options.choice.driver_libraries,
                 "Libraries of drivers; otherwise the file's, else ros2_drivers")
      ->delimiter(',');
  app.add_option("--driver-path", options.driver_path, "Folders of drivers' libraries, separated by colons");
  app.add_option("--controller-path", options.controller_path,
                 "Folders of controllers' libraries, separated by colons");
  app.add_option("--log", options.log_folder, "Folder of the log; otherwise it goes to standard error alone");
  app.add_flag("--quiet", options.quiet, "Only warnings and errors on standard error");
  app.add_flag("--check", options.check, "Show drivers and topics, then end");
  app.add_flag("--list-drivers", options.list_drivers, "List the drivers there are, then end");
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
  return kDone;
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
    return kDone;
  }
  LogInfo("{}", title);
  for (const std::string& line : robot.Wiring()) LogInfo("{}", line);

  CatchSignals();
  options.loop.told_to_stop = [] { return told_to_stop != 0; };
  const LoopReport report = RunControlLoop(robot, options.loop, MonotonicClock());
  LogInfo("stopped");
  fmt::print("finished: {} steps, {:.3f} s, {} overruns, longest step {:.3f} ms, {:.1f} s without sensors\n",
             report.steps, report.seconds, report.overruns, report.longest_step_s * 1e3, report.silent_s);
  return kDone;
}

int Run(int argc, char** argv)
{
  CLI::App app("Runs a controller on a real robot", "swarmanoid_robot");
  Options options;
  AddOptions(app, options);
  try
  {
    app.parse(argc, argv);
    if (options.file.empty() && !options.list_drivers) throw CLI::RequiredError("FILE");
  }
  catch (const CLI::ParseError& error)
  {
    return app.exit(error) == 0 ? kDone : kUsage;
  }
  options.choice.driver_path = SplitSearchPath(options.driver_path, ".");
  options.choice.controller_path = SplitSearchPath(options.controller_path, ".");
  return options.list_drivers ? ListDrivers(options) : RunRobot(options);
}

}  // namespace
}  // namespace swarmanoid

int main(int argc, char** argv)
{
  try
  {
    return swarmanoid::Run(argc, argv);
  }
  catch (const swarmanoid::ConfigurationError& error)
  {
    fmt::print(stderr, "{}\n", error.what());
    return swarmanoid::kInvalidFile;
  }
  catch (const std::exception& error)
  {
    fmt::print(stderr, "swarmanoid_robot: {}\n", error.what());
    return swarmanoid::kFailed;
  }
}
