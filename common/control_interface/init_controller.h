// Calls Init of a controller in the same way in every runtime, in the simulator and on the robot. Parameters that a
// controller declared were checked before. For other controllers, parameters that Init did not read are refused here.
#pragma once

#include <string>

#include "common/control_interface/ci_controller.h"

namespace swarmanoid
{

// Calls Init and returns its result. `id` is the controller's id in the experiment file. Passes on exceptions of Init.
// Throws ConfigurationError with each parameter that Init never read, its position and the nearest parameter that Init
// did read.
int InitController(CCI_Controller& controller, const PluginDescription& description, const std::string& id,
                   const TConfigurationTree& parameters);

}  // namespace swarmanoid
