// The name and parameters of opengl_render: OpenGlRenderDescription. For includes of users; ours is common/builtins.
#pragma once

#include "common/builtins/renderers.h"
