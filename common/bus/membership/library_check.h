// Which libraries a worker loads: those that the World of its run names by their digests, and if its key came from
// elsewhere than from this user, only from folders that it was itself started with. Used by WorkerSession.
#pragma once

#include <vector>

#include "common/bus/topics/session_messages.h"

namespace swarmanoid
{

// From now on, for the whole process. `own_folders_only`: those of StandardPluginFolders alone.
void AllowOnly(const std::vector<WorldLibrary>& libraries, bool own_folders_only);

}  // namespace swarmanoid
