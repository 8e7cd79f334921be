// The simulator as programs of users hold it: tick by tick, many in one process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "common/configuration/configuration_tree.h"
#include "launcher/simulator.h"
#include "test_folders.h"

namespace swarmanoid
{
namespace
{

const std::string kDiffusion = SWARMANOID_SOURCE_FOLDER "/configs/diffusion_10.xml";

SimulatorOptions Quiet()
{
  SimulatorOptions options;
  options.visualisations = false;
  return options;
}

TEST(Simulator, GoesFromTickToTickAndEndsOnce)
{
  const auto experiment = ReadExperiment(kDiffusion, {{"framework.maxclock", "3"}});
  CSimulator simulator(*experiment, Quiet());
  EXPECT_EQ(simulator.GetSpace().GetTick(), 0U);
  EXPECT_TRUE(simulator.Step());
  EXPECT_EQ(simulator.GetSpace().GetTick(), 1U);
  EXPECT_TRUE(simulator.Step());
  EXPECT_TRUE(simulator.Step());
  EXPECT_FALSE(simulator.Step());
  const RunSummary first = simulator.Finish();
  EXPECT_EQ(first.ticks, 3U);
  EXPECT_FALSE(first.failed);
  EXPECT_FALSE(simulator.Step());
  EXPECT_EQ(simulator.Finish().hash, first.hash);
}

TEST(Simulator, SeveralAtOnceAreWorldsOfTheirOwn)
{
  const auto one = ReadExperiment(kDiffusion, {{"framework.maxclock", "50"}});
  const auto other = ReadExperiment(kDiffusion, {{"framework.maxclock", "50"}, {"framework.seed", "2"}});
  CSimulator a(*one, Quiet());
  CSimulator b(*other, Quiet());
  CSimulator c(*one, Quiet());
  while (a.Step() && b.Step() && c.Step()) continue;
  EXPECT_EQ(a.Finish().hash, c.Finish().hash);
  EXPECT_NE(a.Finish().hash, b.Finish().hash);
}

TEST(Simulator, MistakesOfTheFileAreToldAllAtOnce)
{
  try
  {
    ReadExperiment(kDiffusion, {{"framework.maxclok", "3"}, {"framework.clocktick", "0"}});
    FAIL();
  }
  catch (const ConfigurationError& error)
  {
    EXPECT_THAT(error.what(), testing::HasSubstr("maxclok"));
    EXPECT_THAT(error.what(), testing::HasSubstr("clocktick"));
  }
  EXPECT_THROW(ReadExperiment("/nowhere.xml"), ConfigurationError);
}

}  // namespace
}  // namespace swarmanoid
