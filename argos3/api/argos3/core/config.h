// The constants that the build of ARGoS3 gives its users: Real is a double, and controllers are loaded from libraries.
#pragma once

// The headers are C++11 except for inline constants, which older compilers accept with a warning.
#if __cplusplus < 201703L && defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wc++17-extensions"
#endif

#define ARGOS_DOUBLE_PRECISION
#define ARGOS_USE_DOUBLE
#define ARGOS_DYNAMIC_LIBRARY_LOADING
