// The parameters that all renderers with a window share. Light, as view_parameters.h.
#pragma once

#include <vector>

#include "common/configuration/parameter.h"

namespace swarmanoid
{

// window_size, window_title, write_frames, frame_directory, frame_filename, every, max_frame_rate, show_panels.
std::vector<ParameterSpec> WindowParameters();

}  // namespace swarmanoid
