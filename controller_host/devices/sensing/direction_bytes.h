// Directions around an eye in the xy plane and distances from it, in bytes, so that one instruction compares 16 or 32
// of them. A few comparisons find the lines of sight that may meet an upright cylinder, and only these pairs get an
// exact test. A direction is y / (|x| + |y|) in each quadrant, which grows with the angle and needs no arc tangent.
// Used by DiscField and DiscCover.
#pragma once

#include <cstdint>
#include <vector>

#include "common/math/lanes.h"
#include "controller_host/devices/sensing/neighbour_grid.h"

namespace swarmanoid
{

inline constexpr float kFarthestByte = 254;  // whatever is farther

// Returns a direction, where 256 is a turn, and `aside` more; the result is not wrapped. The point must not be near
// (0, 0).
inline FloatLanes TurnInBytes(FloatLanes x, FloatLanes y, float aside = 0)
{
  constexpr int kAllButSign = 0x7fffffff;
  const auto bits = [](FloatLanes lanes) { return reinterpret_cast<IntLanes>(lanes); };
  const auto size = [&](FloatLanes lanes) { return reinterpret_cast<FloatLanes>(bits(lanes) & kAllButSign); };
  // From the direction -y on. It runs the other way where x is negative.
  const FloatLanes turn = y / (size(x) + size(y)) - 1;
  return reinterpret_cast<FloatLanes>(bits(turn) ^ (bits(x) & ~kAllButSign)) * 64 + (320 + aside);
}

inline constexpr std::int32_t kMeetsNothing = 255 << 16;

// Values of the cylinders around an eye, with room for kLanes more.
struct DirectionBytes
{
  // The lowest byte `first`, then `width` and `near`: a line that meets the cylinder has the direction `first` or one
  // of the `width` steps behind it, and reaches the distance `near`.
  std::vector<std::int32_t> meets;
  // The direction and distance of the middle, then `behind`; made only on request. A line that reaches `behind` in a
  // direction 2 ... width - 2 steps after `first` surely meets the cylinder. 255 means unknown.
  std::vector<std::int32_t> middles;

  // Sets the bytes of the cylinders. Distances are in steps, with `steps_per_m` steps per metre.
  void Read(const NearBodies& discs, float steps_per_m, bool with_middles);
};

inline IntLanes LowestByte(IntLanes lanes) { return lanes & 255; }
inline IntLanes SecondByte(IntLanes lanes) { return lanes >> 8 & 255; }
inline IntLanes ThirdByte(IntLanes lanes) { return lanes >> 16 & 255; }

}  // namespace swarmanoid
