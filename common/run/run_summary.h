// The result of a run, as every program reports it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace swarmanoid
{

// A user's request to start the run again at tick 0, at the current pace.
struct ResetRequest
{
  std::uint64_t seed = 0;
  bool paused = false;
  double real_time_factor = 0;
};

struct RunSummary
{
  std::uint64_t ticks = 0;
  std::size_t entities = 0;
  std::uint64_t hash = 0;  // hash of the final state
  double wall_s = 0;       // from the first tick on
  double real_time_factor = 0;
  bool interrupted = false;
  bool failed = false;                  // the experiment functions reported a failure
  std::string failure{};                // which functions, and why
  std::optional<ResetRequest> reset{};  // the request that ended the run
  unsigned threads = 0;                 // of a run in one process; 0: of a cluster
  std::uint64_t shared_ticks = 0;       // that all these threads did
};

// Returns the speed of `ticks` simulated ticks relative to real time; 0 if no time has passed.
double RealTimeFactor(std::uint64_t ticks, double tick_s, double wall_s);

// Returns the last line of every run: "finished: <ticks> ticks, <entities> entities, hash <16 hex digits>, <wall> s,
// <factor>x real time".
std::string FinishedLine(const RunSummary& summary);

}  // namespace swarmanoid
