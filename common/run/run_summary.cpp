#include "common/run/run_summary.h"

#include <fmt/format.h>

namespace swarmanoid
{

double RealTimeFactor(std::uint64_t ticks, double tick_s, double wall_s)
{
  return wall_s > 0 ? static_cast<double>(ticks) * tick_s / wall_s : 0;
}

std::string FinishedLine(const RunSummary& summary)
{
  return fmt::format("finished: {} ticks, {} entities, hash {:016x}, {:.3f} s, {:.1f}x real time", summary.ticks,
                     summary.entities, summary.hash, summary.wall_s, summary.real_time_factor);
}

}  // namespace swarmanoid
