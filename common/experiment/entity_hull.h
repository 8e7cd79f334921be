// The hulls of entities that collide as one instead of a box. For the reader of experiments.
#pragma once

#include <memory>

#include "common/experiment/element_reader.h"
#include "common/experiment/sections.h"
#include "common/mesh/convex_hull.h"

namespace swarmanoid
{

// By the corners of the row of its kind, or the parameters "corners" and "convex" of its element; nullptr for what
// collides as its body says. Mistakes are reported. `entity`: with kind and size.
std::shared_ptr<const ConvexHull> HullOfEntity(const ElementReader& reader, const EntityConfiguration& entity,
                                               Reading& reading);

}  // namespace swarmanoid
