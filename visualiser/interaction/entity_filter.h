// Which entities a list shows: those in which every word of a filter is found. "fb_1" is looked for everywhere,
// "kind:footbot", "id:", "controller:", "engine:" and "host:" in that column alone.
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

  // Entity indices, ascending. Capital letters do not matter; no word: all of them.
  const std::vector<std::uint32_t>& Matching(std::string_view filter);

private:
  // Of each entity, in lower case: a line "column:text" for each column.
  std::vector<std::string> texts_;
  std::string filter_;
  std::vector<std::uint32_t> matching_;
};

}  // namespace swarmanoid
