// SharedCommands: what the controller hosts of a run commanded at a tick, as another number of hosts would have said
// it. For processes that do ticks again which were done before the robots were shared out anew. Used by the space
// server.
#pragma once

#include <vector>

#include "common/journal/journal_format.h"
#include "common/messages/assignment.h"
#include "common/messages/messages.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

class SharedCommands
{
public:
  // From `hosts` to those of the assignment, which outlives this, as the space does.
  SharedCommands(const CSwarmanoidSpace& space, std::size_t hosts, const Assignment& to);

  std::vector<ControlCommands> Of(const std::vector<ControlCommands>& commands) const;
  // A block of ticks.
  std::vector<char> Of(std::span<const char> block) const;

private:
  struct Copy
  {
    std::size_t source = 0;  // host
    std::size_t from = 0;
    std::size_t host = 0;
    std::size_t to = 0;
    std::size_t count = 0;  // doubles
  };

  const CSwarmanoidSpace& space_;
  const Assignment& to_;
  std::vector<Copy> copies_;
};

}  // namespace swarmanoid
