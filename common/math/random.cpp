#include "common/math/random.h"

#include <algorithm>

#include "common/math/normal.h"

namespace swarmanoid
{

std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key)
{
  for (int round = 0; round < 10; ++round)
  {
    const std::uint64_t product0 = 0xD2511F53ULL * counter[0];
    const std::uint64_t product1 = 0xCD9E8D57ULL * counter[2];
    counter = {static_cast<std::uint32_t>(product1 >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(product1),
               static_cast<std::uint32_t>(product0 >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(product0)};
    key[0] += 0x9E3779B9U;
    key[1] += 0xBB67AE85U;
  }
  return counter;
}

std::uint32_t RandomStream::Bits()
{
  if (used_ == 4)
  {
    block_ = Philox4x32(counter_, key_);
    ++counter_[0];
    used_ = 0;
  }
  return block_[used_++];
}

double RandomStream::Uniform()
{
  const std::uint64_t high = Bits();
  const std::uint64_t low = Bits();
  return static_cast<double>(((high << 32) | low) >> 11) * 0x1.0p-53;
}

double RandomStream::Centred()
{
  // The result is the middle of one of 2^53 equal parts: an odd multiple of 2^-54, exact.
  const std::uint64_t high = Bits();
  const std::uint64_t low = Bits();
  const auto part = static_cast<std::int64_t>(((high << 32) | low) >> 11);
  return static_cast<double>(2 * part + 1 - (std::int64_t{1} << 53)) * 0x1.0p-54;
}

double RandomStream::Gaussian(double mean, double deviation) { return mean + deviation * NormalQuantile(Centred()); }

double RandomStream::TruncatedGaussian(double mean, double deviation, double range)
{
  const double centred = Centred();
  if (!(deviation > 0) || !(range > 0)) return mean;
  const double away = deviation * NormalQuantile(2 * NormalMass(range / deviation) * centred);
  return mean + std::clamp(away, -range, range);
}

std::uint32_t RandomStream::Below(std::uint32_t count)
{
  // This is Lemire's multiplication; the bias is below count / 2^32.
  return static_cast<std::uint32_t>((static_cast<std::uint64_t>(Bits()) * count) >> 32);
}

}  // namespace swarmanoid
