// RecoveryService: sends the journal to processes that take the place of others. Used by the main thread of the
// space_server program.
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

class RecoveryService
{
public:
  RecoveryService(ServerSession& session, Lockstep& lockstep, const CSwarmanoidSpace& space,
                  const Assignment& assignment, JournalWriter* journal)
      : session_(session), lockstep_(lockstep), assignment_(assignment), shared_(space, assignment), journal_(journal)
  {
  }

  // Answers what was asked for. Throws BusError for what nobody can take the place of, as the journal has ended.
  void Work();

private:
  // What one process is sent: blocks of the journal, then one of the tick that the run waits at.
  struct Plan
  {
    std::vector<JournalPlace> places;
    std::vector<char> last;
  };
  Plan MakePlan(const std::string& name);
  // As the present controller hosts understand it.
  std::vector<char> BlockAt(const JournalPlace& place);

  ServerSession& session_;
  Lockstep& lockstep_;
  const Assignment& assignment_;
  CommandsByRobot shared_;
  JournalWriter* journal_;
  std::map<std::string, Plan> plans_;  // by process
};

}  // namespace swarmanoid
