// Reads worlds and models in SDF, the Simulation Description Format of Gazebo (http://sdformat.org), for
// `swarmanoid convert`.
#pragma once

#include <string>

#include "launcher/worlds/imported_world.h"

namespace swarmanoid
{

// Reads a tree whose root is <sdf>. `file`: its path, where names of mesh files start.
World ReadSdfWorld(const ConfigurationNode& root, const std::string& file);

}  // namespace swarmanoid
