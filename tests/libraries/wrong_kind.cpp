#include "common/experiment/entity_kind.h"

REGISTER_ENTITY_KIND(hollow, {.tag = "hollow", .role = swarmanoid::EntityRole::kObject})
