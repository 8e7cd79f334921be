// CSimulator: the abstract algorithm of the simulator. All roles of an experiment in this process, called in turn, one
// tick at a time: no DDS, no copies, same results as a cluster. For `swarmanoid run --single-process`, for tests, and
// for the programs of users that look at every tick or run an experiment many times. One thread.
//
//   const auto experiment = ReadExperiment("experiments/retrieval.xml", {{"framework.seed", "3"}});
//   CSimulator simulator(*experiment);
//   while (simulator.Step()) best = std::max(best, simulator.GetSpace().FindEntity("fb")->GetPosition().x());
//   simulator.Finish();
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/space/space.h"

namespace swarmanoid
{

struct SimulatorOptions
{
  std::string output_folder = ".";  // what visualisations and experiment functions write
  std::string hash_log;             // file for one hash a tick; empty: none
  double real_time_factor = 0;      // 0: as fast as possible
  // Until a user resumes through a visualisation: the constructor waits for it, or throws UsageError where there is
  // none.
  bool paused = false;
  std::string event_log;  // file for what users ask through visualisations; empty: none
  std::string events;     // such a file of an earlier run, whose moves and stops are repeated
  bool visualisations = true;
  // A checkpoint is written to the output folder every so many ticks: a multiple of the experiment's canonical_period.
  // 0: none.
  std::uint64_t checkpoint_every = 0;
  // The checkpoint to go on from; empty: start at tick 0.
  std::string restore_file;
  // Set from a signal handler: the run stops at the end of the tick.
  const std::atomic<bool>* stop = nullptr;
};

struct RunSummary
{
  std::uint64_t ticks = 0;
  std::size_t entities = 0;
  std::uint64_t hash = 0;  // of the final state
  double wall_s = 0;       // from the first tick on
  double real_time_factor = 0;
  bool interrupted = false;
  bool failed = false;  // the experiment functions said so
};

class CSimulator
{
public:
  // The experiment at tick 0, or where its checkpoint is; it must outlive the simulator. Throws ConfigurationError,
  // ActivityError (common/activity/failure_report.h), which names whose code failed, or another std::runtime_error with
  // a text for the user; so do Step and Finish. Code that crashes or calls exit ends the program with such a line and
  // exit code 4.
  explicit CSimulator(const Experiment& experiment, const SimulatorOptions& options = {});
  ~CSimulator();
  CSimulator(const CSimulator&) = delete;
  CSimulator& operator=(const CSimulator&) = delete;

  // Controllers, physics, visualisations: to the next tick. False, and nothing happens, where the experiment is over.
  bool Step();
  // Ends controllers, experiment functions and visualisations; later calls give the same summary.
  const RunSummary& Finish();

  // The state at the current tick. What a program changes here is part of the experiment: it changes the hash.
  CSwarmanoidSpace& GetSpace();
  const Experiment& GetExperiment() const;

private:
  struct Roles;
  void Show();

  std::unique_ptr<Roles> roles_;
};

// Reads an experiment file with all built-in plug-ins, `settings` as for --set (path and value). Throws
// ConfigurationError with all mistakes of the file, one a line.
std::unique_ptr<Experiment> ReadExperiment(const std::string& file,
                                           const std::vector<std::pair<std::string, std::string>>& settings = {});

// The last line of every run: "finished: <ticks> ticks, <entities> entities, hash <16 hex digits>, <wall> s, <factor>x
// real time".
std::string FinishedLine(const RunSummary& summary);

}  // namespace swarmanoid
