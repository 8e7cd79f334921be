// A journal has the states that processes have saved at some ticks only. A branch computes the run again from the
// nearest one up to the wanted tick, with the recorded events and faults. It compares the result with the journal. A
// child process does this, because the code of users runs in it.
//
// Invariant: a branch without changes has the bits of the run that it comes from. If the state of its tick cannot be
// saved unchanged, it starts from an earlier one and repeats the ticks between.
#include "launcher/branch.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/activity/failure_report.h"
#include "common/checkpoint/library_builds.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/program/shell_word.h"
#include "common/program/usage_error.h"
#include "common/space/space.h"
#include "launcher/supervision/single_run.h"
#include "simulation/load.h"
#include "simulation/playback/recorded_run.h"
#include "simulation/watched_simulator.h"
#include "space_server/event_log.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* kStateFile = "state";
constexpr const char* kEventsFile = "branch_events.csv";

[[noreturn]] void RefuseBranch(const std::string& text) { throw UsageError("--branch: " + text); }

void WriteText(const std::string& path, const std::string& text)
{
  if (!(std::ofstream(path) << text << std::flush))
    throw std::runtime_error(fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
}

void RequireTick(RecordedRun& run, const BranchRequest& request)
{
  const std::uint64_t last = run.LastTick();
  if (request.tick < run.FirstTick() || request.tick > last)
    RefuseBranch(fmt::format("the journal of '{}' has ticks {} to {}, and not {}", request.run, run.FirstTick(), last,
                             request.tick));
  const auto record = run.Journal().RecordOf(request.tick);
  if (!record || !run.Seek(request.tick))
    RefuseBranch(fmt::format("the journal of '{}' lacks tick {}", request.run, request.tick));
  if (record->state.last)
    RefuseBranch(fmt::format("'{}' ended at tick {}; the last one to branch off is {}", request.run, last, last - 1));
}

void RequireBuilds(const JournalStart& start, const Experiment& experiment, bool any_build)
{
  const std::string difference = DifferenceOfBuilds(start.origin.libraries, LibraryBuildsOf(experiment));
  if (difference.empty() || any_build) return;
  RefuseBranch("the run was made by " + difference +
               "; branch with that build, run it again with this one, or let --any-build take it");
}

// The result of the child, for the process that runs the branch.
struct ComputedState
{
  std::uint64_t hash = 0;
  std::optional<Checkpoint> checkpoint;  // none: only the first tick can be used
};

// Computes the state of the tick. If it cannot be saved unchanged and `exactly` forbids a change, computes the newest
// earlier state that can be saved.
ComputedState ComputeState(RecordedRun& run, const Experiment& experiment, const SimulatorOptions& options,
                           unsigned hosts, std::uint64_t tick, bool exactly)
{
  CSimulator simulator = WatchedSimulator::Computing(experiment, options, hosts);
  ComputedState found;
  std::string trouble;
  const auto save = [&](bool canonicalise)
  {
    try
    {
      found.checkpoint = WatchedSimulator::CheckpointOf(simulator, canonicalise);
    }
    catch (const std::exception& error)
    {
      trouble = error.what();
    }
  };
  const std::uint64_t canonical = tick - tick % experiment.canonical_period;
  const auto now = [&] { return simulator.GetSpace().GetTick(); };
  const std::uint64_t first = now();
  for (bool more = true; more && now() < tick; more = simulator.Step())
    if (!exactly && (now() == canonical || now() == first)) save(false);
  if (now() != tick || !run.Seek(tick)) throw std::runtime_error(fmt::format("it ended at tick {}", now()));
  if (const std::string difference = FirstDifference(run.Space(), simulator.GetSpace()); !difference.empty())
    throw std::runtime_error(
        fmt::format("computed again, tick {} differs from the journal: {} (in the journal, and computed); what the run "
                    "uses is not deterministic, or changed since; `swarmanoid replay {} --verify` names the first tick",
                    tick, difference, ShellWord(run.Folder())));
  found.hash = simulator.GetSpace().Hash();
  const bool canonical_now = WatchedSimulator::IsCanonical(simulator);
  if (canonical_now || exactly) save(!canonical_now);
  if (!found.checkpoint && exactly) throw std::runtime_error(trouble);
  return found;
}

}  // namespace

std::optional<BranchRequest> ReadRunAtTick(const std::string& text)
{
  constexpr std::size_t kMostDigits = 18;
  const std::size_t sign = text.rfind('@');
  if (sign == std::string::npos || sign == 0 || sign + 1 == text.size() || text.size() - sign - 1 > kMostDigits ||
      text.find_first_not_of("0123456789", sign + 1) != std::string::npos)
    return std::nullopt;
  const std::string folder = fs::absolute(text.substr(0, sign)).lexically_normal().string();
  return BranchRequest{folder, std::stoull(text.substr(sign + 1))};
}

BranchRequest ReadBranchRequest(const std::string& text)
{
  const auto request = ReadRunAtTick(text);
  if (!request) RefuseBranch(fmt::format("'{}' is no run and tick; for example --branch runs/first@500", text));
  return *request;
}

RunRequest RequestOfBranch(const RunRequest& request)
{
  const BranchRequest branch = ReadBranchRequest(request->branch);
  const RecordedRun run(branch.run);
  return request.With(
      [&](RunSettings& settings)
      {
        if (settings.file.empty()) settings.file = branch.run + "/experiment.xml";
        if (!settings.single_process && settings.controller_hosts == 1)
          settings.controller_hosts = run.Journal().Hosts().hosts;
      });
}

