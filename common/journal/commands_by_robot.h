// CommandsByRobot: what the controller hosts of a run commanded at a tick, as others would have said it that have the
// same robots. For processes that do ticks again which were done before the robots were shared out anew, and for those
// who compare.
#pragma once

#include <optional>
#include <vector>

#include "common/journal/journal_format.h"
#include "common/messages/assignment.h"
#include "common/messages/tick_messages.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

class CommandsByRobot
{
public:
  // To the hosts of the assignment, which outlives this, as the space does.
  CommandsByRobot(const CSwarmanoidSpace& space, const Assignment& to) : space_(space), to_(to) {}

  // What `hosts` commanded.
  std::vector<ControlCommands> Of(const HostTable& hosts, const std::vector<ControlCommands>& commands);
  // The first `ticks` ticks of a block.
  std::vector<char> Of(const HostTable& hosts, std::vector<char> block, std::uint32_t ticks);

private:
  struct Copy
  {
    std::size_t source = 0;  // host
    std::size_t from = 0;
    std::size_t host = 0;
    std::size_t to = 0;
    std::size_t count = 0;  // doubles
  };

  void MakeCopies(const HostTable& hosts);

  const CSwarmanoidSpace& space_;
  const Assignment& to_;
  // Made for those who were last asked of.
  std::optional<HostTable> from_;
  std::vector<Copy> copies_;
};

}  // namespace swarmanoid
