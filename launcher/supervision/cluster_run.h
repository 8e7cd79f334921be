// Runs a planned cluster: starts its processes, supervises them and says how it went.
#pragma once

#include <functional>
#include <optional>

#include "common/run/access/run_key.h"
#include "launcher/supervision/cluster_plan.h"
#include "launcher/supervision/prepared_run.h"
#include "launcher/supervision/signal_descriptor.h"

namespace swarmanoid
{

// Adds the processes to the manifest, and writes it. With a watch function, the space server is this
// process, and calls it in this thread at each tick. If that function never returns, `conclude` gets the result in
// another thread, and this process ends with the exit code that it returns. `key`: of the run; none if it is insecure.
RunResult RunCluster(const ClusterPlan& plan, PreparedRun& run, const std::optional<RunKey>& key,
                     SignalDescriptor& interrupts, const std::function<int(const RunResult&)>& conclude);

}  // namespace swarmanoid
