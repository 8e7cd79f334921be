#include "simulation/playback/recorded_robot_states.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "common/journal/commands_by_robot.h"
#include "common/journal/journal_reader.h"
#include "common/journal/recorded_states.h"
#include "common/space/space.h"
#include "controller_host/controller_host.h"

namespace swarmanoid
{
namespace
{

struct PastHost
{
  std::size_t number;
  std::unique_ptr<ControllerHost> role;
};

// As a process does that takes the place of a controller host. `commands`: what these hosts, all of them, commanded.
void Redo(PastHost& host, const TickRecord& record, const std::vector<ControlCommands>& commands)
{
  std::vector<const SensorFrame*> frames;
  for (const std::uint32_t engine : host.role->Layout().frames_from)
    if (!record.frames.empty()) frames.push_back(&record.frames.at(engine));
  host.role->Tick(frames);
  // None at the last tick of a run.
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
    // The controllers need what they sensed at each tick.
    const std::uint64_t next = states.Space().GetTick() + 1;
    if (!states.Next() || states.Space().GetTick() != next)
      throw std::runtime_error(fmt::format("the journal lacks tick {}", next));
  }
  for (const std::uint32_t robot : robots)
    hosts[place_of_host.at(static_cast<std::uint32_t>(assignment.host[robot]))].role->Describe(robot,
                                                                                               robots_.emplace_back());
}

}  // namespace swarmanoid
