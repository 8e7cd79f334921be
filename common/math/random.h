// Counter-based random numbers (Philox4x32-10, Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", 2011).
// A stream is named by (seed, entity, device, tick), so that the order of evaluation cannot change a result.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace swarmanoid
{

// The raw generator: ten rounds over a 128-bit counter with a 64-bit key.
std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

// A stable 32-bit name for a device or purpose ("footbot_proximity", "placement"), usable as a stream's device key.
constexpr std::uint32_t StreamName(std::string_view text)
{
  std::uint32_t hash = 2166136261U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return hash;
}

// The random numbers of one device of one entity in one tick. Cheap to make, never shared.
class RandomStream
{
public:
  RandomStream(std::uint64_t seed, std::uint32_t entity, std::uint32_t device, std::uint32_t tick)
      : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
        counter_{0, entity, device, tick}
  {
  }

  std::uint32_t Bits();
  // Uniform in [0, 1), 53 random bits.
  double Uniform();
  // Uniform in [low, high).
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  // Normal with the given mean and standard deviation (Box-Muller over the project's own Log and SinCosOf).
  double Gaussian(double mean = 0, double deviation = 1);
  // Uniform integer in [0, count); count must be positive.
  std::uint32_t Below(std::uint32_t count);

private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  unsigned used_ = 4;
};

}  // namespace swarmanoid
