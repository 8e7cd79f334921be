// The gripper of a robot, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>
