// Restricts the libraries that a worker loads. The World of its run names the allowed ones by their digests. If the key
// came from another user, only the folders that the worker was started with are allowed. WorkerSession uses it.
#pragma once

#include <vector>

#include "idl/messages.h"

namespace swarmanoid
{

// Sets the allowed libraries for the whole process. `own_folders_only`: allows only those in StandardPluginFolders.
void AllowOnly(const std::vector<WorldLibrary>& libraries, bool own_folders_only);

}  // namespace swarmanoid
