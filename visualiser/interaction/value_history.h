// The values of a number at the latest ticks: the curve of a plot.
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

  // Adds a point. A point that is not later than the last one (a paused run, a moved robot) replaces it.
  void Add(double time, double value)
  {
    if (!points_.empty() && time <= points_.back().time)
    {
      points_.back() = {points_.back().time, value};
      return;
    }
    // The older half is removed at once, so that adding stays cheap.
    if (points_.size() == 2 * kMost) points_.erase(points_.begin(), points_.begin() + kMost);
    points_.push_back({time, value});
  }

  // Returns the points, ascending in time.
  const std::vector<Point>& Points() const { return points_; }

private:
  std::vector<Point> points_;
};

}  // namespace swarmanoid
