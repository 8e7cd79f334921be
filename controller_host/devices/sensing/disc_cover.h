// DiscCover: for each of 256 directions, the distance beyond which a crowd of upright cylinders around an eye surely
// hides everything. All lines of sight must be within the heights of all cylinders. Points that are not covered get an
// exact test, only with cylinders before them. Used by DiscField. In steady running it allocates nothing.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "controller_host/devices/sensing/direction_bytes.h"

namespace swarmanoid
{

class DiscCover
{
public:
  // Makes the cover from bytes that have middles.
  void Lay(const DirectionBytes& bytes, std::size_t count);
  // Returns whether the cover surely hides the middles of cylinders, by their bytes.
  IntLanes HidesMiddles(IntLanes middles) const;
  // Returns whether the cover surely hides the whole cylinders, which then hide nothing that it does not hide.
  IntLanes HidesAll(IntLanes meets) const;

private:
  static constexpr std::size_t kTurn = 256;
  static constexpr std::size_t kWindow = 4;

  void Cover(std::size_t first, int directions, std::uint8_t distance);

  // A whole turn, and a copy of its start so that reads may go beyond its end.
  std::array<std::uint8_t, 2 * kTurn + 2 * kByteLanes> behind_{};
  std::array<std::uint8_t, 2 * kTurn + 2 * kByteLanes> farthest_{};  // of kWindow directions from this one on
};

}  // namespace swarmanoid
