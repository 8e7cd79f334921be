// Method: a cylinder surely hides everything behind it in the directions between its tangents, without the outermost
// two on each side. Lay takes the least such distance for each direction, over two turns, so that no range needs to
// wrap. `farthest_` has the largest of kWindow directions, so that a range of directions is tested with few reads.
//
// Invariant: distances and directions are rounded so that "surely hidden" is never wrong; doubt costs only an exact
// test.
#include "controller_host/devices/sensing/disc_cover.h"

#include <algorithm>

namespace swarmanoid
{
namespace
{

constexpr std::uint8_t kUnknown = 255;

// Reading kByteLanes bytes from kByteLanes - n on gives n bytes of 0, then others.
constexpr auto kBeyond = []
{
  std::array<std::uint8_t, 2 * kByteLanes> bytes{};
  for (std::size_t i = kByteLanes; i < bytes.size(); ++i) bytes[i] = kUnknown;
  return bytes;
}();

}  // namespace

inline void DiscCover::Cover(std::size_t first, int directions, std::uint8_t distance)
{
  const ByteLanes behind = Everywhere(distance);
  for (std::uint8_t* to = &behind_[first]; directions > 0; directions -= kByteLanes, to += kByteLanes)
  {
    const int those = std::min(directions, kByteLanes);
    const ByteLanes beyond = LoadLanes(&kBeyond[static_cast<std::size_t>(kByteLanes - those)]);
    StoreLanes(Minimum(LoadLanes(to), behind | beyond), to);
  }
}

void DiscCover::Lay(const DirectionBytes& bytes, std::size_t count)
{
  for (std::size_t i = 0; i < behind_.size(); i += kByteLanes) StoreLanes(Everywhere(kUnknown), &behind_[i]);
  // Fewer directions are not worth it. The masks find cylinders that surely hide so many, by their whole entries.
  constexpr int kEdge = 2, kFewest = 3;
  constexpr int kWidth = 0xff00, kLeastWidth = (kFewest + 2 * kEdge - 1) << 8, kNotSure = kUnknown << 16;
  for (std::size_t i = 0; i < count; i += kLanes)
    ForEachBit(LaneMask(((LoadLanes(&bytes.meets[i]) & kWidth) >= kLeastWidth) &
                        (LoadLanes(&bytes.middles[i]) < kNotSure) & FirstLanes(count - i)),
               [&](unsigned lane)
               {
                 const std::int32_t meets = bytes.meets[i + lane];
                 const int directions = (meets >> 8 & 255) - (2 * kEdge - 1);
                 Cover(static_cast<std::size_t>(meets & 255) + kEdge, directions,
                       static_cast<std::uint8_t>(bytes.middles[i + lane] >> 16));
               });
  for (std::size_t i = 0; i < kTurn; i += kByteLanes)
    StoreLanes(Minimum(LoadLanes(&behind_[i]), LoadLanes(&behind_[i + kTurn])), &behind_[i]);
  for (std::size_t i = 0; i < 2 * kByteLanes; i += kByteLanes) StoreLanes(LoadLanes(&behind_[i]), &behind_[i + kTurn]);
  for (std::size_t i = 0; i < kTurn + kByteLanes; i += kByteLanes)
  {
    ByteLanes farthest = LoadLanes(&behind_[i]);
    for (std::size_t k = 1; k < kWindow; ++k) farthest = Maximum(farthest, LoadLanes(&behind_[i + k]));
    StoreLanes(farthest, &farthest_[i]);
  }
}

IntLanes DiscCover::HidesMiddles(IntLanes middles) const
{
  return SecondByte(middles) >= Gathered(behind_.data(), LowestByte(middles));
}

IntLanes DiscCover::HidesAll(IntLanes meets) const
{
  constexpr int kMost = 2 * kWindow - 1;
  const IntLanes begin = LowestByte(meets);
  const IntLanes width = SecondByte(meets);
  const IntLanes near = ThirdByte(meets);
  const IntLanes more = width - static_cast<int>(kWindow - 1);
  const IntLanes second = begin + (more < 0 ? IntLanes{} : more);
  const IntLanes one = Gathered(farthest_.data(), begin);
  const IntLanes other = Gathered(farthest_.data(), second);
  return (width <= kMost) & (near >= one) & (near >= other);
}

}  // namespace swarmanoid
