// Each run is executed in a copy of the process (fork), after the experiment was loaded: a crash of a library, a signal
// or a limit of memory ends this run alone, and the study records why. The copy writes its outcome into a file in
// memory that both processes share; an outcome that is cut off counts as a failure, with the last line of the log as
// its reason. If the study dies, its runs are killed (PR_SET_PDEATHSIG).
//
// A run uses one thread, since the cores of the machine execute runs side by side. Its numbers depend only on the
// experiment, the settings and the seed, so it may be repeated anywhere.
#include "studies/runs/run_order.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/activity/failure_report.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/limits/limits.h"
#include "common/logging/log.h"
#include "common/program/usage_error.h"
#include "launcher/simulation.h"
#include "simulation/register_all.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* kLogOfRun = "log.txt";

LoadOptions ChangesFor(const RunOrder& order)
{
  LoadOptions changes;
  changes.settings = order.settings;
  changes.settings.emplace_back("framework.seed", std::to_string(order.name.seed));
  return changes;
}

void RunHereMeasured(const Study& study, const std::string& folder, const Experiment& experiment, RunOutcome& outcome)
{
  OpenLog({.process = "swarmanoid", .folder = folder});
  Recorder recorder(study, experiment);
  SimulatorOptions options;
  options.output_folder = folder;
  options.visualisations = study.visualisations;
  options.threads = 1;  // the other cores execute their own runs
  CSimulator simulator(experiment, options);
  do recorder.Look(simulator);
  while (simulator.Step());
  recorder.LookLast(simulator);
  const RunSummary& summary = simulator.Finish();
  outcome.exit_code = summary.failed ? kExitExperimentFailed : kExitDone;
  outcome.ticks = summary.ticks;
  outcome.hash = summary.hash;
  outcome.samples = recorder.Take();
}

void RunClusterMeasured(const Study& study, const std::string& folder, const RunOrder& order,
                        const Experiment& experiment, RunOutcome& outcome)
{
  const std::string own = folder + "/cluster";
  std::vector<std::string> words{"swarmanoid", order.experiment, "--output", own, "--quiet"};
  for (const auto& [path, value] : ChangesFor(order).settings) words.insert(words.end(), {"--set", path + "=" + value});
  if (!study.visualisations) words.emplace_back("--no-visualisers");
  words.insert(words.end(), {"--controller-hosts", std::to_string(study.controller_hosts)});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  Recorder recorder(study, experiment);
  outcome.exit_code = RunSimulation(static_cast<int>(arguments.size()), arguments.data(),
                                    [&](CSimulator& simulator)
                                    {
                                      recorder.Look(simulator);
                                      recorder.LookLast(simulator);
                                    });
  if (!outcome.IsDone()) return;
  std::ifstream file(own + "/manifest.json");
  const nlohmann::json manifest = nlohmann::json::parse(file);
  outcome.ticks = manifest.at("ticks").get<std::uint64_t>();
  outcome.hash = std::stoull(manifest.at("state_hash").get<std::string>(), nullptr, 16);
  outcome.samples = recorder.Take();
}

// Runs in the copy of the process. Mistakes go to standard error, which is the log of the run.
[[noreturn]] void RunAndLeave(const Study& study, const std::string& folder, const RunOrder& order,
                              const Experiment& experiment, int log, int result)
{
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  RunOutcome outcome;
  outcome.name = order.name;
  const auto failed = [&](int code, const std::string& text)
  {
    PrintError("{}\n", text);
    outcome.exit_code = code;
    outcome.failure = text;
  };
  try
  {
    ReportDeaths("swarmanoid");
    ApplyLimits(LimitsOfEnvironment());
    if (study.cluster)
      RunClusterMeasured(study, folder, order, experiment, outcome);
    else
      RunHereMeasured(study, folder, experiment, outcome);
  }
  catch (const UsageError& error)
  {
    failed(kExitUsage, error.what());
  }
  catch (const ConfigurationError& error)
  {
    failed(kExitInvalidFile, error.what());
  }
  catch (const std::exception& error)
  {
    failed(kExitProcessFailed, error.what());
  }
  ByteWriter bytes;
  WriteFields(bytes, outcome);
  const bool told = WriteAll(result, {bytes.Bytes().data(), bytes.Bytes().size()});
  LeaveAtOnce(told ? kExitDone : kExitProcessFailed);
}

