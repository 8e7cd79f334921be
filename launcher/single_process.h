// The runner that calls all roles of an experiment in turn within one process: no DDS, no copies. Same results as a
// cluster.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

struct SingleProcessOptions
{
  std::string output_folder = ".";
  std::string hash_log;         // file for one hash a tick; empty: none
  double real_time_factor = 0;  // 0: as fast as possible
  bool visualisations = true;
  // A checkpoint is written when this tick is reached; it must be a multiple of the experiment's canonical_period. 0:
  // none.
  std::uint64_t checkpoint_tick = 0;
  std::string checkpoint_file;
  // The checkpoint to go on from; empty: start at tick 0.
  std::string restore_file;
  // Set from a signal handler: the run stops at the end of the tick.
  const std::atomic<bool>* stop = nullptr;
  // Called now and then (at most ten times a second) with the tick just finished.
  std::function<void(std::uint64_t tick)> progress;
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

// Throws ConfigurationError, ControllerError or std::runtime_error with a text for the user.
RunSummary RunSingleProcess(const Experiment& experiment, const SingleProcessOptions& options);

// The last line of every run: "finished: <ticks> ticks, <entities> entities, hash <16 hex digits>, <wall> s, <factor>x
// real time".
std::string FinishedLine(const RunSummary& summary);

}  // namespace swarmanoid
