// The simulator's renderers are described each in the file of its name, and those with a window in
// window_renderers.cpp. Their code is in visualiser/.
#pragma once

#include <vector>

#include "common/plugins/catalogue.h"

namespace swarmanoid
{

PluginDescription TextRenderDescription();
PluginDescription ImageRenderDescription();
PluginDescription FigureRenderDescription();
PluginDescription OpenGlRenderDescription();
PluginDescription OgreRenderDescription();
PluginDescription WebRenderDescription();
PluginDescription PageRenderDescription();
PluginDescription Ros2RenderDescription();
PluginDescription FoxgloveRenderDescription();

// Returns the parameters of the viewpoints: camera_view_XYZ_n, camera_view_HPR_n.
std::vector<ParameterSpec> ViewpointParameters();
// Returns use_textures, use_shadows, antialiasing, show_ids, show_trails, show_rays, show_collision_models.
std::vector<ParameterSpec> QualityParameters();
// Returns the parameters of renderers with a window: window_size, window_title, write_frames, frame_directory,
// frame_filename, every, max_frame_rate, show_panels.
std::vector<ParameterSpec> WindowParameters();

}  // namespace swarmanoid
