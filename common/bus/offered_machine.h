// A machine that somebody offers to a run (`controller_host --offer NAME`), and the processes that stand, beside the
// launcher, for workers that run there (`--through NAME`). docs/recovery.md tells users, docs/wire.md the messages.
#pragma once

#include <string>

#include "common/bus/cluster_options.h"

namespace swarmanoid
{

// Offers this machine under settings.offer until the run ends or a signal asks for the end; then its workers move away
// first. Returns the exit code. Throws UsageError if the run does not take the offer, BusError if there is no run.
int OfferMachine(const WorkerSettings& settings, const BusOptions& options);

// Stands for the worker of `program` that runs on the machine settings.through: writes what it writes, and ends as it
// ends. kExitMachineGone: nobody offers the machine any more, or the worker was not started there.
int RunThroughMachine(const std::string& program, WorkerTable table, const WorkerSettings& settings,
                      const BusOptions& options);

}  // namespace swarmanoid
