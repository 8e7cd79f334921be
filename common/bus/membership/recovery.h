// Recovers a process that replaces a dead one. The server sends, in blocks, all inputs of the dead process since its
// newest saved state. The new process repeats those steps and sends nothing meanwhile. Engines, hosts and visualisers
// use it before their first step.
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
  std::function<void()> begin;                  // starts at the beginning of the run, if no state was saved
  std::function<void(ByteReader& state)> load;  // loads a saved state
  // Repeats a step; the space has the state of the record. The last record of a host may belong to the tick that the
  // run waits at, and has no commands. `next`: the record after it, or null.
  std::function<void(const TickRecord& record, const TickRecord* next)> step{};
  std::function<void(const std::vector<SensorFrame>&)>
      frames{};  // takes the frames of the next tick; empty if no tick comes before it
};

// Recovers up to the tick that the process waits for, and returns that tick. Throws BusError.
std::uint64_t Recover(WorkerSession& session, WorkerWorld& replica, const RecoverySteps& steps);

// Refuses a recovery whose results differ from those of the dead process.
[[noreturn]] void RefuseRecovery(const std::string& name, std::uint64_t tick, const std::string& what);

}  // namespace swarmanoid
