// Defines the release of Fast DDS that this was compiled against.
#pragma once

#if __has_include(<fastdds/config.hpp>)
#include <fastdds/config.hpp>
#define SWARMANOID_FAST_DDS_MAJOR FASTDDS_VERSION_MAJOR
#define SWARMANOID_FAST_DDS_MINOR FASTDDS_VERSION_MINOR
#else
#include <fastrtps/config.h>
#define SWARMANOID_FAST_DDS_MAJOR FASTRTPS_VERSION_MAJOR
#define SWARMANOID_FAST_DDS_MINOR FASTRTPS_VERSION_MINOR
#endif
