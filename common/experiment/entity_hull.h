// Some entities collide as a convex hull instead of a box. The reader of experiments makes their hulls here.
#pragma once

#include <memory>

#include "common/experiment/element_reader.h"
#include "common/experiment/sections.h"
#include "common/mesh/convex_hull.h"

namespace swarmanoid
{

// Returns the hull from the corners in the row of the kind, or from the parameters "corners" and "convex" of the
// element. Returns nullptr for entities without a hull. Mistakes are reported. `entity`: with kind and size.
std::shared_ptr<const ConvexHull> HullOfEntity(const ElementReader& reader, const EntityConfiguration& entity,
                                               Reading& reading);

}  // namespace swarmanoid
