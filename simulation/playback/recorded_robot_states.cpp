#include "simulation/playback/recorded_robot_states.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "common/journal/commands_by_robot.h"
#include "common/journal/journal_reader.h"
#include "common/journal/recorded_states.h"
#include "common/space/space.h"
#include "controller_host/controller_host.h"
#include "simulation/playback/recorded_run.h"
#include "simulation/watched_simulator.h"

namespace swarmanoid
{
namespace
{

struct PastHost
{
  std::size_t number;
  std::unique_ptr<ControllerHost> role;
};

// Repeats a tick, as a process that replaces a controller host does, and compares the commands. `commands`: those of
// all hosts of the assignment, from the journal.
void Redo(PastHost& host, const TickRecord& record, const std::vector<ControlCommands>& commands)
{
  std::vector<const SensorFrame*> frames;
  for (const std::uint32_t engine : host.role->Layout().frames_from)
    if (!record.frames.empty()) frames.push_back(&record.frames.at(engine));
  host.role->Tick(frames);
  // The record of the last tick of a run has no commands.
  if (commands.empty()) return;
  const ControlCommands& before = commands.at(host.number);
  const ControlCommands& now = host.role->Commands();
  if (!SameBits(now.values, before.values) || now.faults != before.faults ||
      now.attributes.slots != before.attributes.slots || !SameBits(now.attributes.values, before.attributes.values))
    throw std::runtime_error(
        fmt::format("computed again, {} commands at tick {} what is not in the journal: what the run uses is not "
                    "deterministic, or changed since",
                    HostName(host.number), record.state.tick));
}

}  // namespace

RecordedRobotStates::RecordedRobotStates(const Experiment& experiment, const std::string& run_folder,
                                         std::uint64_t tick, std::span<const std::uint32_t> robots)
{
  const JournalReader journal(JournalFile(run_folder));
  const auto record = journal.RecordOf(tick);
  const auto checkpoint = record ? journal.WholeCheckpointUntil(tick, experiment, journal.Hosts()) : std::nullopt;
  const std::uint64_t end = EndTickOf(journal.Start(), journal.Places());
  if (!record || (!checkpoint && journal.FirstTick() != 0))
    throw std::runtime_error(
        record ? fmt::format("the journal begins at tick {}, and has no state that all processes saved until tick {}",
                             journal.FirstTick(), tick)
               : fmt::format("the journal has ticks {} to {}, and not {}", journal.FirstTick(), end - 1, tick));
  const std::uint64_t from = checkpoint ? checkpoint->snapshot.tick : 0;

  const Assignment assignment = MakeAssignment(experiment, journal.Hosts());
  RecordedStates states(experiment, journal, journal.Start());
  CommandsByRobot shared(states.Space(), assignment);
  std::map<std::uint32_t, std::size_t> place_of_host;
  std::vector<PastHost> hosts;
  for (const std::uint32_t robot : robots)
  {
    const auto number = static_cast<std::uint32_t>(assignment.host.at(robot));
    if (!place_of_host.try_emplace(number, hosts.size()).second) continue;
    hosts.push_back({number, std::make_unique<ControllerHost>(states.Space(), assignment, number)});
    hosts.back().role->Know(journal.FaultsFrom(from, experiment.ahead));
  }

  if (!states.Seek(from)) throw std::runtime_error(fmt::format("the journal lacks tick {}", from));
  for (PastHost& host : hosts)
    if (checkpoint)
      checkpoint->LoadPart(HostName(host.number), [&](ByteReader& state) { host.role->LoadState(state); });
  while (true)
  {
    const TickRecord& past = states.Record();
    const std::vector<ControlCommands> commands = shared.Of(journal.HostsAt(past.state.tick), past.commands);
    for (PastHost& host : hosts) Redo(host, past, commands);
    if (states.Space().GetTick() == tick) break;
    // The controllers need their sensor readings of each tick, so no tick may be missing.
    const std::uint64_t next = states.Space().GetTick() + 1;
    if (!states.Next() || states.Space().GetTick() != next)
      throw std::runtime_error(fmt::format("the journal lacks tick {}", next));
  }
  for (const std::uint32_t robot : robots)
    hosts[place_of_host.at(static_cast<std::uint32_t>(assignment.host[robot]))].role->Describe(robot,
                                                                                               robots_.emplace_back());
}

std::vector<RobotStatus> StatesInWholeRun(const Experiment& experiment, RecordedRun& run, std::uint64_t tick,
                                          std::span<const std::uint32_t> robots, const std::string& output_folder)
{
  SimulatorOptions options;
  options.output_folder = output_folder;
  options.visualisations = false;
  const std::string events = run.Folder() + "/events.csv";
  if (std::filesystem::exists(events)) options.events = events;
  while (run.Next() && run.Space().GetTick() < tick) continue;
  if (run.Space().GetTick() != tick)
    throw std::runtime_error(
        fmt::format("the journal has ticks {} to {}, and not {}", run.FirstTick(), run.LastTick(), tick));
  CSimulator simulator = WatchedSimulator::Running(experiment, options, {});
  while (simulator.GetSpace().GetTick() < tick && simulator.Step()) continue;
  if (simulator.GetSpace().Hash() != run.Space().Hash())
    throw std::runtime_error(
        fmt::format("computed again, the state of tick {} is not that of the journal: what the run uses is not "
                    "deterministic, or changed since",
                    tick));
  simulator.Step();
  std::vector<RobotStatus> found;
  for (const std::uint32_t robot : robots) WatchedSimulator::Describe(simulator, robot, found.emplace_back());
  return found;
}

}  // namespace swarmanoid