Branch::Branch(const RunSettings& settings, const Experiment& experiment) : request_(ReadBranchRequest(settings.branch))
{
  const auto before = LoadOrComplain(request_.run + "/experiment.xml", {});
  if (!before) RefuseBranch(fmt::format("the experiment of '{}' cannot be read", request_.run));
  changes_ = ChangesBetween(*before, experiment);
  matters_ = std::any_of(changes_.begin(), changes_.end(), [](const BranchChange& change) { return change.matters; });
  same_fingerprint_ = FingerprintOf(*before) == FingerprintOf(experiment);
  {
    RecordedRun run(request_.run);
    PrintLoss(run.Loss());
    RequireTick(run, request_);
    RequireBuilds(run.Journal().Start(), *before, settings.any_build);
  }
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(std::string("cannot start a process: ") + std::strerror(errno));
  if (child == 0)
  {
    dup2(STDERR_FILENO, STDOUT_FILENO);
    int code = kExitProcessFailed;
    try
    {
      Compute(settings, *before);
      // The controllers and engines of the changed experiment may find that the state does not fit them.
      if (matters_ && fs::exists(scratch_.Path() + "/" + kStateFile))
      {
        Checkpoint state = ReadCheckpoint(scratch_.Path() + "/" + kStateFile, *before,
                                          {settings.controller_hosts, settings.any_build});
        state.origin = OriginOf(experiment);
        SimulatorOptions options;
        options.output_folder = scratch_.Path();
        options.visualisations = false;
        options.restore_file = scratch_.Path() + "/changed";
        WriteCheckpoint(options.restore_file, state);
        WatchedSimulator::Computing(experiment, options, settings.controller_hosts);
      }
      code = kExitDone;
    }
    catch (const std::exception& error)
    {
      PrintError("swarmanoid: --branch: {}\n", error.what());
    }
    std::fflush(nullptr);
    LeaveAtOnce(code);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : static_cast<int>(kExitProcessFailed);
  if (exit_code_ != kExitDone) return;
  std::ifstream(scratch_.Path() + "/found") >> hash_ >> first_tick_;
}

// Computes the state in the child process.
void Branch::Compute(const RunSettings& settings, const Experiment& experiment)
{
  ApplyLimitsHere(settings);
  RecordedRun run(request_.run);
  const JournalReader& journal = run.Journal();
  SimulatorOptions options;
  options.output_folder = scratch_.Path() + "/again";
  fs::create_directory(options.output_folder);
  options.visualisations = false;
  options.threads = settings.threads;
  options.any_build = settings.any_build;
  options.faults_of = request_.run;
  std::uint64_t from = 0;
  if (auto nearest = journal.WholeCheckpointUntil(request_.tick, experiment, journal.Hosts()))
  {
    from = nearest->snapshot.tick;
    options.restore_file = scratch_.Path() + "/nearest";
    WriteCheckpoint(options.restore_file, *nearest);
  }
  else if (journal.FirstTick() != 0)
    throw std::runtime_error(
        fmt::format("the journal begins at tick {}, and has no state that all processes saved until tick {}",
                    journal.FirstTick(), request_.tick));
  options.events = scratch_.Path() + "/events.csv";
  WriteText(options.events, EventsBetween(from, request_.tick, request_.run + "/events.csv"));
  const ComputedState found =
      ComputeState(run, experiment, options, settings.controller_hosts, request_.tick, matters_);
  if (found.checkpoint) WriteCheckpoint(scratch_.Path() + "/" + kStateFile, *found.checkpoint);
  WriteText(scratch_.Path() + "/found",
            fmt::format("{} {}\n", found.hash, found.checkpoint ? found.checkpoint->snapshot.tick : 0));
}

// Returns the lines of events after a tick. Events of the first tick of a run come before its state, so 0 includes
// them.
std::string Branch::EventsBetween(std::uint64_t after, std::uint64_t last, const std::string& file) const
{
  const EventLines events = ReadEventLines(file);
  if (!events.damaged.empty()) throw ConfigurationError(events.damaged.front());
  std::string text;
  for (const auto& [tick, line] : events.lines)
    if ((tick > after || after == 0) && tick <= last) text += line + "\n";
  return text;
}

void Branch::Install(RunSettings& settings, const Experiment& experiment, const std::string& folder) const
{
  std::string events = first_tick_ < request_.tick
                           ? EventsBetween(first_tick_, request_.tick, request_.run + "/events.csv")
                           : std::string();
  if (!settings.events.empty()) events += EventsBetween(request_.tick, UINT64_MAX, settings.events);
  settings.events = folder + "/" + kEventsFile;
  WriteText(settings.events, events);
  // The recorded faults replace measurements of time. With a changed experiment, the faults of this run are unknown.
  if (same_fingerprint_) settings.faults_of = request_.run;
  const std::string state = scratch_.Path() + "/" + kStateFile;
  if (!fs::exists(state)) return;
  Checkpoint checkpoint = DecodeCheckpoint(
      [&]
      {
        std::ifstream file(state, std::ios::binary);
        return std::vector<char>(std::istreambuf_iterator<char>(file), {});
      }());
  checkpoint.origin = OriginOf(experiment);
  settings.restore_file = folder + "/" + CheckpointName(first_tick_);
  WriteCheckpoint(settings.restore_file, checkpoint);
}

}  // namespace swarmanoid
