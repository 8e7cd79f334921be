// ENABLE_VTABLE and its like.
#pragma once

#include <argos3/core/utility/plugins/refused.h>
