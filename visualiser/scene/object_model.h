// What an object looks like whose element names a mesh of its own, or that is a hull.
#pragma once

#include <string>

#include "common/experiment/experiment.h"
#include "visualiser/scene/mesh.h"

namespace swarmanoid
{

// Tells apart what is drawn differently; empty for an entity without a mesh or hull.
std::string ObjectModelName(const EntityConfiguration& entity, const std::string& experiment_folder);

// The mesh, turned as the entity says, or the hull, stretched to fill a body of size 1, to be scaled by the entity's
// size: a box of side 1, or a cylinder of radius 1 and height 1. Throws ConfigurationError at the attribute for a file
// that cannot be read.
Model ObjectModel(const EntityConfiguration& entity, const std::string& experiment_folder);

}  // namespace swarmanoid
