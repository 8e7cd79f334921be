#include "common/experiment/entity_kind.h"

// "pillar" is registered by plain_kinds too.
REGISTER_ENTITY_KIND(pillar, {.tag = "pillar",
                              .role = swarmanoid::EntityRole::kObject,
                              .form = swarmanoid::BodyForm::kCylinder})
