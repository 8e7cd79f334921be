// The parameters that all renderers of pictures share: viewpoints and quality. Light: the library `render` describes
// the renderers with it, without their graphics libraries.
#pragma once

#include <vector>

#include "common/configuration/parameter.h"

namespace swarmanoid
{

// camera_view_XYZ_n, camera_view_HPR_n.
std::vector<ParameterSpec> ViewpointParameters();
// use_textures, use_shadows, antialiasing, show_ids, show_trails, show_rays, show_collision_models.
std::vector<ParameterSpec> QualityParameters();

}  // namespace swarmanoid
