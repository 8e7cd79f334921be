// What the reader of experiment files and `swarmanoid list` know of web_render. Part of the library `render`.
#pragma once

#include "common/plugins/catalogue.h"

namespace swarmanoid
{

PluginDescription WebRenderDescription();

}  // namespace swarmanoid
