// The engines that come with the simulator, each described in the file of its name. Their code: engine_worker/engines.
#pragma once

#include <string>
#include <vector>

#include "common/plugins/catalogue.h"

namespace swarmanoid
{

// `label`: kinematics2d, or dummy_engine, its older name.
PluginDescription Kinematics2dDescription(const std::string& label);
PluginDescription Dynamics2dDescription();
PluginDescription Dynamics3dDescription();

// Where the plane of a two-dimensional engine lies: perpendicular_axis, distance, tilt.
std::vector<ParameterSpec> PlaneParameters();
// Those of engines on a plane that serve handbots and eyebots with PlaneRobots, after `own`.
std::vector<std::string> WithChannelsOfPlaneRobots(std::vector<std::string> own);

}  // namespace swarmanoid
