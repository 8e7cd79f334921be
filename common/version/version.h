// This is the version of Swarmanoid. CMake reads it from here. Users may test it before they compile against another
// version.
#pragma once

#define SWARMANOID_VERSION_MAJOR 1
#define SWARMANOID_VERSION_MINOR 0
#define SWARMANOID_VERSION_PATCH 0

namespace swarmanoid
{

// Returns the version, such as "1.0.0".
const char* Version();
// Returns the commit of the build, such as "1a2b3c4d5e6f", with "-dirty" if files of it were changed. It is empty for a
// build outside a git checkout.
const char* GitRevision();

}  // namespace swarmanoid
