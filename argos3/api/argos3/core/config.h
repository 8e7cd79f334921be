// What the build of ARGoS3 tells its users: Real is a double, controllers are libraries that are loaded.
#pragma once

#define ARGOS_DOUBLE_PRECISION
#define ARGOS_USE_DOUBLE
#define ARGOS_DYNAMIC_LIBRARY_LOADING
