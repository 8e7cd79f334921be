// The parameters that every noisy sensor and actuator has in experiment files, and what the reader refuses of them. The
// noise itself: controller_host/devices/noise.h.
#pragma once

#include <string>
#include <vector>

#include "common/configuration/parameter_table.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid
{

// The parameters <prefix>noise_kind, ..._mean, ..._deviation and ..._range, in `unit`. `of` says what is disturbed:
// "each reading".
std::vector<ParameterSpec> NoiseParameters(const std::string& of, const std::string& unit,
                                           const std::string& prefix = "");
// Of actuators that set colours.
std::vector<ParameterSpec> ColourNoiseParameters();
// Has the reader of experiment files refuse noise that would be none: numbers without a kind, a kind without its
// numbers. For every device; nothing for those without such parameters.
void CheckNoiseOf(PluginKind kind, const PluginDescription& device);

}  // namespace swarmanoid
