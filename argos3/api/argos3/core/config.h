// What the build of ARGoS3 tells its users: Real is a double, controllers are libraries that are loaded.
#pragma once

// The headers are C++11 but for constants that are inline, which compilers take anyway, and warn of.
#if __cplusplus < 201703L && defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wc++17-extensions"
#endif

#define ARGOS_DOUBLE_PRECISION
#define ARGOS_USE_DOUBLE
#define ARGOS_DYNAMIC_LIBRARY_LOADING
