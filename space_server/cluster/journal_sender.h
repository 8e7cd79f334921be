// JournalSender: sends the journal to processes that replace others. The main thread of the space_server program uses
// it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/bus/membership/server_session.h"
#include "common/journal/commands_by_robot.h"
#include "common/journal/journal_writer.h"
#include "space_server/cluster/lockstep.h"

namespace swarmanoid
{

class JournalSender
{
public:
  JournalSender(ServerSession& session, Lockstep& lockstep, const CSwarmanoidSpace& space, const Assignment& assignment,
                JournalWriter* journal);

  // Answers the pending requests for the journal. Throws BusError for a process that cannot be replaced because the
  // journal has ended.
  void Work();

private:
  // The content for one process: blocks of the journal, then a block of the tick at which the run waits.
  struct Plan
  {
    std::vector<JournalPlace> places;
    std::vector<char> last;
  };
  Plan MakePlan(const std::string& name);
  // Returns a block of the journal in the layout of the present controller hosts.
  std::vector<char> BlockAt(const JournalPlace& place);

  ServerSession& session_;
  Lockstep& lockstep_;
  const Assignment& assignment_;
  bool acts_later_;  // commands act a tick later
  CommandsByRobot shared_;
  JournalWriter* journal_;
  std::map<std::string, Plan> plans_;  // by process
};

}  // namespace swarmanoid
