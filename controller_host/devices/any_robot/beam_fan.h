// The beams of a range scanner on an upright robot, and the distance along each to the bodies that it meets: cylinders
// and boxes that stand upright, or any shape by a function. The range scanner uses it for one robot after another, in
// its thread. It is inline because the sensor spends most of its time here.
//
// Coordinates are those of the scanner: origin at the scanner, x along angle 0, z up. A beam has a direction (c, s) in
// the plane and a slope; it is at height slope h after the distance h in the plane. It meets an upright body where h is
// within the outline of the body and the height within the body's: an intersection of two intervals.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "common/math/elementary.h"
#include "common/plugin_descriptions/range_scanner_beams.h"

namespace swarmanoid
{

class BeamFan
{
public:
  // An upright cylinder. `angle` is the direction of its middle, Atan2(y, x).
  struct Disc
  {
    double x, y, angle, radius, low, high;
  };
  // An upright box: its middle, and the direction of its x axis.
  struct Box
  {
    double x, y, cos, sin, half_x, half_y, low, high;
  };

  void Configure(const RangeScannerBeams& beams)
  {
    first_ = beams.angles.front();
    inverse_spacing_ = beams.spacing > 0 ? 1 / beams.spacing : 0;
    count_ = beams.angles.size();
    for (const double angle : beams.angles)
    {
      const SinCos direction = SinCosOf(angle);
      cos_.push_back(direction.cos);
      sin_.push_back(direction.sin);
    }
    for (const double elevation : beams.elevations)
    {
      const SinCos direction = SinCosOf(elevation);
      const double slope = direction.sin / direction.cos;
      // For a level beam the quotients become huge, not NaN.
      inverse_slopes_.push_back(slope == 0 ? 1 / kTiny : 1 / slope);
      slopes_.push_back(slope);
      lengths_.push_back(1 / direction.cos);
    }
    enter_.resize(count_);
    leave_.resize(count_);
  }

  // Begins with another robot, whose scanner is at this height (m) above the floor. Distances are written to
  // `distances`, layer after layer.
  void Begin(double height, double* distances)
  {
    distances_ = distances;
    for (std::size_t layer = 0; layer < slopes_.size(); ++layer)
    {
      const bool meets_floor = slopes_[layer] < 0 && height > 0;
      const double floor = meets_floor ? height / -slopes_[layer] * lengths_[layer] : kNothing;
      std::fill_n(distances + layer * count_, count_, floor);
    }
  }

  void Add(const Disc& disc)
  {
    const double square = disc.x * disc.x + disc.y * disc.y;
    const double c = square - disc.radius * disc.radius;
    const auto measure = [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const double b = cos_[i] * disc.x + sin_[i] * disc.y;
        const double discriminant = b * b - c;
        const double s = __builtin_sqrt(discriminant > 0 ? discriminant : 0);
        enter_[i] = b - s;
        leave_[i] = discriminant >= 0 ? b + s : -1;
      }
      Take(begin, end, disc.low, disc.high);
    };
    if (c <= 0) return measure(0, count_);
    // An upper bound of asin(x), x + (pi / 2 - 1) x^3, and a little more for rounding.
    const double share = disc.radius / __builtin_sqrt(square);
    const double half = share + 0.5708 * share * share * share + 1e-6;
    ForBeamsWithin(disc.angle - half, disc.angle + half, measure);
  }

