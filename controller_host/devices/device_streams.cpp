// Problem: draw millions of normal numbers in a tick, each from a stream of its own.
//
// Method: Philox4x32 (J. K. Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011) turns a key and a
// counter into four words without any state. Lanes compute several counters at once, and kGroupsAtOnce groups overlap,
// since each round waits for the one before. Two words give a number in (-1/2, 1/2) with 53 bits, and the normal
// quantile function turns it into a sample.
//
// Invariant: each number has the bits that RandomStream gives for the same key and counter.
#include "controller_host/devices/device_streams.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "common/math/lanes.h"
#include "common/math/normal.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

typedef std::uint64_t UnsignedLongLanes __attribute__((vector_size(kDoubleLanes * sizeof(double))));
UnsignedLongLanes Everywhere(std::uint64_t value) { return UnsignedLongLanes{} + value; }

// The lanes of two in turn: a[0], b[0], a[1], b[1] …
void StorePairs(DoubleLanes a, DoubleLanes b, double* to)
{
#if defined(__AVX__)
  StoreLanes(__builtin_shufflevector(a, b, 0, 4, 1, 5), to);
  StoreLanes(__builtin_shufflevector(a, b, 2, 6, 3, 7), to + kDoubleLanes);
#else
  StoreLanes(__builtin_shufflevector(a, b, 0, 2), to);
  StoreLanes(__builtin_shufflevector(a, b, 1, 3), to + kDoubleLanes);
#endif
}
// Returns the products of the lower halves.
UnsignedLongLanes ProductOfLow(UnsignedLongLanes a, UnsignedLongLanes b)
{
#if defined(__AVX2__)
  return reinterpret_cast<UnsignedLongLanes>(
      _mm256_mul_epu32(reinterpret_cast<__m256i>(a), reinterpret_cast<__m256i>(b)));
#elif defined(__SSE2__) && !defined(__AVX__)
  return reinterpret_cast<UnsignedLongLanes>(_mm_mul_epu32(reinterpret_cast<__m128i>(a), reinterpret_cast<__m128i>(b)));
#else
  constexpr std::uint64_t kLow = 0xffffffff;
  return (a & kLow) * (b & kLow);
#endif
}
constexpr int kRounds = 10;
constexpr std::size_t kGroupsAtOnce = 3;  // as many as the registers hold
constexpr std::uint32_t kMultipliers[2] = {0xD2511F53U, 0xCD9E8D57U};
constexpr std::uint32_t kKeySteps[2] = {0x9E3779B9U, 0xBB67AE85U};

// Each lane has a word of 32 bits. The bits above may have any value.
using Words = std::array<UnsignedLongLanes, 4>;

// Computes Philox4x32 for as many counters as there are lanes, kTimes at once. Each round depends on the one before, so
// several independent computations overlap.
template <std::size_t kTimes>
std::array<Words, kTimes> PhiloxEach(std::array<Words, kTimes> counters, std::array<std::uint32_t, 2> key)
{
  for (int round = 0; round < kRounds; ++round)
  {
    const UnsignedLongLanes keys[2] = {Everywhere(std::uint64_t{key[0]}), Everywhere(std::uint64_t{key[1]})};
#pragma GCC unroll 8
    for (std::size_t k = 0; k < kTimes; ++k)
    {
      Words& counter = counters[k];
      const UnsignedLongLanes product0 = ProductOfLow(counter[0], Everywhere(std::uint64_t{kMultipliers[0]}));
      const UnsignedLongLanes product1 = ProductOfLow(counter[2], Everywhere(std::uint64_t{kMultipliers[1]}));
      counter = {(product1 >> 32) ^ counter[1] ^ keys[0], product1, (product0 >> 32) ^ counter[3] ^ keys[1], product0};
    }
    key[0] += kKeySteps[0];
    key[1] += kKeySteps[1];
  }
  return counters;
}

// Calls draw<groups>(first) for all numbers from 0 to before `count`: with several groups of kGroup where that many are
// left, at the end with one, which may reach beyond them.
template <std::size_t kGroup, class Draw>
void InGroups(std::size_t count, const Draw& draw)
{
  std::size_t first = 0;
  for (; first + kGroup < count; first += kGroupsAtOnce * kGroup) draw.template operator()<kGroupsAtOnce>(first);
  if (first < count) draw.template operator()<1>(first);
}

// Makes the numbers of RandomStream::Centred from two words: the 53 highest bits of both, in two parts that doubles
// hold exactly.
DoubleLanes CentredOf(UnsignedLongLanes high, UnsignedLongLanes low)
{
  constexpr std::uint64_t kWord = 0xffffffff;
  constexpr std::uint64_t kAsDouble = 0x4330000000000000;  // 2^52
  const UnsignedLongLanes upper = (high & kWord) >> 11;
  const UnsignedLongLanes lower = (high << 21 | (low & kWord) >> 11) & kWord;
  const auto upper_part = reinterpret_cast<DoubleLanes>(upper | kAsDouble) - (0x1p52 + 0x1p20);
  const auto lower_part = reinterpret_cast<DoubleLanes>(lower | kAsDouble) - 0x1p52;
  return upper_part * 0x1p-21 + (lower_part * 0x1p-53 + 0x1p-54);
}

// Returns first, first + 1 … in the lanes.
UnsignedLongLanes Numbered(std::uint64_t first)
{
  std::array<std::uint64_t, kDoubleLanes> numbers;
  for (std::uint64_t& number : numbers) number = first++;
  return LoadAs<UnsignedLongLanes>(numbers.data());
}

