// Init of a controller as every runtime calls it, in the simulator and on the robot. Controllers that declared their
// parameters were checked before; of all others, what Init did not ask for is refused here.
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
