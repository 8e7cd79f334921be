// The sensors and actuators of the simulator, each described in the file of its robot. Their code is in
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
void DescribeFloorFieldDevices();

// Describes the light sensors of footbots and eyebots.
void DescribeLight(const std::string& robot);
// Returns the parameters of the ground sensors of footbots and of other robots.
std::vector<ParameterSpec> GroundParameters();
// Returns the parameters of the rings of LEDs of all robots.
std::vector<ParameterSpec> LedRingParameters();
// Adds a device to the catalogue, with the checks of its noise.
void DescribeSensor(const PluginDescription& sensor);
void DescribeActuator(const PluginDescription& actuator);

// Returns the mistakes in generic_footbot_polynomial_proximity: invalid coefficients, and default coefficients beyond
// the distances that they were fitted to.
std::vector<ConfigurationError> MistakesInPolynomial(const Parameters& parameters);

}  // namespace swarmanoid
