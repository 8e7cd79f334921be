#include "visualiser/ogre/description.h"

#include "visualiser/interaction/window_parameters.h"
#include "visualiser/scene/view_parameters.h"

namespace swarmanoid
{

PluginDescription OgreRenderDescription()
{
  PluginDescription description;
  description.label = "ogre_render";
  description.brief = "a window drawn by OGRE, with materials and soft shadows, and the same panels; needs a display";
  for (std::vector<ParameterSpec> more : {WindowParameters(), ViewpointParameters(), QualityParameters()})
    description.parameters.insert(description.parameters.end(), more.begin(), more.end());
  return description;
}

}  // namespace swarmanoid
