// The progress of a study on standard error: one line that changes on a terminal, otherwise a line at intervals.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "studies/executors/executor.h"

namespace swarmanoid
{

class SweepProgress
{
public:
  using Clock = std::chrono::steady_clock;

  // `all` counts the runs of the study, and `done` those that were executed before.
  SweepProgress(const Design& design, std::size_t all, std::size_t done, bool quiet);
  ~SweepProgress();

  // Adds a run that was executed in this process or before.
  void AddTime(std::uint32_t point, double wall_s);
  void Done() { ++done_; }
  void AddRuns(std::size_t count) { all_ += count; }
  // Prints a line even in quiet mode.
  void Say(const std::string& line);
  // Shows the progress. `waiting` has, by point, the number of runs that have not begun.
  void Show(const Executor& place, const std::map<std::uint32_t, std::size_t>& waiting, Clock::time_point now);

private:
  double SecondsLeft(const std::map<std::uint32_t, std::size_t>& waiting, std::size_t running, unsigned slots) const;
  void Clear();

  struct Times
  {
    double sum_s = 0;
    double count = 0;
  };
  const Design& design_;
  std::size_t all_, done_;
  bool quiet_, terminal_;
  bool is_shown_ = false;
  std::map<std::uint32_t, Times> of_point_;
  Times of_all_;
  Clock::time_point next_;
};

// Returns "12 s", "3 min" or "2.5 h".
std::string RoughTime(double seconds);

}  // namespace swarmanoid
