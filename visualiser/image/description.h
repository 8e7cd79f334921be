// The name and parameters of image_render: ImageRenderDescription. For includes of users; ours is common/builtins.
#pragma once

#include "common/builtins/renderers.h"
