// The wheels of a robot, as loop functions see them.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>
