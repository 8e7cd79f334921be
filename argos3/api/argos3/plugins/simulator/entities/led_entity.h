// CLEDEntity and CLEDEquippedEntity.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>
