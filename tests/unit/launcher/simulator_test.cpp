// The simulator as programs of users hold it: tick by tick, many in one process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <type_traits>

#include "common/configuration/configuration_tree.h"
#include "simulation/simulator.h"
#include "space_server/experiment_functions.h"
#include "test_folders.h"
#include "tests/world/message_of.h"

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

// The space is const; what a program changes goes through the same rules as experiment functions.
TEST(Simulator, ProgramsChangeTheExperimentByTheEditorAlone)
{
  static_assert(std::is_same_v<decltype(std::declval<CSimulator&>().GetSpace()), const CSwarmanoidSpace&>);
  const auto experiment = ReadExperiment(kDiffusion, {{"framework.maxclock", "3"}});
  const auto hash = [&](const std::function<void(SpaceEditor&)>& change)
  {
    CSimulator simulator(*experiment, Quiet());
    simulator.Step();
    change(simulator.GetEditor());
    while (simulator.Step()) continue;
    return simulator.Finish().hash;
  };
  const std::string robot = "fb_0";
  const Pose pose{{1.5, 1.5, 0}, Quaternion::Identity()};
  const std::uint64_t unchanged = hash([](SpaceEditor&) {});
  const std::uint64_t moved = hash([&](SpaceEditor& editor) { editor.MoveEntity(robot, pose); });
  EXPECT_NE(moved, unchanged);
  EXPECT_EQ(moved, hash([&](SpaceEditor& editor) { editor.MoveEntity(robot, pose); }));
  EXPECT_NE(hash([&](SpaceEditor& editor) { editor.SetAttribute(robot, "beacon", 0xff0000); }), unchanged);
  EXPECT_EQ(hash(
                [&](SpaceEditor& editor)
                {
                  EXPECT_THROW(editor.SetAttribute(robot, "led", 77, 12), std::invalid_argument);
                  EXPECT_THROW(editor.MoveEntity(robot, {{1e9, 1, 0}, Quaternion::Identity()}), std::invalid_argument);
                }),
            unchanged);
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
  const std::string mistake = test::MessageOf<ConfigurationError>(
      [&] {
        ReadExperiment(kDiffusion, {{"framework.maxclok", "3"}, {"framework.clocktick", "0"}});
      });
  EXPECT_THAT(mistake, testing::HasSubstr("maxclok"));
  EXPECT_THAT(mistake, testing::HasSubstr("clocktick"));
  EXPECT_THROW(ReadExperiment("/nowhere.xml"), ConfigurationError);
}

}  // namespace
}  // namespace swarmanoid
