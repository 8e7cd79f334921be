// Directions around an eye in the xy plane and distances from it, in bytes, so that one instruction compares 16 or 32
// of them: which lines of sight may meet which upright cylinders is told by a few such comparisons, and only these
// pairs are tested exactly. Directions are told by y / (|x| + |y|) of each quadrant, which grows with the angle and
// takes no arc tangent. Used by DiscField and DiscCover.
#pragma once

#include <cstdint>
#include <vector>

#include "common/math/lanes.h"
#include "controller_host/devices/sensing/neighbour_grid.h"

namespace swarmanoid
{

inline constexpr float kFarthestByte = 254;  // whatever is farther

// 0 ... 256 is a turn; not wrapped. Nowhere near 0, 0.
inline FloatLanes TurnInBytes(FloatLanes x, FloatLanes y)
{
  const auto size = [](FloatLanes lanes)
  { return reinterpret_cast<FloatLanes>(reinterpret_cast<IntLanes>(lanes) & 0x7fffffff); };
  const FloatLanes turn = y / (size(x) + size(y));
  return (x < 0 ? 6 - turn : 4 + turn) * 64;
}

inline constexpr std::int32_t kMeetsNothing = 255 << 16;

// Of cylinders around an eye, with room for kLanes more.
struct DirectionBytes
{
  // The lowest byte `first`, then `width` and `near`: a line that meets the cylinder has the direction `first` or one
  // of the `width` steps behind it, and reaches the distance `near`.
  std::vector<std::int32_t> meets;
  // Only if asked for. Direction and distance of the middle, then `behind`: a line that reaches this distance in a
  // direction that is 2 ... width - 2 steps behind `first` surely meets the cylinder; 255: unknown.
  std::vector<std::int32_t> middles;

  // Both in steps a metre.
  void Read(const NearBodies& discs, float steps_per_m, bool with_middles);
};

inline IntLanes LowestByte(IntLanes lanes) { return lanes & 255; }
inline IntLanes SecondByte(IntLanes lanes) { return lanes >> 8 & 255; }
inline IntLanes ThirdByte(IntLanes lanes) { return lanes >> 16 & 255; }

}  // namespace swarmanoid
