// The name and parameters of ogre_render: OgreRenderDescription. For includes of users; ours is common/builtins.
#pragma once

#include "common/builtins/renderers.h"
