// The parameters that renderers of pictures share: ViewpointParameters and QualityParameters.
#pragma once

#include "common/builtins/renderers.h"
