// The name and parameters of ogre_render, for the registry and the reference; needs no graphics library.
#pragma once

#include "common/plugins/catalogue.h"

namespace swarmanoid
{

PluginDescription OgreRenderDescription();

}  // namespace swarmanoid
