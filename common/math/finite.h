#pragma once

#include <bit>
#include <cstdint>
#include <span>

namespace swarmanoid
{

// Returns whether no number is infinite or NaN: the exponents of those have all bits, so that adding one to an exponent
// carries into the sign.
inline bool AllFinite(std::span<const double> values)
{
  constexpr std::uint64_t kExponent = 0x7ff0'0000'0000'0000;
  constexpr std::uint64_t kOne = 0x0010'0000'0000'0000;
  std::uint64_t sums = 0;
  for (const double value : values) sums |= (std::bit_cast<std::uint64_t>(value) & kExponent) + kOne;
  return sums >> 63U == 0;
}

}  // namespace swarmanoid
