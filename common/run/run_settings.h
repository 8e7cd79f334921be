// The settings of a run, declared once: `swarmanoid run`, the space server and the programs of users read them, and the
// command lines of a cluster's processes are written from them.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/activity/limits.h"
#include "common/experiment/load_experiment.h"
#include "common/program/options.h"

namespace swarmanoid
{

// As for the element of the experiment file.
inline constexpr double kLargestSeed = 9e18;

// Which experiment, and what is changed in it.
struct ExperimentChoice
{
  std::string file;
  std::vector<std::string> settings;  // "PATH=VALUE"
  std::optional<std::uint64_t> seed;
  std::optional<std::uint64_t> ticks;
  std::optional<std::uint64_t> ahead;
};

// How the ticks of an experiment are run, in whichever process.
struct SimulatorOptions
{
  // What visualisations and experiment functions write. Empty: this folder, or for `swarmanoid run` a new one.
  std::string output_folder;
  std::string hash_log;         // file for one hash a tick; empty: none
  double real_time_factor = 0;  // 0: as fast as possible
  // Until a user resumes it. In one process that takes a visualisation: without one, CSimulator throws UsageError.
  bool paused = false;
  // Whether users may ask that the run begins again (RunSummary::reset): whoever started it does that then.
  bool may_reset = false;
  std::string event_log;  // file for what users ask; empty: none
  std::string events;     // such a file of an earlier run, whose moves and stops are repeated
  // The folder of an earlier run: its controllers fail again where they did, and no time is measured in the ticks that
  // it did.
  std::string faults_of;
  bool visualisations = true;
  // A checkpoint is written to the output folder every so many ticks: a multiple of the experiment's canonical_period.
  // 0: none.
  std::uint64_t checkpoint_every = 0;
  std::string restore_file;  // the checkpoint to go on from; empty: start at tick 0
  // Take one that other builds of Swarmanoid or of the libraries saved. The bits of the run are then nobody's promise.
  bool any_build = false;
  // As a cluster: a journal in the output folder, of all that the processes take in. "optional": if it cannot be
  // written any more the run goes on, but nobody can be replaced then; otherwise it ends.
  bool journal = true;
  std::string journal_need = "needed";
  std::string journal_budget;  // what is kept of it, as "2GiB": the newest; empty: everything
  std::uint64_t JournalBudgetBytes() const;
  // Threads that share the sensors, and the controllers that may step in parallel, of one process, or of each
  // controller host. 0: in one process as many as cores are free, in a host one. Their number changes no bit of the
  // results.
  unsigned threads = 0;
  // In one process. Set from a signal handler: the run stops at the end of the tick.
  const std::atomic<bool>* stop = nullptr;
};

struct RunSettings : ExperimentChoice, SimulatorOptions
{
  std::string branch;  // "RUN@TICK": the state to begin with is that of an earlier run
  bool single_process = false;
  // Visualisations that are added to those of the file: "web", "opengl" …
  std::vector<std::string> show;
  bool ros2 = false;  // likewise "ros2"
  unsigned controller_hosts = 1;
  std::vector<std::string> engine_hosts;  // "ENGINE=HOST"
  std::string hosts_file;
  std::optional<int> domain;       // DDS domain; otherwise a free one
  bool insecure = false;           // without a key of the run
  std::string key_file;            // with the key of the run; otherwise a new one
  bool isolated = false;           // in a network of its own on this machine
  std::string placement = "auto";  // on processor cores: auto, one-core or spread
  std::string expected_hash;
  bool quiet = false;
  bool recovery = true;  // processes that die are replaced
  unsigned retries = 3;  // of one process, while the run does not go on
  bool Replaces() const { return recovery && journal && retries > 0; }
  double lease_s = 0;         // silence after which a process counts as dead; 0: the default
  double step_timeout_s = 0;  // that a step of a user's code may take; 0: the environment's limit, or none
  std::string memory_limit;   // of each process, as "2GiB"; empty: the environment's limit, or the default
};

// The limits of users' code: those of the settings, and for the rest those of the environment.
Limits LimitsOf(const RunSettings& settings);

// The settings that `swarmanoid run` takes, which are all, and those that the space server takes. Valid as long as
// `settings` is there.
std::vector<OptionSpec> RunOptionTable(RunSettings& settings);
std::vector<OptionSpec> ServerOptionTable(RunSettings& settings);
// Of these, what chooses the experiment and changes it.
std::vector<OptionSpec> ChoiceOptionTable(RunSettings& settings);
// The words after `space_server` that give it these settings. Paths become absolute.
std::vector<std::string> ServerWords(const RunSettings& settings);

// "PATH=VALUE" to a pair; throws UsageError if there is no '='.
std::pair<std::string, std::string> SplitSetting(const std::string& text);
// What is changed in the experiment, as the loader takes it. Throws UsageError.
LoadOptions ChangesOf(const ExperimentChoice& choice);

}  // namespace swarmanoid