  void Add(const Box& box)
  {
    // The scanner and the beams in the frame of the box.
    const double x = -(box.cos * box.x + box.sin * box.y);
    const double y = box.sin * box.x - box.cos * box.y;
    const auto measure = [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        double ux = box.cos * cos_[i] + box.sin * sin_[i];
        double uy = box.cos * sin_[i] - box.sin * cos_[i];
        ux = ux == 0 ? kTiny : ux;
        uy = uy == 0 ? kTiny : uy;
        const double ax = (-box.half_x - x) / ux;
        const double bx = (box.half_x - x) / ux;
        const double ay = (-box.half_y - y) / uy;
        const double by = (box.half_y - y) / uy;
        const double enter_x = ax < bx ? ax : bx;
        const double leave_x = ax < bx ? bx : ax;
        const double enter_y = ay < by ? ay : by;
        const double leave_y = ay < by ? by : ay;
        const double enter = enter_x > enter_y ? enter_x : enter_y;
        const double leave = leave_x < leave_y ? leave_x : leave_y;
        enter_[i] = enter;
        leave_[i] = enter <= leave ? leave : -1;
      }
      Take(begin, end, box.low, box.high);
    };
    const double outside_x = std::max(__builtin_fabs(x) - box.half_x, 0.0);
    const double outside_y = std::max(__builtin_fabs(y) - box.half_y, 0.0);
    if (outside_x * outside_x + outside_y * outside_y <= 1e-6) return measure(0, count_);
    // From outside, the corners bound what is seen, within half a turn.
    const double middle = Atan2(box.y, box.x);
    double least = 0, most = 0;
    for (const double sx : {-box.half_x, box.half_x})
      for (const double sy : {-box.half_y, box.half_y})
      {
        const double cx = box.x + box.cos * sx - box.sin * sy;
        const double cy = box.y + box.sin * sx + box.cos * sy;
        const double turned = WrapAngle(Atan2(cy, cx) - middle);
        least = std::min(least, turned);
        most = std::max(most, turned);
      }
    ForBeamsWithin(middle + least - 1e-6, middle + most + 1e-6, measure);
  }

  // Cuts distances beyond the range, and those too near.
  void End(double nearest, double range)
  {
    const std::size_t all = count_ * slopes_.size();
    for (std::size_t i = 0; i < all; ++i)
    {
      const double distance = distances_[i];
      distances_[i] = distance > range ? kNothing : distance < nearest ? 0 : distance;
    }
  }

private:
  static constexpr double kTiny = 1e-300;
  static constexpr double kNothing = std::numeric_limits<double>::infinity();

  // Calls measure(begin, end) for the beams between two angles, of which the first is within -2 pi to pi, and the
  // second within -pi to 2 pi.
  template <class Measure>
  void ForBeamsWithin(double from, double to, const Measure& measure) const
  {
    const auto part = [&](double turn)
    {
      const double first = (from + turn - first_) * inverse_spacing_;
      const double last = (to + turn - first_) * inverse_spacing_;
      if (last < 0 || first > static_cast<double>(count_ - 1)) return;
      const auto begin = first <= 0 ? 0
                                    : static_cast<std::size_t>(first) +
                                          (first > static_cast<double>(static_cast<std::size_t>(first)) ? 1 : 0);
      const auto end = std::min(static_cast<std::size_t>(last) + 1, count_);
      if (begin < end) measure(begin, end);
    };
    part(0);
    if (from < -kPi) part(2 * kPi);
    if (to > kPi) part(-2 * kPi);
  }

  // Shortens the beams that enter an outline before they leave it, where they are at a height of the body.
  void Take(std::size_t begin, std::size_t end, double low, double high)
  {
    for (std::size_t layer = 0; layer < slopes_.size(); ++layer)
    {
      const double a = low * inverse_slopes_[layer];
      const double b = high * inverse_slopes_[layer];
      const double least = std::max(std::min(a, b), 0.0);
      const double most = std::max(a, b);
      if (most < 0) continue;
      const double length = lengths_[layer];
      double* const distances = distances_ + layer * count_;
      for (std::size_t i = begin; i < end; ++i)
      {
        const double enter = enter_[i] > least ? enter_[i] : least;
        const double leave = leave_[i] < most ? leave_[i] : most;
        const double distance = enter * length;
        const bool is_nearer = (enter <= leave) & (distance < distances[i]);
        distances[i] = is_nearer ? distance : distances[i];
      }
    }
  }

  double first_ = 0, inverse_spacing_ = 0;
  std::size_t count_ = 0;
  std::vector<double> cos_, sin_;                          // of each beam
  std::vector<double> slopes_, inverse_slopes_, lengths_;  // of each layer; a length is 1 / cos(elevation)
  std::vector<double> enter_, leave_;                      // of the body at hand; less than 0: it is missed
  double* distances_ = nullptr;
};

}  // namespace swarmanoid
