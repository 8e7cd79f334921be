// Lines of sight from an eye to points, and which cylinders they meet, for the parts of DiscField: the one exact test.
#pragma once

#include "controller_host/devices/sensing/disc_field.h"

namespace swarmanoid
{

// The line from the eye to a point is within the height of a cylinder between two of its places. The cylinder hides the
// point if the nearest place between them is within its circle.
inline IntLanes Meets(FloatLanes circle_x, FloatLanes circle_y, FloatLanes square, FloatLanes x, FloatLanes y,
                      FloatLanes first, FloatLanes last)
{
  const FloatLanes along = circle_x * x + circle_y * y;
  const FloatLanes nearest = Minimum(Maximum(along, first), last);
  const FloatLanes beside_x = nearest * x - circle_x;
  const FloatLanes beside_y = nearest * y - circle_y;
  return beside_x * beside_x + beside_y * beside_y <= square;
}

inline DiscField::Lines DiscField::LinesTo(const PointView& points, std::size_t group) const
{
  FloatLanes x = LoadLanes(&points.x[group]);
  const FloatLanes y = LoadLanes(&points.y[group]);
  // A point straight above or below is moved aside by a micrometre, so that it has a direction.
  x = x * x + y * y < 1e-12F ? Everywhere(1e-6F) : x;
  Lines lines;
  lines.length = SquareRoot(x * x + y * y);
  lines.x = x / lines.length;
  lines.y = y / lines.length;
  lines.from = lines.inverse = FloatLanes{};
  lines.to = Everywhere(1.0F);
  if (heights_ != Heights::kSpanning)
  {
    constexpr float kTiny = 1e-20F;  // a level line: the quotients become huge, not NaN
    const FloatLanes z = LoadLanes(&points.z[group]);
    lines.inverse = 1 / (z == 0 ? Everywhere(kTiny) : z);
  }
  if (heights_ == Heights::kEqual)
  {
    const FloatLanes low = low_ * lines.inverse;
    const FloatLanes high = high_ * lines.inverse;
    lines.from = Maximum(Minimum(low, high), lines.from);
    lines.to = Minimum(Maximum(low, high), lines.to);
  }
  lines.first = lines.from * lines.length;
  lines.last = lines.to * lines.length;
  return lines;
}

}  // namespace swarmanoid
