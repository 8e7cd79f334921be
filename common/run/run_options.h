// The settings of a run, declared once. `swarmanoid run`, the space server and users' programs read them. The command
// lines of a cluster's processes are written from them.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/experiment/load_experiment.h"
#include "common/limits/limits.h"
#include "common/program/option_parser.h"

namespace swarmanoid
{

// The limit is that of the element of the experiment file.
inline constexpr double kLargestSeed = 9e18;

// The experiment and the changes to it.
struct ExperimentChoice
{
  std::string file;
  std::vector<std::string> settings;  // "PATH=VALUE"
  std::optional<std::uint64_t> seed;
  std::optional<std::uint64_t> ticks;
  std::optional<std::uint64_t> ahead;
};

// The settings for running ticks, in any process.
struct SimulatorOptions
{
  // The folder for output of visualisations and experiment functions. Empty: the working folder or, for `swarmanoid
  // run`, a new one.
  std::string output_folder;
  std::string hash_log;         // file for one hash a tick; empty: none
  double real_time_factor = 0;  // 0: as fast as possible
  // The run starts paused until a user resumes it. In one process this requires a visualisation: without one,
  // CSimulator throws UsageError.
  bool paused = false;
  // If it is true, users may start the run again (RunSummary::reset). The caller of the run then does it.
  bool may_reset = false;
  std::string event_log;  // file for users' requests; empty: none
  std::string events;     // event log of an earlier run, whose moves and stops are repeated
  // The folder of an earlier run. Its controller faults are repeated, and no time is measured in its ticks.
  std::string faults_of;
  bool visualisations = true;
  // The period of checkpoints in ticks, a multiple of the experiment's canonical_period. They go to the output folder.
  // 0: none.
  std::uint64_t checkpoint_every = 0;
  std::string restore_file;  // the checkpoint to continue from; empty: start at tick 0
  // Accepts a checkpoint of other builds of Swarmanoid or of the libraries. Then the bits of the run are not
  // guaranteed.
  bool any_build = false;
  // Clusters: writes a journal of all inputs of the processes to the output folder. "optional": if it cannot be written
  // any more, the run continues without replacing dead processes. Otherwise the run ends.
  bool journal = true;
  std::string journal_need = "needed";
  std::string journal_budget;  // size of its newest part that is kept, such as "2GiB"; empty: everything
  std::uint64_t JournalBudgetBytes() const;
  // The number of threads for sensors, and for controllers that may step in parallel, in one process or in each
  // controller host. 0: the number of free cores in one process, and one thread in a host. Their number changes no bit
  // of the results.
  unsigned threads = 0;
  // Ends the run at the end of the tick, for a run in one process. A signal handler sets it.
  const std::atomic<bool>* stop = nullptr;
};

struct RunSettings : ExperimentChoice, SimulatorOptions
{
  std::string branch;  // "RUN@TICK": the state of an earlier run to start with
  bool single_process = false;
  // Visualisations that are added to those of the file: "web", "opengl" …
  std::vector<std::string> show;
  bool ros2 = false;  // adds the visualisation "ros2"
  unsigned controller_hosts = 1;
  std::vector<std::string> engine_hosts;  // "ENGINE=HOST"
  std::string hosts_file;
  std::optional<int> domain;       // DDS domain; otherwise a free one
  bool insecure = false;           // runs without a key of the run
  std::string key_file;            // file with the key of the run; empty: a new key
  bool isolated = false;           // runs in a separate network on this machine
  std::string placement = "auto";  // on processor cores: auto, one-core or spread
  std::string expected_hash;
  bool quiet = false;
  bool recovery = true;  // replaces processes that die
  unsigned retries = 3;  // for one process, without progress of the run
  bool Replaces() const { return recovery && journal && retries > 0; }
  double lease_s = 0;         // silence after which a process counts as dead; 0: the default
  double step_timeout_s = 0;  // limit for a step of a user's code; 0: the environment's limit, or none
  std::string memory_limit;   // for each process, as "2GiB"; empty: the environment's limit, or the default
};

// Returns the limits of users' code from the settings, or else from the environment.
Limits LimitsOf(const RunSettings& settings);

// Return the options of `swarmanoid run`, which are all settings, and those of the space server. They are valid as long
// as `settings` exists.
std::vector<OptionSpec> RunOptionTable(RunSettings& settings);
std::vector<OptionSpec> ServerOptionTable(RunSettings& settings);
// Returns those of the options that choose and change the experiment.
std::vector<OptionSpec> ChoiceOptionTable(RunSettings& settings);
// Returns the words after `space_server` that give it these settings. Paths become absolute.
std::vector<std::string> ServerWords(const RunSettings& settings);

// Splits "PATH=VALUE" into a pair; throws UsageError if there is no '='.
std::pair<std::string, std::string> SplitSetting(const std::string& text);
// Returns the changes of the experiment as the loader takes them. Throws UsageError.
LoadOptions ChangesOf(const ExperimentChoice& choice);

}  // namespace swarmanoid
