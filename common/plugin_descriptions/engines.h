// The engines of the simulator, each described in the file of its name. Their code is in engine_worker/engines.
#pragma once

#include <string>
#include <vector>

#include "common/plugins/catalogue.h"

namespace swarmanoid
{

// `label`: kinematics2d, or its older name dummy_engine.
PluginDescription Kinematics2dDescription(const std::string& label);
PluginDescription Dynamics2dDescription();
PluginDescription Dynamics3dDescription();

// Returns the parameters that place the plane of a two-dimensional engine: perpendicular_axis, distance, tilt.
std::vector<ParameterSpec> PlaneParameters();
// Returns the parameter `threads` of engines that share their work between threads.
ParameterSpec ThreadsParameter();
// Returns `own` and the channels of engines on a plane that serve handbots and eyebots with PlaneRobots.
std::vector<std::string> WithChannelsOfPlaneRobots(std::vector<std::string> own);

}  // namespace swarmanoid