// The words that RandomStream(key, tick, other) is made of.
struct StreamWords
{
  StreamWords(const StreamKey& stream, std::uint64_t tick)
  {
    static_assert(sizeof stream == 4 * sizeof(std::uint32_t));
    const auto words = std::bit_cast<std::array<std::uint32_t, 4>>(stream);
    key = {words[0], words[1]};
    counter[1] = Everywhere(tick);
    counter[2] = Everywhere(std::uint64_t{words[2]});
    counter[3] = Everywhere(words[3] ^ (tick >> 32));
  }

  std::array<std::uint32_t, 2> key;
  Words counter{};
};

// Turns such numbers into the samples of NoiseModel::Sample, in place.
void MakeSamples(const NoiseModel& noise, std::span<double> samples)
{
  if (noise.kind == NoiseModel::Kind::kTruncatedGaussian)
    for (double& sample : samples) sample = 2 * noise.mass * sample;
  if (noise.kind == NoiseModel::Kind::kUniform)
    for (double& sample : samples) sample = noise.mean + 2 * noise.range * sample;
  else
  {
    NormalQuantiles(samples);
    const bool is_limited = noise.kind == NoiseModel::Kind::kTruncatedGaussian || noise.range > 0;
    const double limit = is_limited ? noise.range : std::numeric_limits<double>::infinity();
    for (double& sample : samples) sample = noise.mean + std::clamp(noise.deviation * sample, -limit, limit);
  }
}

}  // namespace

DeviceStreams::DeviceStreams(const DeviceSetup& setup, std::string_view quantity)
    : space_(&setup.space),
      robots_(setup.robots),
      what_(quantity.empty() ? setup.stream : MixedBits(setup.stream ^ StreamName(quantity)))
{
}

RandomStream DeviceStreams::Of(std::size_t k) const { return {Key(k), space_->StreamTick()}; }

RandomStream DeviceStreams::Of(std::size_t k, std::uint64_t other) const
{
  return {Key(k), space_->StreamTick(), other};
}

void DeviceStreams::Draw(std::size_t k, std::span<double> numbers) const
{
  StreamWords stream(Key(k), space_->StreamTick());
  constexpr std::size_t kGroup = 2 * kDoubleLanes;  // a block gives two samples
  const auto draw = [&]<std::size_t kGroups>(std::size_t first)
  {
    std::array<Words, kGroups> counters;
    for (std::size_t g = 0; g < kGroups; ++g)
    {
      counters[g] = stream.counter;
      counters[g][0] = Numbered(first / 2 + g * kDoubleLanes);
    }
    const std::array<Words, kGroups> words = PhiloxEach(counters, stream.key);
    std::array<double, kGroups * kGroup> drawn;
    for (std::size_t g = 0; g < kGroups; ++g)
      StorePairs(CentredOf(words[g][0], words[g][1]), CentredOf(words[g][2], words[g][3]), &drawn[g * kGroup]);
    std::copy_n(drawn.begin(), std::min(drawn.size(), numbers.size() - first), &numbers[first]);
  };
  InGroups<kGroup>(numbers.size(), draw);
}

void DeviceStreams::Sample(const NoiseModel& noise, std::size_t k, std::span<double> samples) const
{
  Draw(k, samples);
  MakeSamples(noise, samples);
}

void DeviceStreams::Sample(const NoiseModel& noise, std::span<const std::uint32_t> ks, std::span<double> samples) const
{
  if (ks.empty()) return;
  const std::size_t each = samples.size() / ks.size();
  for (std::size_t i = 0; i < ks.size(); ++i) Draw(ks[i], samples.subspan(i * each, each));
  MakeSamples(noise, samples);
}

void DeviceStreams::Sample(const NoiseModel& noise, std::size_t k, std::span<const std::uint64_t> others,
                           std::span<double> samples) const
{
  const StreamWords stream(Key(k), space_->StreamTick());
  const auto draw = [&]<std::size_t kGroups>(std::size_t first)
  {
    std::array<std::uint64_t, kGroups * kDoubleLanes> some{};
    const std::size_t count = std::min(some.size(), others.size() - first);
    std::copy_n(&others[first], count, some.begin());
    std::array<Words, kGroups> counters;
    for (std::size_t g = 0; g < kGroups; ++g)
    {
      const auto other = LoadAs<UnsignedLongLanes>(&some[g * kDoubleLanes]);
      counters[g] = stream.counter;
      counters[g][2] ^= other;
      counters[g][3] ^= other >> 32;
    }
    const std::array<Words, kGroups> words = PhiloxEach(counters, stream.key);
    std::array<double, kGroups * kDoubleLanes> drawn;
    for (std::size_t g = 0; g < kGroups; ++g) StoreLanes(CentredOf(words[g][0], words[g][1]), &drawn[g * kDoubleLanes]);
    std::copy_n(drawn.begin(), count, &samples[first]);
  };
  InGroups<kDoubleLanes>(others.size(), draw);
  MakeSamples(noise, samples);
}

void DeviceStreams::MakeKeys() const
{
  keys_.reserve(robots_.size());
  for (const std::uint32_t robot : robots_)
    keys_.emplace_back(space_->GetExperiment().seed, StreamName(space_->GetEntity(robot).GetId()), what_);
}

}  // namespace swarmanoid
