#include "studies/sweep_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "common/errors/print_error.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr std::size_t kWidth = 150;

}  // namespace

std::string RoughTime(double seconds)
{
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  if (seconds < 90 * 60) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

SweepProgress::SweepProgress(const Design& design, std::size_t all, std::size_t done, bool quiet)
    : design_(design), all_(all), done_(done), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0), next_(Clock::now())
{
}

SweepProgress::~SweepProgress() { Clear(); }

void SweepProgress::AddTime(std::uint32_t point, double wall_s)
{
  for (Times* times : {&of_point_[point], &of_all_})
  {
    times->sum_s += wall_s;
    times->count += 1;
  }
}

void SweepProgress::Clear()
{
  if (is_shown_) fmt::print(stderr, "\r\033[K");
  is_shown_ = false;
}

void SweepProgress::Say(const std::string& line)
{
  Clear();
  PrintError("{}\n", line);
}

// Points differ in time. A point with finished runs is estimated by their mean, the others by the mean of all.
double SweepProgress::SecondsLeft(const std::map<std::uint32_t, std::size_t>& waiting, std::size_t running,
                                  unsigned slots) const
{
  const double mean_s = of_all_.sum_s / of_all_.count;
  double seconds = static_cast<double>(running) * mean_s / 2;
  for (const auto& [point, count] : waiting)
  {
    const auto known = of_point_.find(point);
    seconds +=
        static_cast<double>(count) * (known == of_point_.end() ? mean_s : known->second.sum_s / known->second.count);
  }
  return seconds / std::max(slots, 1U);
}

void SweepProgress::Show(const Executor& place, const std::map<std::uint32_t, std::size_t>& waiting,
                         Clock::time_point now)
{
  if (quiet_ || now < next_) return;
  next_ = now + (terminal_ ? Clock::duration(200ms) : Clock::duration(10s));
  std::string line = fmt::format("{} of {} runs ({} %)", done_, all_, 100 * done_ / std::max<std::size_t>(all_, 1));
  const std::vector<RunningRun> running = place.Running();
  if (of_all_.count > 0) line += ", about " + RoughTime(SecondsLeft(waiting, running.size(), place.Slots())) + " left";
  for (std::size_t i = 0; i < running.size() && line.size() < kWidth; ++i)
  {
    const std::string values = design_.Text(running[i].name.point);
    line += fmt::format("{} {}{}{}", i == 0 ? "; running" : ",", running[i].name.Text(),
                        running[i].where.empty() ? "" : " on " + running[i].where,
                        values.empty() ? "" : " (" + values + ")");
  }
  if (line.size() > kWidth) line = line.substr(0, kWidth) + " …";
  if (!terminal_) return PrintError("{}\n", line);
  Clear();
  PrintError("{}", line);
  std::fflush(stderr);
  is_shown_ = true;
}

}  // namespace swarmanoid
