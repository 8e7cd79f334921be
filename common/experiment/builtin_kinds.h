// The rows of the simulator's own kinds, in the order of EntityKind. Only entity_kinds.cpp includes this header.
#pragma once

#include <vector>

#include "common/experiment/entity_kind.h"

namespace swarmanoid
{

// Returns the rows of the simulator's own kinds.
std::vector<EntityKindDescription> OwnKinds();

// Make the parameters that several kinds have.
ParameterSpec ControllerParameter();
ParameterSpec MassParameter();
ParameterSpec ConvexParameter();
ParameterSpec CornersParameter();
ParameterSpec FrictionParameter();
ParameterSpec RestitutionParameter();
ParameterSpec GroundFrictionParameter();
ParameterSpec GroundTorqueParameter();
ParameterSpec MovableParameter();
ParameterSpec ColourParameter(std::string default_value);
ParameterSpec IntensityParameter();
ParameterSpec BoxSizeParameter();
ParameterSpec RadiusParameter();
ParameterSpec HeightParameter();
ParameterSpec AreaSizeParameter();
ParameterSpec AreaRadiusParameter();
ParameterSpec PictureParameter();
ParameterSpec MeshParameter();
ParameterSpec MeshOrientationParameter();

}  // namespace swarmanoid
