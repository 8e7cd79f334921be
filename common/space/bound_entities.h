// IsBound tells which entities hang together with others, or with the ceiling: they keep their engine.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "common/space/attributes.h"
#include "common/space/space.h"

namespace swarmanoid
{

// Returns whether an entity grips or is gripped, or hangs by a rope or a magnet.
inline bool IsBound(const CSwarmanoidSpace& space, std::uint32_t entity)
{
  if (!space.Structure().GetHolders(entity).empty()) return true;
  if (std::ranges::any_of(space.Hands(entity), [](double hand) { return hand != 0; })) return true;
  const CSwarmanoidSpaceEntity& it = space.GetEntity(entity);
  return std::ranges::any_of(std::array{"rope_attached", "attached"}, [&](const char* name)
                             { return FindAttribute(it.GetKind(), name) != nullptr && it.GetAttribute(name) != 0; });
}

}  // namespace swarmanoid
