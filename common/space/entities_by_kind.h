// Finds the entities of a kind, for experiment functions.
#pragma once

#include <string_view>
#include <vector>

#ifndef SWARMANOID_OWN_SOURCES
#include <common/space/space.h>  // for plug-ins, which mostly need it
#endif

namespace swarmanoid
{

class CSwarmanoidSpace;

// Returns the indices of all entities of a kind, by its tag ("footbot"), ascending. Entities outside the arena are
// included. Throws std::invalid_argument for an unknown tag.
std::vector<std::uint32_t> GetEntitiesByKind(const CSwarmanoidSpace& space, std::string_view tag);

}  // namespace swarmanoid
