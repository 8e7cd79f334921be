// Reads worlds of the simulator Webots (.wbt) for `swarmanoid convert`.
#pragma once

#include <string>
#include <string_view>

#include "launcher/worlds/imported_world.h"

namespace swarmanoid
{

// Reads a text. `file`: its path, where names of mesh files start. Throws ConfigurationError at a mistake of syntax.
World ReadWebotsWorld(std::string_view text, const std::string& file);

}  // namespace swarmanoid
