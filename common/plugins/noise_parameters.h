// The parameters that every noisy sensor and actuator has in experiment files, and their checks. The noise itself is in
// controller_host/devices/noise.h.
#pragma once

#include <string>
#include <vector>

#include "common/configuration/parameter_table.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid
{

// Returns the parameters <prefix>noise_kind, ..._mean, ..._deviation and ..._range, in `unit`. `of` names the disturbed
// value: "each reading".
std::vector<ParameterSpec> NoiseParameters(const std::string& of, const std::string& unit,
                                           const std::string& prefix = "");
// Returns the noise parameters of actuators that set colours.
std::vector<ParameterSpec> ColourNoiseParameters();
// Registers checks that refuse noise without effect: numbers without a kind, or a kind without its numbers. Call it for
// every device; it does nothing for devices without noise parameters.
void CheckNoiseOf(PluginKind kind, const PluginDescription& device);

}  // namespace swarmanoid
