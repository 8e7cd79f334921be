// How a run ended, as every program tells it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace swarmanoid
{

// A user wants the run to begin again at tick 0, at the pace that it has.
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
  std::uint64_t hash = 0;  // of the final state
  double wall_s = 0;       // from the first tick on
  double real_time_factor = 0;
  bool interrupted = false;
  bool failed = false;                  // the experiment functions said so
  std::optional<ResetRequest> reset{};  // why it ended
};

// Of `ticks` simulated ones since the start; 0 if no time has passed.
double RealTimeFactor(std::uint64_t ticks, double tick_s, double wall_s);

// The last line of every run: "finished: <ticks> ticks, <entities> entities, hash <16 hex digits>, <wall> s, <factor>x
// real time".
std::string FinishedLine(const RunSummary& summary);

}  // namespace swarmanoid
