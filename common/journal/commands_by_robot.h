// CommandsByRobot: converts the commands of a run's controller hosts at a tick into those of other hosts with the same
// robots. Used to repeat ticks from before the robots were assigned to other hosts, and to compare runs.
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
  // Converts to the hosts of the assignment. The assignment and the space must outlive the object.
  CommandsByRobot(const CSwarmanoidSpace& space, const Assignment& to) : space_(space), to_(to) {}

  // Returns what the hosts of the assignment would have sent, from the commands that `hosts` sent at a tick. Converted
  // ones have no texts of faults.
  std::vector<ControlCommands> Of(const HostTable& hosts, const std::vector<ControlCommands>& commands);
  // Returns the first `ticks` ticks of a block of the journal, with such commands. Throws std::runtime_error if the
  // block is damaged.
  std::vector<char> Of(const HostTable& hosts, std::vector<char> block, std::uint32_t ticks);

private:
  struct Copy
  {
    std::size_t source = 0;  // index of the host
    std::size_t from = 0;
    std::size_t host = 0;
    std::size_t to = 0;
    std::size_t count = 0;  // doubles
  };

  void MakeCopies(const HostTable& hosts);

  const CSwarmanoidSpace& space_;
  const Assignment& to_;
  // The table of hosts for which the plan was made.
  std::optional<HostTable> from_;
  std::vector<Copy> copies_;
};

}  // namespace swarmanoid
