// What a user's kind looks like: the parts that its row lists, or its body with its LEDs. Used by Scene, and by the web
// renderer, which sends it to its pages.
#pragma once

#include "common/experiment/entity_kind.h"
#include "visualiser/scene/mesh.h"

namespace swarmanoid
{

// Of a row without parts whose entities give their own sizes: of size 1, to be scaled by them.
Model KindModel(const EntityKindDescription& kind);
bool IsScaled(const EntityKindDescription& kind);

}  // namespace swarmanoid
