#include "visualiser/opengl/description.h"

#include "visualiser/interaction/window_parameters.h"
#include "visualiser/scene/view_parameters.h"

namespace swarmanoid
{

PluginDescription OpenGlRenderDescription()
{
  PluginDescription description;
  description.label = "opengl_render";
  description.brief = "a window on the arena, with panels to watch and steer the run; needs a display";
  for (std::vector<ParameterSpec> more : {WindowParameters(), ViewpointParameters(), QualityParameters()})
    description.parameters.insert(description.parameters.end(), more.begin(), more.end());
  return description;
}

}  // namespace swarmanoid
