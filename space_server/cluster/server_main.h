// The program space_server: its options, and the run. Users' simulations do the same in their own process
// (launcher/supervision/in_process_server.h).
#pragma once

#include "common/program/program.h"
#include "space_server/cluster/server_program.h"

namespace swarmanoid
{

void AddServerOptions(CLI::App& app, ServerOptions& options);
// Reads the experiment and serves it. Returns the exit code, also if the run has failed; the status channel has the
// reason.
int Serve(const ServerOptions& options);

}  // namespace swarmanoid
