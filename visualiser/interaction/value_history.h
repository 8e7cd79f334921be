// What a number was at the latest ticks: the curve of a plot.
#pragma once

#include <vector>

namespace swarmanoid
{

class ValueHistory
{
public:
  struct Point
  {
    double time;  // simulated seconds
    double value;
  };

  static constexpr std::size_t kMost = 1200;  // points

  // A point that is not later than the last one (a run that is paused, a robot that was moved) takes its place.
  void Add(double time, double value)
  {
    if (!points_.empty() && time <= points_.back().time)
    {
      points_.back() = {points_.back().time, value};
      return;
    }
    // The older half goes at once, so that adding stays cheap.
    if (points_.size() == 2 * kMost) points_.erase(points_.begin(), points_.begin() + kMost);
    points_.push_back({time, value});
  }

  // Ascending in time.
  const std::vector<Point>& Points() const { return points_; }

private:
  std::vector<Point> points_;
};

}  // namespace swarmanoid
