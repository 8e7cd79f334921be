// The one noise model of all sensors and actuators, from the counter-based streams. Each sample takes one uniform
// number, whatever the kind: another kind or size of noise disturbs by the same numbers, scaled.
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
    kGaussian,  // mean + N(0, deviation), what lies beyond mean +- range put onto the border where range is positive
    kTruncatedGaussian,  // mean + N(0, deviation) given that it lies within mean +- range
  };

  Kind kind = Kind::kNone;
  double mean = 0;
  double deviation = 0;
  double range = 0;
  double mass = 0;  // truncated: of the normal distribution within 0 ... range

  bool IsActive() const { return kind != Kind::kNone; }
  double Sample(RandomStream& random) const;
  double Sample(RandomStream&& random) const { return Sample(random); }
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
