// Finds the processes of a run that are late, for messages to users. The main thread of the space_server program uses
// it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/bus/membership/server_session.h"

namespace swarmanoid
{

struct LateProcess
{
  std::string name;
  std::string doing;  // the activity that it reported; may be empty
};

// Returns the processes whose answer to `tick` is missing, or the processes that they in turn wait for, each once.
std::vector<LateProcess> LateProcesses(const ServerSession& session, const std::vector<std::string>& missing,
                                       std::uint64_t tick);

// Returns the status of all processes of a run that has waited for `missing` to answer `tick` for `waited_s`.
std::vector<ProcessStatus> ProcessesNow(const ServerSession& session, std::uint64_t tick,
                                        const std::vector<std::string>& missing, double waited_s);

}  // namespace swarmanoid
