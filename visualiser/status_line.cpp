#include "visualiser/status_line.h"

#include <fmt/format.h>

namespace swarmanoid
{

std::string_view PhaseName(RunStatus::Phase phase)
{
  switch (phase)
  {
    case RunStatus::Phase::kWaiting:
      return "waiting";
    case RunStatus::Phase::kRunning:
      return "running";
    case RunStatus::Phase::kPaused:
      return "paused";
    case RunStatus::Phase::kFinished:
      return "finished";
    case RunStatus::Phase::kUnknown:
      break;
  }
  return "unknown";
}

std::string StatusLine(const RunStatus& status)
{
  std::string line = fmt::format("tick {}, {}", status.tick, PhaseName(status.phase));
  if (status.phase == RunStatus::Phase::kRunning)
  {
    line += fmt::format(", {:.1f}x real time", status.real_time_factor);
    if (status.speed_wanted > 0) line += fmt::format(" (wanted: {:g}x)", status.speed_wanted);
    line += fmt::format(", {:.0f} ticks/s", status.ticks_per_second);
  }
  if (!status.ended.empty()) line += fmt::format(" ({})", status.ended);
  std::string late;
  for (const ProcessStatus& process : status.processes)
    if (process.late_s > 0)
      late += fmt::format("{}{} ({:.1f} s{}{})", late.empty() ? "; late: " : ", ", process.name, process.late_s,
                          process.doing.empty() ? "" : ", ", process.doing);
  return line + late;
}

}  // namespace swarmanoid
