// Selects the entities that a list shows: those that contain every word of a filter. "fb_1" is searched in all columns;
// "kind:footbot", "id:", "controller:", "engine:" and "host:" only in that column.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/messages/assignment.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

class EntityFilter
{
public:
  EntityFilter(const CSwarmanoidSpace& space, const Assignment& assignment);

  // Returns entity indices, ascending. Case does not matter; an empty filter gives all entities.
  const std::vector<std::uint32_t>& Matching(std::string_view filter);

private:
  // Each text is that of an entity, in lower case: a line "column:text" for each column.
  std::vector<std::string> texts_;
  std::string filter_;
  std::vector<std::uint32_t> matching_;
};

}  // namespace swarmanoid
