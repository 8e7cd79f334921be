// Init of a controller as every runtime calls it, in the simulator and on the robot. Controllers that declared their
// parameters were checked before; of all others, what Init did not ask for is refused here.
#pragma once

#include <string>

#include "common/control_interface/ci_controller.h"

namespace swarmanoid
{

// What Init returned. `id`: of the controller in the experiment file. Throws what Init throws, and ConfigurationError
// with each parameter that it never read, its place and the nearest of those that it did read.
int InitController(CCI_Controller& controller, const PluginDescription& description, const std::string& id,
                   const TConfigurationTree& parameters);

}  // namespace swarmanoid
