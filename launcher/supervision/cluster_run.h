// A run as a cluster of processes, supervised from here.
#pragma once

#include "common/bus/security/run_key.h"
#include "launcher/single_run.h"
#include "launcher/supervision/signal_descriptor.h"
#include "simulation/watched_simulator.h"

namespace swarmanoid
{

// With a `watch`, the space server is this process, and calls it in this thread at each tick. One that never returns is
// left: then `conclude` gets the result, in another thread, and the process ends with the exit code that it returns.
// `options` has the domain. `key`: of the run; none if it is insecure. Adds the domain and the processes to the
// manifest, and writes it. Throws UsageError.
RunResult RunCluster(const RunSettings& options, const Experiment& experiment, const RunFolder& folder,
                     Manifest& manifest, SignalDescriptor& interrupts, const std::optional<RunKey>& key,
                     const WatchFunction& watch, const std::function<int(const RunResult&)>& conclude);

}  // namespace swarmanoid
