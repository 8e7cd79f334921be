#include "controller_host/devices/noise.h"

#include <algorithm>

namespace swarmanoid
{

double NoiseModel::Sample(RandomStream& random) const
{
  switch (kind)
  {
    case Kind::kUniform:
      return mean + random.Uniform(-range, range);
    case Kind::kGaussian:
    {
      const double sample = random.Gaussian(0, deviation);
      return mean + (range > 0 ? std::clamp(sample, -range, range) : sample);
    }
    default:
      return 0;
  }
}

std::vector<ParameterSpec> NoiseParameters(const std::string& of, const std::string& unit, const std::string& prefix)
{
  return {{.name = prefix + "noise_kind",
           .type = ParameterType::kChoice,
           .unit = "",
           .default_value = "none",
           .description = "Kind of the noise added to " + of + ".",
           .choices = {"none", "uniform", "gaussian"}},
          {.name = prefix + "noise_mean",
           .unit = unit,
           .default_value = "0",
           .description = "Mean of the noise on " + of + ": a systematic error."},
          {.name = prefix + "noise_deviation",
           .unit = unit,
           .default_value = "0",
           .description = "Standard deviation of Gaussian noise on " + of + ".",
           .minimum = 0},
          {.name = prefix + "noise_range",
           .unit = unit,
           .default_value = "0",
           .description = "Uniform noise lies within the mean +- this; Gaussian noise is cut to it where it is not 0.",
           .minimum = 0}};
}

NoiseModel NoiseFrom(const Parameters& parameters, const std::string& prefix)
{
  const std::string kind = parameters.Text(prefix + "noise_kind");
  NoiseModel noise;
  noise.kind = kind == "uniform"    ? NoiseModel::Kind::kUniform
               : kind == "gaussian" ? NoiseModel::Kind::kGaussian
                                    : NoiseModel::Kind::kNone;
  noise.mean = parameters.Number(prefix + "noise_mean");
  noise.deviation = parameters.Number(prefix + "noise_deviation");
  noise.range = parameters.Number(prefix + "noise_range");
  return noise;
}

std::vector<ParameterSpec> Joined(std::vector<ParameterSpec> own, const std::vector<ParameterSpec>& more)
{
  own.insert(own.end(), more.begin(), more.end());
  return own;
}

}  // namespace swarmanoid
