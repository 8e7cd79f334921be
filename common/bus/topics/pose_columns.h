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

// Copies doubles and returns whether all are finite, in one pass over memory.
inline bool CopyFinite(double* to, const char* from, std::size_t count)
{
  constexpr std::size_t kBlock = 512;  // stays in the cache between the two loops
  constexpr std::uint64_t kExponent = 0x7ffULL << 52U;
  std::uint64_t carried = 0;
  for (std::size_t start = 0; start < count; start += kBlock)
  {
    const std::size_t some = std::min(kBlock, count - start);
    std::memcpy(to + start, from + start * sizeof(double), some * sizeof(double));
    // One more than the exponent of infinity and NaN carries into the sign.
    for (std::size_t k = start; k < start + some; ++k)
      carried |= (std::bit_cast<std::uint64_t>(to[k]) & kExponent) + (1ULL << 52U);
  }
  return carried >> 63U == 0;
}

enum class ColumnMistake
{
  kNone,
  kLength,    // no poses have so many numbers with these flags
  kNotFinite  // the poses must not be used
};

// Expands the received columns, `count` doubles at `from`, to all seven. `poses` usually has the numbers of an earlier
// message: a uniform column that has the number already is only read.
inline ColumnMistake SpreadColumns(const char* from, std::size_t count, std::uint32_t uniform,
                                   std::vector<double>& poses)
{
  if (uniform == 0)
  {
    poses.resize(count);
    return CopyFinite(poses.data(), from, count) ? ColumnMistake::kNone : ColumnMistake::kNotFinite;
  }
  const auto single = static_cast<std::size_t>(std::popcount(uniform));
  if (single >= kPoseColumns || count <= single || (count - single) % (kPoseColumns - single) != 0)
    return ColumnMistake::kLength;
  const std::size_t entities = (count - single) / (kPoseColumns - single);
  poses.resize(kPoseColumns * entities);
  bool finite = true;
  for (std::size_t k = 0; k < kPoseColumns; ++k)
  {
    double* column = poses.data() + k * entities;
    const bool whole = (uniform >> k & 1U) == 0;
    if (whole)
      finite &= CopyFinite(column, from, entities);
    else
    {
      double value = 0;
      finite &= CopyFinite(&value, from, 1);
      if (std::memcmp(column, &value, sizeof value) != 0 ||
          std::memcmp(column, column + 1, (entities - 1) * sizeof value) != 0)
        std::fill_n(column, entities, value);
    }
    from += (whole ? entities : 1) * sizeof(double);
  }
  return finite ? ColumnMistake::kNone : ColumnMistake::kNotFinite;
}

}  // namespace swarmanoid