// Returns the last non-empty line of the log.
std::string LastLineOf(const std::string& path)
{
  std::ifstream file(path);
  std::string last;
  for (std::string line; std::getline(file, line);)
    if (!line.empty()) last = line;
  return last.substr(0, 1000);
}

// Reads an outcome; returns false if the process did not write it completely.
bool ReadOutcome(int result, RunOutcome& outcome)
{
  const off_t size = lseek(result, 0, SEEK_END);
  std::vector<char> bytes(size > 0 ? static_cast<std::size_t>(size) : 0);
  std::size_t got = 0;
  while (got < bytes.size())
  {
    const ssize_t more = pread(result, bytes.data() + got, bytes.size() - got, static_cast<off_t>(got));
    if (more <= 0) return false;
    got += static_cast<std::size_t>(more);
  }
  try
  {
    ByteReader reader(bytes);
    outcome = ReadFields<RunOutcome>(reader);
    return reader.AtEnd();
  }
  catch (const std::runtime_error&)
  {
    return false;
  }
}

// Keeps the files of the run: those of functions and visualisations, logs of controllers, and the reason of a failure.
void Tidy(const std::string& folder, bool done)
{
  std::error_code none;
  for (const char* log : {kLogOfRun, "swarmanoid.log"})
  {
    const fs::path path = fs::path(folder) / log;
    if (done && fs::file_size(path, none) == 0) fs::remove(path, none);
  }
  rmdir(folder.c_str());  // removes the folder only if it is empty
}

void RunLoaded(const Study& study, const std::string& folder, const RunOrder& order, const Experiment& experiment,
               RunOutcome& outcome)
{
  const std::string log_path = folder + "/" + kLogOfRun;
  const int log = open(log_path.c_str(), O_CREAT | O_WRONLY | O_APPEND | O_CLOEXEC, 0666);
  const int result = memfd_create("run", MFD_CLOEXEC);
  // The process of each run is a copy of this one.
  LoadEnginesOf(experiment);
  const pid_t process = log < 0 || result < 0 ? -1 : fork();
  if (process == 0) RunAndLeave(study, folder, order, experiment, log, result);
  if (process < 0)
  {
    outcome.exit_code = kExitProcessFailed;
    outcome.failure = fmt::format("cannot start a process with the log '{}': {}", log_path, std::strerror(errno));
  }
  else
  {
    int status = 0;
    rusage usage{};
    while (wait4(process, &status, 0, &usage) < 0 && errno == EINTR) continue;
    if (WIFSIGNALED(status))
    {
      outcome.exit_code = 128 + WTERMSIG(status);
      outcome.failure =
          fmt::format("the process was killed by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
    }
    else if (!ReadOutcome(result, outcome))
    {
      outcome.exit_code = WEXITSTATUS(status) == 0 ? static_cast<int>(kExitProcessFailed) : WEXITSTATUS(status);
      outcome.failure = LastLineOf(log_path);
    }
    if (!outcome.IsDone() && outcome.failure.empty()) outcome.failure = LastLineOf(log_path);
    outcome.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  }
  if (log >= 0) close(log);
  if (result >= 0) close(result);
}

}  // namespace

RunOutcome RunInCopy(const Study& study, const std::string& study_folder, const RunOrder& order)
{
  const auto start = std::chrono::steady_clock::now();
  const std::string folder = study_folder + "/runs/" + order.name.Text();
  RunOutcome outcome;
  std::error_code error;
  fs::remove_all(folder, error);
  fs::create_directories(folder, error);
  const LoadedExperiment loaded = error ? LoadedExperiment{} : LoadExperimentFile(order.experiment, ChangesFor(order));
  if (loaded.experiment)
  {
    RunLoaded(study, folder, order, *loaded.experiment, outcome);
  }
  else
  {
    outcome.exit_code = error ? kExitProcessFailed : kExitInvalidFile;
    outcome.failure = error                   ? fmt::format("cannot make the folder '{}': {}", folder, error.message())
                      : loaded.errors.empty() ? "the experiment cannot be read"
                                              : loaded.errors[0].Text();
  }
  outcome.name = order.name;
  outcome.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  Tidy(folder, outcome.IsDone());
  return outcome;
}

}  // namespace swarmanoid
