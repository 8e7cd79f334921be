// Which Swarmanoid this is. CMake reads the version from here; users may ask for it before they compile against another
// one.
#pragma once

#define SWARMANOID_VERSION_MAJOR 0
#define SWARMANOID_VERSION_MINOR 1
#define SWARMANOID_VERSION_PATCH 0

namespace swarmanoid
{

// "0.1.0".
const char* Version();
// The commit that it was built from, "1a2b3c4d5e6f", with "-dirty" if files of it were changed; empty if it was built
// outside a git checkout.
const char* GitRevision();

}  // namespace swarmanoid
