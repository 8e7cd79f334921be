// The simulators that the function of a user's program sees, which looks at each tick of a run. Used by the runs in one
// process and as a cluster.
#pragma once

#include "launcher/simulator.h"

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
  // One to look at the space server of a cluster.
  static CSimulator Of(SpaceServer& server) { return CSimulator(server); }
};

}  // namespace swarmanoid
