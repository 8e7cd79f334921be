// `swarmanoid replay`: shows the journal of a run, or computes the run again and compares.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>

#include "common/configuration/output_file.h"
#include "common/errors/exit_codes.h"
#include "common/messages/assignment.h"
#include "common/program/interrupts.h"
#include "common/program/trust_flag.h"
#include "common/space/space.h"
#include "launcher/command/renderer_words.h"
#include "launcher/command/sub_command.h"
#include "launcher/replay_monitor.h"
#include "launcher/supervision/progress_display.h"
#include "launcher/system/scratch_folder.h"
#include "simulation/load.h"
#include "simulation/playback/recorded_run.h"
#include "simulation/watched_simulator.h"
#include "visualiser/renderer_options.h"
#include "visualiser/visualiser.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

struct ReplayOptions
{
  std::string run;
  std::string kind;
  std::vector<std::string> words;       // name=value
  std::vector<std::string> parameters;  // the same of options
  std::string output = ".";
  std::optional<std::uint64_t> from;
  double speed = 0;
  bool verify = false;
};

// Computes the run again in this process, with the requests of its users, and compares the states with those of the
// journal.
int Verify(RecordedRun& run)
{
  // The users' libraries are loaded, since the run is computed again.
  const auto experiment = LoadOrComplain(run.Folder() + "/experiment.xml", {});
  if (!experiment) return kExitInvalidFile;
  const ScratchFolder scratch;
  SimulatorOptions options;
  options.output_folder = scratch.Path();
  options.visualisations = false;
  const std::string events = run.Folder() + "/events.csv";
  if (std::filesystem::exists(events)) options.events = events;
  options.faults_of = run.Folder();
  if (const std::uint64_t first = run.FirstTick(); first != 0)
  {
    const JournalReader& journal = run.Journal();
    const auto checkpoint = journal.WholeCheckpointAt(first, *experiment, journal.Hosts());
    if (!checkpoint)
      throw UsageError(
          fmt::format("--verify: the journal begins at tick {}, and no run can go on from there: not all "
                      "processes saved their states",
                      first));
    options.restore_file = scratch.Path() + "/" + CheckpointName(first);
    WriteCheckpoint(options.restore_file, *checkpoint);
  }
  std::uint64_t ticks = 0;
  WorkProgress progress("computing again", run.LastTick() + 1 - run.FirstTick());
  bool over = !run.Next();
  std::string difference;
  const auto compare = [&](const CSimulator& simulator)
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    while (!over && run.Space().GetTick() < space.GetTick()) over = !run.Next();
    // Lost ticks are computed, but not compared.
    if (over || run.Space().GetTick() != space.GetTick()) return;
    progress.At(++ticks);
    if (space.Hash() != run.Space().Hash())
      difference = fmt::format("tick {}: {}", space.GetTick(), FirstDifference(run.Space(), space));
  };
  CSimulator simulator = WatchedSimulator::Running(*experiment, options, {.watch = compare});
  while (!over && difference.empty() && !Interrupted() && simulator.Step()) continue;
  progress.Clear();
  if (!difference.empty())
  {
    fmt::print("{} (in the journal, and computed again)\n", difference);
    return kExitHashDiffers;
  }
  if (Interrupted()) return kExitInterrupted;
  fmt::print("equal: {} states, computed again\n", ticks);
  return kExitDone;
}

