// `swarmanoid diff`: where two runs of one experiment part.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

#include "common/activity/exit_codes.h"
#include "common/bus/recovery.h"
#include "common/space/space.h"
#include "launcher/commands.h"
#include "launcher/recorded_run.h"

namespace swarmanoid
{
namespace
{

// Whose fault the difference may be: what the robots did in the tick before, if it can be compared.
std::string CauseOf(const TickRecord& a, const TickRecord& b)
{
  if (a.commands.size() != b.commands.size()) return {};
  for (std::size_t host = 0; host < a.commands.size(); ++host)
  {
    const ControlCommands& p = a.commands[host];
    const ControlCommands& q = b.commands[host];
    if (!SameBits(p.values, q.values) || p.attributes.slots != q.attributes.slots ||
        !SameBits(p.attributes.values, q.attributes.values))
      return fmt::format("; the commands of controller host {} at the tick before differ", host);
  }
  return "; the commands of the tick before do not differ";
}

int Diff(const std::string& first, const std::string& second)
{
  RecordedRun a(first), b(second);
  if (a.Space().Size() != b.Space().Size() || a.Space().Attributes().size() != b.Space().Attributes().size())
    throw UsageError("the runs are of experiments with other entities");
  // A branch begins later, and so does what a budget has left of a journal.
  const std::uint64_t from = std::max(a.FirstTick(), b.FirstTick());
  bool more_a = a.Seek(from), more_b = b.Seek(from);
  if (!more_a || !more_b)
    throw UsageError(fmt::format("the journals have no tick in common: '{}' ends at tick {}, '{}' begins at {}",
                                 more_a ? second : first, more_a ? b.LastTick() : a.LastTick(), more_a ? first : second,
                                 from));
  TickRecord before_a, before_b;
  std::uint64_t ticks = 0;
  for (; more_a || more_b; more_a = a.Next(), more_b = b.Next())
  {
    if (more_a != more_b)
    {
      fmt::print("equal to the end of {}, at tick {}\n", more_a ? second : first, from + ticks - 1);
      return kExitHashDiffers;
    }
    if (const std::string difference = FirstDifference(a.Space(), b.Space()); !difference.empty())
    {
      fmt::print("tick {}: {}{}\n", a.Space().GetTick(), difference, ticks > 0 ? CauseOf(before_a, before_b) : "");
      return kExitHashDiffers;
    }
    before_a = a.Record();
    before_b = b.Record();
    ++ticks;
  }
  fmt::print("equal: {} states{}\n", ticks, from == 0 ? "" : fmt::format(", from tick {} on", from));
  return kExitDone;
}

}  // namespace

void AddDiffCommand(CLI::App& app, int& exit_code)
{
  auto first = std::make_shared<std::string>(), second = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("diff", "Find the first tick at which two runs differ, and in what");
  verb->add_option("RUN_A", *first, "The folder of a run as a cluster")->required();
  verb->add_option("RUN_B", *second, "The folder of another one of the same experiment")->required();
  verb->footer(
      "Exit codes: 0 all states of the journals are equal, bit by bit; 5 they differ.\n"
      "Example:\n"
      "  swarmanoid diff runs/diffusion_10-20310517-093000 runs/diffusion_10-20310517-094500");
  verb->callback([first, second, &exit_code] { exit_code = Diff(*first, *second); });
}

}  // namespace swarmanoid
