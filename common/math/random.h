// Counter-based random numbers (Philox4x32-10, Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", 2011).
// A stream is named, not passed on: by the seed, who draws (an id), for what (a device, a step), when (the tick) and
// with whom (another entity, an LED). So neither the order of evaluation nor anybody else's draws can change a number.
// docs/determinism.md says what stays the same under which change.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace swarmanoid
{

// The raw generator: ten rounds over a 128-bit counter with a 64-bit key.
std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

// A one-to-one mixing of 64 bits, so that near inputs give far outputs (the finaliser of MurmurHash3).
constexpr std::uint64_t MixedBits(std::uint64_t bits)
{
  bits = (bits ^ bits >> 33) * 0xff51afd7ed558ccdULL;
  bits = (bits ^ bits >> 33) * 0xc4ceb9fe1a85ec53ULL;
  return bits ^ bits >> 33;
}

// The stable 64-bit name of an id, a device or a purpose (FNV-1a, mixed). Experiment files with two ids of one name are
// refused.
constexpr std::uint64_t StreamName(std::string_view text)
{
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return MixedBits(hash);
}

// The name of a numbered part of what has `name`: an LED of a robot, a wave of a terrain.
constexpr std::uint64_t StreamPart(std::uint64_t name, std::uint64_t part)
{
  return MixedBits(name + (part + 1) * 0x9e3779b97f4a7c15ULL);
}

// Who draws, and for what, under one seed. Worth keeping by those who draw in every tick: it takes a block of Philox.
class StreamKey
{
public:
  StreamKey(std::uint64_t seed, std::uint64_t who, std::uint64_t what)
      : words_(Philox4x32({static_cast<std::uint32_t>(who), static_cast<std::uint32_t>(who >> 32),
                           static_cast<std::uint32_t>(what), static_cast<std::uint32_t>(what >> 32)},
                          {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}))
  {
  }

private:
  friend class RandomStream;
  std::array<std::uint32_t, 4> words_;
};

// The random numbers of one name in one tick. Cheap to make; draws nothing until it is asked. Cannot be copied: the
// copy would draw the same numbers again.
class RandomStream
{
public:
  // Half of the key's words are Philox's key, the others hide in the words of `whom`: all 128 bits tell streams apart.
  RandomStream(const StreamKey& key, std::uint64_t tick, std::uint64_t whom = 0)
      : key_{key.words_[0], key.words_[1]},
        counter_{0, static_cast<std::uint32_t>(tick), key.words_[2] ^ static_cast<std::uint32_t>(whom),
                 key.words_[3] ^ static_cast<std::uint32_t>(whom >> 32) ^ static_cast<std::uint32_t>(tick >> 32)}
  {
  }
  RandomStream(std::uint64_t seed, std::uint64_t who, std::uint64_t what, std::uint64_t tick, std::uint64_t whom = 0)
      : RandomStream(StreamKey(seed, who, what), tick, whom)
  {
  }
  RandomStream(const RandomStream&) = delete;
  RandomStream& operator=(const RandomStream&) = delete;
  RandomStream(RandomStream&&) = default;
  RandomStream& operator=(RandomStream&&) = default;

  std::uint32_t Bits();
  // Uniform in [0, 1), 53 random bits.
  double Uniform();
  // Uniform in [low, high). Where rounding would give `high`, it gives `low`.
  double Uniform(double low, double high)
  {
    const double value = low + (high - low) * Uniform();
    return value == high && low < high ? low : value;
  }
  // Uniform in (-1/2, 1/2), both ends excluded and as near: for those who invert a distribution.
  double Centred();
  // Normal with the given mean and standard deviation; like all distributions here by inversion of one Centred().
  double Gaussian(double mean = 0, double deviation = 1);
  // Normal, given that it lies within mean +- range: no mass at the borders. 0 for `deviation` or `range` gives the
  // mean. Its deviation is less than `deviation`: docs/devices.md has the closed form.
  double TruncatedGaussian(double mean, double deviation, double range);
  // Uniform integer in [0, count); count must be positive.
  std::uint32_t Below(std::uint32_t count);

private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  unsigned used_ = 4;
};

}  // namespace swarmanoid
