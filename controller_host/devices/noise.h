// The one noise model of all sensors and actuators, from the counter-based streams. Each sample takes one uniform
// number, whatever the kind: another kind or size of noise disturbs by the same numbers, scaled.
#pragma once

#include <string>

#include "common/configuration/parameter.h"
#include "common/math/random.h"
#include "common/plugins/noise_parameters.h"

namespace swarmanoid
{

struct NoiseModel
{
  enum class Kind
  {
    kNone,
    kUniform,   // mean + U(-range, range)
    kGaussian,  // mean + N(0, deviation), what lies beyond mean +- range put onto the border if range is positive
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

// Returns the noise that the parameters of NoiseParameters(…, prefix) describe.
NoiseModel NoiseFrom(const Parameters& parameters, const std::string& prefix = "");

}  // namespace swarmanoid
