// `swarmanoid adopt`: takes over a run whose launcher has gone.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>

#include "common/activity/exit_codes.h"
#include "common/activity/print_error.h"
#include "common/bus/bus.h"
#include "common/bus/run_directory.h"
#include "common/configuration/wording.h"
#include "launcher/attended_run.h"
#include "launcher/commands.h"
#include "launcher/processes/progress_display.h"
#include "launcher/run_folder.h"
#include "launcher/supervised_runs.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr int kPatience_ms = 5000;

std::string Commands(const std::vector<SupervisedRun>& runs)
{
  std::string text;
  for (const SupervisedRun& run : runs) text += fmt::format("\n  swarmanoid adopt {}", run.folder);
  return text;
}

SupervisedRun OnlyOrphan()
{
  std::vector<SupervisedRun> runs = FindSupervisedRuns();
  std::erase_if(runs, [](const SupervisedRun& run) { return !run.orphaned_s; });
  if (runs.empty()) throw UsageError("adopt: no run of this machine has lost its launcher");
  if (runs.size() > 1)
    throw UsageError(fmt::format("adopt: several runs have lost their launcher; name one:{}", Commands(runs)));
  return runs.front();
}

// Why nobody supervises the run of this folder, on this machine.
[[noreturn]] void RefuseAbandoned(const std::string& folder)
{
  if (!fs::exists(folder + "/manifest.json"))
    throw UsageError(
        fmt::format("adopt: {} is no folder of a run: it has no manifest.json; `swarmanoid list experiments` names the "
                    "runs of this machine that have no launcher",
                    Quoted(folder)));
  nlohmann::json manifest;
  try
  {
    manifest = ReadManifest(folder);
  }
  catch (const std::exception& error)
  {
    throw UsageError(fmt::format("adopt: the manifest of the run {} cannot be read: {}", Quoted(folder), error.what()));
  }
  if (!manifest.is_object()) manifest = nlohmann::json::object();
  const auto text = [&](const char* name)
  { return manifest.contains(name) && manifest[name].is_string() ? manifest[name].get<std::string>() : std::string(); };
  if (manifest.contains("exit_code"))
    throw UsageError(fmt::format("adopt: the run {} has ended already, at {}, with exit code {}{}", Quoted(folder),
                                 text("ended"), manifest["exit_code"].dump(),
                                 manifest["exit_code"] == 0 ? "" : "; to go on with it: swarmanoid resume " + folder));
  if (!text("host").empty() && text("host") != MachineName())
    throw UsageError(fmt::format("adopt: the run {} was started on {}, and this is {}; adopt it there", Quoted(folder),
                                 Quoted(text("host")), Quoted(MachineName())));
  if (!manifest.contains("domain"))
    throw UsageError(
        fmt::format("adopt: the run {} is no cluster: it goes on, or died, with its one process", Quoted(folder)));
  for (const LocalRun& run : FindLocalRuns())
    if (run.experiment == text("experiment") && manifest["domain"] == run.domain)
      throw UsageError(fmt::format(
          "adopt: the run {} goes on with its launcher, and ends with it: it has --orphan-timeout 0, or is a "
          "simulator of its own",
          Quoted(folder)));
  throw UsageError(
      fmt::format("adopt: the run {} died with all of its processes; to go on with it: swarmanoid resume {}",
                  Quoted(folder), folder));
}

SupervisedRun Named(const std::string& named)
{
  std::error_code none;
  const fs::path folder = fs::weakly_canonical(named, none);
  for (const SupervisedRun& run : FindSupervisedRuns())
    if (fs::weakly_canonical(run.folder, none) == folder) return run;
  RefuseAbandoned(folder);
}

[[noreturn]] void RefuseAttended(const SupervisedRun& run)
{
  throw UsageError(fmt::format("adopt: the run {} still has its launcher, process {} on {}", Quoted(run.folder),
                               run.launcher, MachineName()));
}

int Adopt(const std::string& named, bool quiet)
{
  const SupervisedRun run = named.empty() ? OnlyOrphan() : Named(named);
  if (!run.orphaned_s) RefuseAttended(run);
  Interrupts interrupts;
  auto link = ConsoleLink::To(ConsoleSocketOf(run.supervisor));
  if (!link || !link->Send({{"adopt", quiet}}, {STDOUT_FILENO, STDERR_FILENO}) || !link->Wait(kPatience_ms))
    RefuseAbandoned(run.folder);
  const auto answer = link->Receive();
  const auto now = answer && answer->message ? ReadSupervisedRun(*answer->message) : std::nullopt;
  if (!now) RefuseAbandoned(run.folder);
  if (!answer->message->value("adopted", false))
  {
    if (!now->orphaned_s) RefuseAttended(*now);
    throw UsageError(
        fmt::format("adopt: the time of the run {} is over: it is ending; to go on with it: swarmanoid "
                    "resume {}",
                    Quoted(run.folder), run.folder));
  }
  const Attended attended = Attend(*link, interrupts);
  if (attended.exit_code) return *attended.exit_code;
  PrintError(
      "the process that supervises the run was killed, and the run with it; to go on with it: swarmanoid resume {}\n",
      run.folder);
  return kExitProcessFailed;
}

}  // namespace

void AddAdoptCommand(CLI::App& app, int& exit_code)
{
  struct AdoptOptions
  {
    std::string folder;
    bool quiet = false;
  };
  auto options = std::make_shared<AdoptOptions>();
  CLI::App* verb = app.add_subcommand("adopt", "Take over a run whose launcher has gone");
  verb->add_option("RUN", options->folder, "The folder of the run; otherwise the only one that has lost its launcher");
  verb->add_flag("--quiet", options->quiet, "Show no progress");
  verb->footer(
      "A run as a cluster goes on for a while (run --orphan-timeout) if its launcher is killed, or the terminal or the "
      "connection of it is lost. From now on this is its terminal: what the run says comes here, Ctrl-C is for it, and "
      "its exit code is that of this command.\n"
      "Examples:\n"
      "  swarmanoid adopt\n"
      "  swarmanoid adopt runs/diffusion_10-20310517-093000\n"
      "  swarmanoid list experiments                          which have no launcher?");
  verb->callback([options, &exit_code] { exit_code = Adopt(options->folder, options->quiet); });
}

}  // namespace swarmanoid
