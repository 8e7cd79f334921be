// The name and parameters of web_render: WebRenderDescription. For includes of users; ours is common/builtins.
#pragma once

#include "common/builtins/renderers.h"
