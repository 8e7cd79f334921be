// The poses of a message: seven columns, one after the other. A column with the same bits for all entities is sent as
// one number, such as the height of robots on a plane. Used by message_fields.h.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

namespace swarmanoid
{

inline constexpr std::size_t kPoseColumns = 7;

// Bit k: column k goes as one number. At least one column stays whole: its length is the number of entities.
inline std::uint32_t UniformColumns(const std::vector<double>& poses)
{
  const std::size_t entities = poses.size() / kPoseColumns;
  if (entities < 2 || poses.size() % kPoseColumns != 0) return 0;
  std::uint32_t uniform = 0;
  for (std::size_t k = 0; k < kPoseColumns && std::popcount(uniform) + 1 < static_cast<int>(kPoseColumns); ++k)
  {
    const double* column = poses.data() + k * entities;
    if (std::memcmp(column, column + 1, (entities - 1) * sizeof(double)) == 0) uniform |= 1U << k;
  }
  return uniform;
}

// Expands the received columns. Returns false if no poses have these numbers.
inline bool SpreadColumns(std::vector<double>& numbers, std::uint32_t uniform)
{
  if (uniform == 0) return true;
  const auto single = static_cast<std::size_t>(std::popcount(uniform));
  if (single >= kPoseColumns || numbers.size() <= single || (numbers.size() - single) % (kPoseColumns - single) != 0)
    return false;
  const std::size_t entities = (numbers.size() - single) / (kPoseColumns - single);
  std::size_t from = numbers.size();
  numbers.resize(kPoseColumns * entities);
  // The loop starts with the last column, so that columns still to be read are not overwritten.
  for (std::size_t k = kPoseColumns; k-- > 0;)
  {
    double* column = numbers.data() + k * entities;
    const bool whole = (uniform >> k & 1U) == 0;
    from -= whole ? entities : 1;
    if (whole)
      std::memmove(column, numbers.data() + from, entities * sizeof(double));
    else
      std::fill_n(column, entities, double{numbers[from]});
  }
  return true;
}

}  // namespace swarmanoid
