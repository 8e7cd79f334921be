// `swarmanoid inspect`: shows the readings, the state and the commands of robots at a past tick.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/activity/failure_report.h"
#include "common/checkpoint/library_builds.h"
#include "common/configuration/shown_text.h"
#include "common/configuration/wording.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/program/trust_flag.h"
#include "launcher/branch.h"
#include "launcher/command/sub_command.h"
#include "launcher/supervision/single_run.h"
#include "launcher/system/scratch_folder.h"
#include "simulation/load.h"
#include "simulation/playback/recorded_robot_states.h"
#include "simulation/playback/recorded_run.h"

namespace swarmanoid
{
namespace
{

using Json = nlohmann::ordered_json;

struct InspectOptions
{
  std::string run_at_tick;
  std::vector<std::string> robots;
  bool json = false;
  bool any_build = false;
};

std::vector<std::uint32_t> RobotsOf(const Experiment& experiment, const std::vector<std::string>& ids)
{
  std::vector<std::string> known;
  for (const EntityConfiguration& entity : experiment.entities)
    if (!entity.controller.empty()) known.push_back(entity.id);
  std::vector<std::uint32_t> robots;
  for (const std::string& id : ids)
  {
    const auto found =
        std::find_if(experiment.entities.begin(), experiment.entities.end(),
                     [&](const EntityConfiguration& entity) { return entity.id == id && !entity.controller.empty(); });
    if (found == experiment.entities.end())
      throw UsageError(
          fmt::format("inspect: the run has no robot {} with a controller{}", Quoted(id), DidYouMean(id, known)));
    robots.push_back(static_cast<std::uint32_t>(found - experiment.entities.begin()));
  }
  return robots;
}

Json DevicesJson(const std::vector<DeviceStatus>& devices)
{
  Json list = Json::array();
  for (const DeviceStatus& device : devices)
  {
    Json readings = Json::array();
    // JSON has no infinite numbers, so they become null.
    for (const CCI_Reading& reading : device.readings)
      readings.push_back({{"name", reading.name}, {"unit", reading.unit}, {"value", reading.value}});
    list.push_back({{"type", device.type}, {"readings", readings}});
  }
  return list;
}

void PrintJson(const Experiment& experiment, const BranchRequest& at, const std::vector<RobotStatus>& robots)
{
  Json list = Json::array();
  for (const RobotStatus& robot : robots)
    list.push_back({{"id", experiment.entities[robot.entity].id},
                    {"controller", robot.controller},
                    {"state", robot.state},
                    {"text", robot.text},
                    {"sensors", DevicesJson(robot.sensors)},
                    {"actuators", DevicesJson(robot.actuators)}});
  const Json answer{{"run", at.run}, {"tick", at.tick}, {"robots", list}};
  fmt::print("{}\n", answer.dump(2, ' ', false, Json::error_handler_t::replace));
}

std::string ReadingText(const CCI_Reading& reading)
{
  if (reading.unit == "colour" && reading.value >= 0 && reading.value <= 0xffffff)
    return reading.value == 0 ? "off" : fmt::format("#{:06x}", static_cast<std::uint32_t>(reading.value));
  if (reading.unit == "yes/no") return reading.value != 0 ? "yes" : "no";
  return fmt::format("{:.6g}{}{}", reading.value, reading.unit.empty() ? "" : " ", reading.unit);
}

// Returns true for the readings of a ring: "0", "1" or "led 0", "led 1" and so on.
bool AreNumbered(const std::vector<CCI_Reading>& readings)
{
  if (readings.size() < 2 || !readings.front().name.ends_with('0')) return false;
  const std::string start = readings.front().name.substr(0, readings.front().name.size() - 1);
  for (std::size_t k = 0; k < readings.size(); ++k)
    if (readings[k].name != start + std::to_string(k)) return false;
  return true;
}

void PrintDevices(const char* kind, const std::vector<DeviceStatus>& devices)
{
  for (const DeviceStatus& device : devices)
  {
    fmt::print("  {} {}\n", kind, device.type);
    const std::size_t in_a_line = AreNumbered(device.readings) ? 8 : 1;
    for (std::size_t k = 0; k < device.readings.size(); k += in_a_line)
    {
      fmt::print("    {:<20}", Showable(device.readings[k].name));
      const std::size_t end = std::min(k + in_a_line, device.readings.size());
      for (std::size_t i = k; i < end; ++i) fmt::print(" {:>9}", ReadingText(device.readings[i]));
      fmt::print("\n");
    }
  }
}

void PrintTable(const Experiment& experiment, const std::vector<RobotStatus>& robots)
{
  for (const RobotStatus& robot : robots)
  {
    fmt::print("{} at tick {}, {:g} s\n  controller {}\n", experiment.entities[robot.entity].id, robot.tick,
               static_cast<double>(robot.tick) * experiment.TickSeconds(), robot.controller);
    if (!robot.state.empty()) fmt::print("  state {}\n", Showable(robot.state));
    if (!robot.text.empty() && robot.text != robot.state) fmt::print("  says {}\n", Showable(robot.text));
    PrintDevices("sensor", robot.sensors);
    PrintDevices("actuator", robot.actuators);
  }
}

int Inspect(const InspectOptions& options)
{
  const auto at = ReadRunAtTick(options.run_at_tick);
  if (!at)
    throw UsageError(
        fmt::format("inspect: {} is no run and tick; for example runs/first@500", Quoted(options.run_at_tick)));
  RecordedRun run(at->run);
  PrintLoss(run.Loss());
  const auto experiment = LoadOrComplain(at->run + "/experiment.xml", {});
  if (!experiment) return kExitInvalidFile;
  const std::vector<std::uint32_t> robots = RobotsOf(*experiment, options.robots);
  const std::string difference =
      DifferenceOfBuilds(run.Journal().Start().origin.libraries, LibraryBuildsOf(*experiment));
  if (!difference.empty() && !options.any_build)
    throw UsageError("inspect: the run was made by " + difference +
                     "; inspect it with that build, or let --any-build take it");
  std::vector<RobotStatus> found;
  try
  {
    const ScratchFolder scratch;
    found = HasLoopFunctions(*experiment) ? StatesInWholeRun(*experiment, run, at->tick, robots, scratch.Path())
                                          : RecordedRobotStates(*experiment, at->run, at->tick, robots).Robots();
  }
  catch (const ActivityError&)
  {
    throw;
  }
  catch (const std::runtime_error& error)
  {
    PrintError("swarmanoid: inspect: {}\n", error.what());
    return kExitProcessFailed;
  }
  if (options.json)
    PrintJson(*experiment, *at, found);
  else
    PrintTable(*experiment, found);
  return run.ExitCode(kExitDone);
}

void AddInspectCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<InspectOptions>();
  CLI::App* verb =
      app.add_subcommand("inspect", "Show what robots sensed, thought and commanded at a tick of a run's past");
  verb->add_option("RUN@TICK", options->run_at_tick, "The folder of a run with a journal, which may go on, and a tick")
      ->required();
  verb->add_option("ROBOT", options->robots, "Ids of robots that have controllers")->required();
  verb->add_flag("--json", options->json, "For programs: one JSON object, with all digits");
  verb->add_flag("--any-build", options->any_build, "Also if the run was made by another build of a library");
  AddTrustFlag(*verb);
  verb->footer(
      "The controllers of these robots' hosts do all steps again since the newest state that was saved, and what they\n"
      "command is compared with the journal; what they log and write by themselves is written again.\n"
      "Example:\n"
      "  swarmanoid inspect runs/diffusion_10-20310517-093000@500 fb_3");
  verb->callback([options, &exit_code] { exit_code = Inspect(*options); });
}

const RegisterSubCommand kInspect(5, "inspect", AddInspectCommand);

}  // namespace
}  // namespace swarmanoid
