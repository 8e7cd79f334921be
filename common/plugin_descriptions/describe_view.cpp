#include "common/plugin_descriptions/renderers.h"

namespace swarmanoid
{

std::vector<ParameterSpec> ViewpointParameters()
{
  return {{"camera_view_XYZ_n", ParameterType::kVector3, "m", std::nullopt,
           "Where viewpoint n (0 to 9) stands; the first one given is where the visualisation starts.", -1e6, 1e6},
          {"camera_view_HPR_n", ParameterType::kVector3, "degrees", "0, 0, 0",
           "Heading, pitch and roll of viewpoint n: heading 0 looks along x, 90 along y; a negative pitch looks down.",
           -1e5, 1e5}};
}

std::vector<ParameterSpec> QualityParameters()
{
  return {
      {"use_textures", ParameterType::kBoolean, "", "true", "Whether floor and walls have a texture."},
      {"use_shadows", ParameterType::kBoolean, "", "true", "Whether bodies throw shadows; the most expensive switch."},
      {"antialiasing", ParameterType::kInteger, "", "4",
       "Samples a pixel that smooth edges; 0 draws fastest, with jagged edges.", 0, 16},
      {"show_ids", ParameterType::kBoolean, "", "false", "Whether robots and preys have their ids as labels."},
      {"show_trails", ParameterType::kBoolean, "", "false", "Whether robots and preys leave a trail."},
      {"show_rays", ParameterType::kBoolean, "", "false",
       "Whether the rays of proximity sensors are drawn, red where they meet something, and the cones of directional "
       "LEDs "
       "that are lit."},
      {"show_collision_models", ParameterType::kBoolean, "", "false",
       "Whether the bodies that the engines collide are drawn over the robots."}};
}

}  // namespace swarmanoid
