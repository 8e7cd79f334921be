// The model of an object whose element names its own mesh, or that is a hull.
#pragma once

#include <string>

#include "common/experiment/experiment.h"
#include "visualiser/scene/mesh.h"

namespace swarmanoid
{

// Returns a name that differs for different models; empty for an entity without a mesh or hull.
std::string ObjectModelName(const EntityConfiguration& entity, const std::string& experiment_folder);

// Returns the mesh, turned as the entity says, or the hull, stretched to fill a body of size 1. The entity's size
// scales it: a box of side 1, or a cylinder of radius 1 and height 1. Throws ConfigurationError at the attribute for a
// file that cannot be read.
Model ObjectModel(const EntityConfiguration& entity, const std::string& experiment_folder);

}  // namespace swarmanoid
