// The sensors and actuators that come with the simulator, described in the file of their robot. Their code:
// controller_host/devices.
#pragma once

#include <string>
#include <vector>

#include "common/plugins/catalogue.h"

namespace swarmanoid
{

void DescribeFootbotDevices();
void DescribeEyebotDevices();
void DescribeHandbotDevices();
void DescribeCameras();
void DescribeRangeAndBearing();
void DescribeAnyRobotDevices();
void DescribeSurroundingsDevices();

// The light sensors of footbots and eyebots.
void DescribeLight(const std::string& robot);
// Of the ground sensors of footbots and of others.
std::vector<ParameterSpec> GroundParameters();
// For these: adds a device to the catalogue, and the checks of its noise.
void DescribeSensor(const PluginDescription& sensor);
void DescribeActuator(const PluginDescription& actuator);

// Of generic_footbot_polynomial_proximity: coefficients that are no numbers; the default ones beyond the distances that
// they were fitted to.
std::vector<ConfigurationError> MistakesInPolynomial(const Parameters& parameters);

}  // namespace swarmanoid
