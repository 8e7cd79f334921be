// Method: a run of one tick gives the time to begin. Longer runs follow until one takes measurably longer; from both
// follows the time of a tick. Times and sizes of files grow in proportion to the ticks, which overestimates files that
// are written once, and does not know that ticks become slower or faster later.
#include "studies/runs/study_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "common/checkpoint/library_builds.h"
#include "common/experiment/load_experiment.h"
#include "launcher/system/scratch_folder.h"
#include "studies/runs/run_order.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr std::size_t kSamplePoints = 4;
constexpr double kMeasurable_s = 0.2;  // longer than a run of one tick
constexpr std::uint64_t kLonger = 4;   // factor between the lengths of two runs
// Bytes of study.sqlite and table.csv together.
constexpr double kBytesOfRun = 300;
constexpr double kBytesOfRow = 85;
constexpr double kBytesOfValue = 28;

double BytesIn(const std::string& folder)
{
  double bytes = 0;
  std::error_code none;
  for (fs::recursive_directory_iterator each(folder, none), end; !none && each != end; each.increment(none))
    if (each->is_regular_file(none)) bytes += static_cast<double>(each->file_size(none));
  return bytes;
}

RunOutcome RunShortly(const Study& study, const Design& design, std::size_t point, std::uint64_t ticks,
                      const std::string& folder)
{
  RunOrder order{
      {static_cast<std::uint32_t>(point), study.seeds.front()}, design.ExperimentOf(point), design.SettingsOf(point)};
  std::erase_if(order.settings, [](const auto& setting) { return setting.first == "framework.maxclock"; });
  order.settings.emplace_back("framework.maxclock", std::to_string(ticks));
  return RunInCopy(study, folder, order);
}

// Returns the ticks of a run; 0 if it ends by itself.
std::uint64_t TicksOf(const Study& study, const Design& design, std::size_t point)
{
  if (study.ticks != 0) return study.ticks;
  LoadOptions changes;
  changes.settings = design.SettingsOf(point);
  const LoadedExperiment loaded = LoadExperimentFile(design.ExperimentOf(point), changes);
  return loaded.experiment ? loaded.experiment->max_clock : 0;
}

double BytesOf(const Study& study, const RunSamples& samples, std::uint64_t ticks)
{
  const double rows = study.sample_every == 0 ? 1 : static_cast<double>(ticks / study.sample_every + 1);
  const double columns = static_cast<double>(MetricColumns(study).size());
  double bytes = kBytesOfRun + rows * (kBytesOfRow + columns * kBytesOfValue);
  bytes += rows * 2 * sizeof(float) * static_cast<double>(samples.followed.size());
  for (const RunSamples::Grid& grid : samples.grids)
    bytes += static_cast<double>(grid.visits.size() * sizeof(std::uint32_t));
  return bytes;
}

// Adds the estimate of a run of one point. Returns false, and says why, if it cannot be executed.
bool AddPoint(const Study& study, const Design& design, std::size_t point, StudyEstimate& estimate)
{
  const std::uint64_t ticks = TicksOf(study, design, point);
  if (ticks == 0)
  {
    estimate.failure = "its runs end by themselves";
    return false;
  }
  const ScratchFolder folder;
  RunOutcome first, last;
  for (std::uint64_t length = 1;; length = std::min(kLonger * length, ticks))
  {
    last = RunShortly(study, design, point, length, folder.Path());
    if (length == 1) first = last;
    if (!last.IsDone())
    {
      estimate.failure = fmt::format("a run of {} ticks failed: {}", length, last.failure);
      return false;
    }
    if (length == ticks || last.wall_s > first.wall_s + kMeasurable_s || last.ticks < length) break;
  }
  const double share = static_cast<double>(ticks) / static_cast<double>(std::max<std::uint64_t>(last.ticks, 1));
  const double of_ticks = std::max(last.wall_s - first.wall_s, 0.0);
  estimate.seconds_of_run += first.wall_s + of_ticks * share;
  estimate.bytes_of_run += BytesOf(study, last.samples, ticks) + BytesIn(folder.Path()) * share;
  return true;
}

}  // namespace

StudyEstimate EstimateOf(const Study& study, const Design& design)
{
  OwnBuild();  // all runs of a study share this, so it is no part of their time
  StudyEstimate estimate;
  const std::vector<std::size_t> points = design.PointsOfAllLevels(kSamplePoints);
  for (const std::size_t point : points)
    if (!AddPoint(study, design, point, estimate)) return estimate;
  estimate.seconds_of_run /= static_cast<double>(points.size());
  estimate.bytes_of_run /= static_cast<double>(points.size());
  return estimate;
}

std::string RoughSize(double bytes)
{
  constexpr double kThousand = 1000;
  for (const char* unit : {"bytes", "kB", "MB", "GB"})
  {
    if (bytes < kThousand) return fmt::format("{:.{}f} {}", bytes, bytes < 10 ? 1 : 0, unit);
    bytes /= kThousand;
  }
  return fmt::format("{:.1f} TB", bytes);
}

}  // namespace swarmanoid
