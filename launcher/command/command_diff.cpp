// `swarmanoid diff`: finds where two runs of one experiment begin to differ.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>

#include "common/errors/exit_codes.h"
#include "common/journal/commands_by_robot.h"
#include "common/space/space.h"
#include "common/space/state_checks.h"
#include "launcher/command/sub_command.h"
#include "simulation/playback/recorded_run.h"

namespace swarmanoid
{
namespace
{

// Returns the first robot with other commands, or nothing. The commands must be of one host that has all robots.
std::optional<std::uint32_t> OtherCommands(const CSwarmanoidSpace& space, const HostLayout& layout,
                                           const ControlCommands& a, const ControlCommands& b)
{
  for (const ChannelBlock& block : layout.commands)
    for (std::size_t k = 0; k < block.entities.size(); ++k)
    {
      const auto width = static_cast<std::size_t>(block.width);
      const std::size_t from = block.offset + k * width;
      if (std::memcmp(&a.values[from], &b.values[from], width * sizeof(double)) != 0) return block.entities[k];
    }
  const auto& p = a.attributes;
  const auto& q = b.attributes;
  for (std::size_t i = 0; i < std::max(p.slots.size(), q.slots.size()); ++i)
  {
    if (i < p.slots.size() && i < q.slots.size() && p.slots[i] == q.slots[i] &&
        std::memcmp(&p.values[i], &q.values[i], sizeof(double)) == 0)
      continue;
    return EntityOfSlot(space, i < p.slots.size() ? p.slots[i] : q.slots[i]);
  }
  return std::nullopt;
}

// Returns the likely cause of the difference: the commands of the robots in the tick before, if they can be compared.
std::string CauseOf(const RecordedRun& a, const TickRecord& of_a, const RecordedRun& b, const TickRecord& of_b)
{
  if (of_a.commands.empty() || of_b.commands.empty()) return {};
  // A damaged journal may not have the controller hosts of the commands.
  if (!a.Journal().KnowsHostsAt(of_a.state.tick) || !b.Journal().KnowsHostsAt(of_b.state.tick)) return {};
  const auto of_one_host = [](const RecordedRun& run, const TickRecord& record, const Assignment& one)
  { return CommandsByRobot(run.Space(), one).Of(run.Journal().HostsAt(record.state.tick), record.commands).front(); };
  const Assignment all_of_a = MakeAssignment(a.GetExperiment(), 1);
  const ControlCommands p = of_one_host(a, of_a, all_of_a);
  const ControlCommands q = of_one_host(b, of_b, MakeAssignment(b.GetExperiment(), 1));
  // The runs have other controllers or devices, so their commands cannot be compared.
  if (p.values.size() != q.values.size()) return {};
  const auto robot = OtherCommands(a.Space(), all_of_a.hosts.front(), p, q);
  return robot ? fmt::format("; the commands of '{}' at the tick before differ", a.Space().GetEntity(*robot).GetId())
               : "; the commands of the tick before do not differ";
}

int Diff(const std::string& first, const std::string& second)
{
  RecordedRun a(first), b(second);
  PrintLoss(a.Loss());
  PrintLoss(b.Loss());
  if (a.Space().Size() != b.Space().Size() || a.Space().Attributes().size() != b.Space().Attributes().size())
    throw UsageError("the runs are of experiments with other entities");
  // A branch begins later, and so does a journal that has lost its oldest segments to a budget.
  const std::uint64_t from = std::max(a.FirstTick(), b.FirstTick());
  bool more_a = a.SeekFrom(from), more_b = b.SeekFrom(from);
  if (!more_a || !more_b)
    throw UsageError(fmt::format("the journals have no tick in common: '{}' ends at tick {}, '{}' begins at {}",
                                 more_a ? second : first, more_a ? b.LastTick() : a.LastTick(), more_a ? first : second,
                                 from));
  std::optional<TickRecord> before_a, before_b;  // records of the tick before, if both runs have it
  std::uint64_t ticks = 0, last = from;
  while (more_a && more_b)
  {
    const std::uint64_t tick_a = a.Space().GetTick(), tick_b = b.Space().GetTick();
    if (tick_a != tick_b)
    {
      // One of the journals is damaged at this tick.
      before_a.reset();
      if (tick_a < tick_b)
        more_a = a.Next();
      else
        more_b = b.Next();
      continue;
    }
    if (const std::string difference = FirstDifference(a.Space(), b.Space()); !difference.empty())
    {
      fmt::print("tick {}: {}{}\n", a.Space().GetTick(), difference,
                 before_a && before_a->state.tick + 1 == tick_a ? CauseOf(a, *before_a, b, *before_b) : "");
      return kExitHashDiffers;
    }
    before_a = a.Record();
    before_b = b.Record();
    last = tick_a;
    ++ticks;
    more_a = a.Next();
    more_b = b.Next();
  }
  if (more_a != more_b)
  {
    fmt::print("equal to the end of {}, at tick {}\n", more_a ? second : first, last);
    return kExitHashDiffers;
  }
  fmt::print("equal: {} states{}\n", ticks, from == 0 ? "" : fmt::format(", from tick {} on", from));
  return a.ExitCode(b.ExitCode(kExitDone));
}

void AddDiffCommand(CLI::App& app, int& exit_code)
{
  auto first = std::make_shared<std::string>(), second = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("diff", "Find the first tick at which two runs differ, and in what");
  verb->add_option("RUN_A", *first, "The folder of a run as a cluster")->required();
  verb->add_option("RUN_B", *second, "The folder of another one of the same experiment")->required();
  verb->footer(
      "Exit codes: 0 all states of the journals are equal, bit by bit; 4 a journal is damaged; 5 they differ.\n"
      "Example:\n"
      "  swarmanoid diff runs/diffusion_10-20310517-093000 runs/diffusion_10-20310517-094500");
  verb->callback([first, second, &exit_code] { exit_code = Diff(*first, *second); });
}

const RegisterSubCommand kDiff(4, "diff", AddDiffCommand);

}  // namespace
}  // namespace swarmanoid
