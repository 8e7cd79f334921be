// The simulators that the function of a user's program sees, which looks at each tick of a run. Used by the runs in one
// process and as a cluster.
#pragma once

#include "common/checkpoint/checkpoint.h"
#include "simulation/simulator.h"

namespace swarmanoid
{

using WatchFunction = std::function<void(CSimulator&)>;

struct WatchedSimulator
{
  // One that runs the experiment, and calls `watch`.
  static CSimulator Running(const Experiment& experiment, const SimulatorOptions& options, WatchFunction watch)
  {
    return {experiment, options, std::move(watch)};
  }
  // One with as many controller hosts as the cluster whose checkpoints it reads and takes.
  static CSimulator Computing(const Experiment& experiment, const SimulatorOptions& options, unsigned hosts)
  {
    return {experiment, options, {}, hosts};
  }
  static Checkpoint CheckpointOf(CSimulator& simulator, bool canonicalise)
  {
    return simulator.TakeCheckpoint(canonicalise);
  }
  static bool IsCanonical(const CSimulator& simulator) { return simulator.IsCanonical(); }
  // One to look at the space server of a cluster.
  static CSimulator Of(SpaceServer& server) { return CSimulator(server); }
};

}  // namespace swarmanoid
