#include "controller_host/devices/noise.h"

#include <algorithm>

#include "common/math/normal.h"

namespace swarmanoid
{

double NoiseModel::Sample(RandomStream& random) const
{
  switch (kind)
  {
    case Kind::kUniform:
      return mean + 2 * range * random.Centred();
    case Kind::kGaussian:
    {
      const double sample = deviation * NormalQuantile(random.Centred());
      return mean + (range > 0 ? std::clamp(sample, -range, range) : sample);
    }
    case Kind::kTruncatedGaussian:
      return mean + std::clamp(deviation * NormalQuantile(2 * mass * random.Centred()), -range, range);
    default:
      return 0;
  }
}

NoiseModel NoiseFrom(const Parameters& parameters, const std::string& prefix)
{
  const std::string kind = parameters.Text(prefix + "noise_kind");
  NoiseModel noise;
  noise.kind = kind == "uniform"              ? NoiseModel::Kind::kUniform
               : kind == "gaussian"           ? NoiseModel::Kind::kGaussian
               : kind == "truncated_gaussian" ? NoiseModel::Kind::kTruncatedGaussian
                                              : NoiseModel::Kind::kNone;
  noise.mean = parameters.Number(prefix + "noise_mean");
  noise.deviation = parameters.Number(prefix + "noise_deviation");
  noise.range = parameters.Number(prefix + "noise_range");
  if (noise.kind == NoiseModel::Kind::kTruncatedGaussian && noise.deviation > 0)
    noise.mass = NormalMass(noise.range / noise.deviation);
  return noise;
}

}  // namespace swarmanoid