int Show(RecordedRun& run, const ReplayOptions& options)
{
  LetUserNameFiles();
  std::vector<std::string> parameters = options.words;
  parameters.insert(parameters.end(), options.parameters.begin(), options.parameters.end());
  const RenderConfiguration configuration = ConfigureRenderer(FindRenderer(options.kind), parameters);
  const Assignment assignment = MakeAssignment(run.GetExperiment(), 1);
  const std::uint64_t from = std::max(options.from.value_or(0), run.FirstTick());
  if (options.from && *options.from < from)
    throw UsageError(fmt::format("--from: the journal begins at tick {}{}", from,
                                 run.Journal().StartAsFarAsKnown().first_tick == from
                                     ? ", where the run did"
                                     : "; what was before is more than its --journal-budget"));
  bool more = run.SeekFrom(from);
  if (!more) throw UsageError(fmt::format("--from: the journal ends before tick {}", from));
  ReplayMonitor monitor(run);
  Visualiser visualiser(configuration, run.Space(), assignment, options.output, nullptr, &monitor);
  const double speed = visualiser.IsInteractive() && options.speed == 0 ? 1 : options.speed;
  bool closed = false;
  auto due = Clock::now();
  for (; more && !closed && !Interrupted(); more = run.Next())
  {
    monitor.Shown(speed, Clock::now());
    closed = visualiser.Draw();
    if (speed > 0)
      due += std::chrono::duration_cast<Clock::duration>(
          std::chrono::duration<double>(run.GetExperiment().TickSeconds() / speed));
    while (!closed && Clock::now() < due && !Interrupted())
    {
      closed = visualiser.Idle();
      std::this_thread::sleep_until(std::min(due, Clock::now() + 15ms));
    }
  }
  monitor.Ended();
  while (visualiser.IsInteractive() && !closed && !Interrupted())
  {
    closed = visualiser.Idle();
    std::this_thread::sleep_for(15ms);
  }
  visualiser.Finish();
  return Interrupted() ? kExitInterrupted : kExitDone;
}

int Replay(ReplayOptions options)
{
  RegisterBuiltins();
  CatchInterrupts();
  if (options.kind.empty() && !options.verify) options.kind = "web";
  if (options.verify && !options.kind.empty())
    throw UsageError(fmt::format("--verify shows nothing: leave out it or {}", Quoted(options.kind)));
  RecordedRun run(std::filesystem::absolute(options.run).lexically_normal().string());
  try
  {
    PrintLoss(run.Loss());
    return run.ExitCode(options.verify ? Verify(run) : Show(run, options));
  }
  catch (const ConfigurationError& error)
  {
    throw UsageError(error.what());
  }
}

void AddReplayCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* verb = app.add_subcommand("replay", "Show a run again from its journal, or compute it again and compare");
  verb->add_option("RUN", options->run, "The folder of a run as a cluster")->required();
  verb->add_option("KIND", options->kind,
                   "text, image, figure, opengl, ogre, web (the default), ros2 or foxglove, as for `attach`");
  verb->add_option("PARAMETERS", options->words, "name=value for the visualiser");
  verb->add_flag("--verify", options->verify,
                 "Compute all ticks again, in this process, and name the first entity that differs, and in what");
  verb->add_option("--from", options->from, "The first tick that is shown");
  verb->add_option("--speed", options->speed,
                   "Multiple of real time; 0: as fast as possible, for windows and pages real time")
      ->check(CLI::Range(0.0, 1e6));
  verb->add_option("--output", options->output, "Folder for relative output files");
  AddTrustFlag(*verb);
  AddOptionsOfKind(*verb, 1, options->parameters);
  verb->footer(
      "`swarmanoid replay RUN KIND --help` lists the options of that kind too. No controller and no engine runs, "
      "unless --verify is given: for the inside of robots see `swarmanoid inspect`.\n"
      "Exit codes of --verify: 0 all states are equal, 4 the journal is damaged, 5 they differ.\n"
      "Examples:\n"
      "  swarmanoid replay runs/latest                              on a page\n"
      "  swarmanoid replay runs/latest --verify\n"
      "  swarmanoid replay runs/diffusion_10-20310517-093000 web --speed 2\n"
      "  swarmanoid replay runs/diffusion_10-20310517-093000 image --video film.mp4 --from 500\n"
      "  swarmanoid replay runs/diffusion_10-20310517-093000 figure --file figure.pdf --show-trails");
  verb->callback([options, &exit_code] { exit_code = Replay(*options); });
}

const RegisterSubCommand kReplay(3, "replay", AddReplayCommand);

}  // namespace
}  // namespace swarmanoid
