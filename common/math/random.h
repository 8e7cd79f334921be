// Counter-based random numbers (Philox4x32-10, Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", 2011). A
// stream is identified by the seed, the id that draws, the purpose (a device, a step), the tick, and a partner (another
// entity, an LED). So neither the order of evaluation nor other draws can change a number. docs/determinism.md states
// what stays the same under which change.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace swarmanoid
{

// Computes the raw generator: ten rounds over a 128-bit counter with a 64-bit key.
std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

// Mixes 64 bits one-to-one, so that near inputs give far outputs (the finaliser of MurmurHash3).
constexpr std::uint64_t MixedBits(std::uint64_t bits)
{
  bits = (bits ^ bits >> 33) * 0xff51afd7ed558ccdULL;
  bits = (bits ^ bits >> 33) * 0xc4ceb9fe1a85ec53ULL;
  return bits ^ bits >> 33;
}

// Returns the stable 64-bit name of an id, a device or a purpose (FNV-1a, mixed). Experiment files with two ids of one
// name are refused.
constexpr std::uint64_t StreamName(std::string_view text)
{
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return MixedBits(hash);
}

// Returns the name of a numbered part of the owner of `name`: an LED of a robot, a wave of a terrain.
constexpr std::uint64_t StreamPart(std::uint64_t name, std::uint64_t part)
{
  return MixedBits(name + (part + 1) * 0x9e3779b97f4a7c15ULL);
}

// The id that draws and the purpose, under one seed. Keep it if you draw in every tick, since making it takes a block
// of Philox.
class StreamKey
{
public:
  StreamKey(std::uint64_t seed, std::uint64_t entity, std::uint64_t purpose)
      : words_(Philox4x32({static_cast<std::uint32_t>(entity), static_cast<std::uint32_t>(entity >> 32),
                           static_cast<std::uint32_t>(purpose), static_cast<std::uint32_t>(purpose >> 32)},
                          {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}))
  {
  }

private:
  friend class RandomStream;
  std::array<std::uint32_t, 4> words_;
};

// A stream gives the random numbers of one name in one tick. Making it is cheap; it draws only on request. It cannot be
// copied, since the copy would draw the same numbers again.
class RandomStream
{
public:
  // Half of the key's words are Philox's key; the others are mixed into the words of `other`. All 128 bits distinguish
  // streams.
  RandomStream(const StreamKey& key, std::uint64_t tick, std::uint64_t other = 0)
      : key_{key.words_[0], key.words_[1]},
        counter_{0, static_cast<std::uint32_t>(tick), key.words_[2] ^ static_cast<std::uint32_t>(other),
                 key.words_[3] ^ static_cast<std::uint32_t>(other >> 32) ^ static_cast<std::uint32_t>(tick >> 32)}
  {
  }
  RandomStream(std::uint64_t seed, std::uint64_t entity, std::uint64_t purpose, std::uint64_t tick,
               std::uint64_t other = 0)
      : RandomStream(StreamKey(seed, entity, purpose), tick, other)
  {
  }
  RandomStream(const RandomStream&) = delete;
  RandomStream& operator=(const RandomStream&) = delete;
  RandomStream(RandomStream&&) = default;
  RandomStream& operator=(RandomStream&&) = default;

  // Returns 32 random bits.
  std::uint32_t Bits();
  // Returns a uniform number in [0, 1) with 53 random bits.
  double Uniform();
  // Returns a uniform number in [low, high). If rounding would give `high`, it returns `low`.
  double Uniform(double low, double high)
  {
    const double value = low + (high - low) * Uniform();
    return value == high && low < high ? low : value;
  }
  // Returns a uniform number in (-1/2, 1/2), with equal distances to both excluded ends, for inverting a distribution.
  double Centred();
  // Returns a normal number with the given mean and standard deviation, by inversion of one Centred(), as all
  // distributions here.
  double Gaussian(double mean = 0, double deviation = 1);
  // Returns a normal number, given that it lies within mean +- range: no mass is at the borders. If `deviation` or
  // `range` is 0, it returns the mean. Its deviation is less than `deviation`: docs/devices.md has the closed form.
  double TruncatedGaussian(double mean, double deviation, double range);
  // Returns a uniform integer in [0, count); count must be positive.
  std::uint32_t Below(std::uint32_t count);

private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  unsigned used_ = 4;
};

}  // namespace swarmanoid
