// The one noise model of all sensors and actuators: uniform or Gaussian, from the counter-based streams.
#pragma once

#include <string>
#include <vector>

#include "common/configuration/parameter.h"
#include "common/math/random.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid
{

struct NoiseModel
{
  enum class Kind
  {
    kNone,
    kUniform,   // mean + U(-range, range)
    kGaussian,  // mean + N(0, deviation), cut to mean +- range where range is positive
  };

  Kind kind = Kind::kNone;
  double mean = 0;
  double deviation = 0;
  double range = 0;

  bool IsActive() const { return kind != Kind::kNone; }
  double Sample(RandomStream& random) const;
};

// The parameters <prefix>noise_kind, ..._mean, ..._deviation and ..._range, in `unit`. `of` says what is disturbed:
// "each reading".
std::vector<ParameterSpec> NoiseParameters(const std::string& of, const std::string& unit,
                                           const std::string& prefix = "");
NoiseModel NoiseFrom(const Parameters& parameters, const std::string& prefix = "");
// Has the reader of experiment files refuse noise that would be none: numbers without a kind, a kind without its
// numbers. For every device; nothing for those without such parameters.
void CheckNoiseOf(PluginKind kind, const PluginDescription& device);

// `own`, followed by `more`: tables of parameters are put together from parts.
std::vector<ParameterSpec> Joined(std::vector<ParameterSpec> own, const std::vector<ParameterSpec>& more);

}  // namespace swarmanoid
