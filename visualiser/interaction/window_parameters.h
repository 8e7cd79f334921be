// The parameters that renderers with a window share: WindowParameters.
#pragma once

#include "common/builtins/renderers.h"
