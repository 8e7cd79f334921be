#include "engine_worker/engines/rigid_bodies/fused_libraries.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swarmanoid
{
namespace
{

// Debian compiles them for the baseline of x86-64, which cannot fuse, and for aarch64, which does.
TEST(FusedLibraries, AreThoseOfAarch64)
{
  std::vector<std::string> names;
  FindFusedLibraries(names);
#if defined(__aarch64__)
  EXPECT_THAT(names, testing::ElementsAre("Box2D", "ODE"));
#else
  EXPECT_THAT(names, testing::IsEmpty());
#endif
}

}  // namespace
}  // namespace swarmanoid
