// How a process takes the place of another one that has died: the server sends it, block by block, what the other one
// took in since the newest tick at which its state was saved, and it does the same again, without a word to anybody.
// Used by the programs of engines, hosts and visualisers before their first step.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "common/bus/membership/worker_session.h"
#include "common/bus/membership/worker_world.h"
#include "common/journal/tick_records.h"

namespace swarmanoid
{

struct RecoverySteps
{
  std::function<void()> begin;                  // from where the run began, since no state was saved
  std::function<void(ByteReader& state)> load;  // from a saved state
  // The space has the state of the record. The last one of a host may be of the tick that the run waits at, and has no
  // commands. `next`: the record after it, or null.
  std::function<void(const TickRecord& record, const TickRecord* next)> step{};
  std::function<void(const std::vector<SensorFrame>&)>
      frames{};  // of the tick that comes next; none if it is the first
};

// Until the tick that the process waits for, which is returned. Throws BusError.
std::uint64_t Recover(WorkerSession& session, WorkerWorld& replica, const RecoverySteps& steps);

// The process is not the one that it takes the place of: it computed something else.
[[noreturn]] void RefuseRecovery(const std::string& name, std::uint64_t tick, const std::string& what);

}  // namespace swarmanoid
