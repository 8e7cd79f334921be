// Experiments in which commands act a tick late (framework.ahead).

#include "common/checkpoint/checkpoint.h"
#include "tests/experiments/running_experiment.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

const RunningExperiment::Settings kLate{{"framework.ahead", "1"}, {"framework.maxclock", "300"}};

TEST(CommandsATickLate, RobotsBeginToMoveATickLater)
{
  RunningExperiment now("diffusion_10.xml"), late("diffusion_10.xml", kLate);
  const std::vector<Vector3> start = now.PositionsOf("fb");
  ASSERT_EQ(start.size(), 10U);
  now.Run(1);
  late.Run(1);
  EXPECT_EQ(late.PositionsOf("fb"), start);
  EXPECT_NE(now.PositionsOf("fb"), start);
  late.Run(1);
  EXPECT_EQ(late.PositionsOf("fb"), now.PositionsOf("fb"));
}

TEST(CommandsATickLate, ACheckpointHasThoseThatHaveNotActedYet)
{
  const test::TemporaryFolder folder;
  SimulatorOptions options;
  options.output_folder = folder.Path();
  options.checkpoint_every = 100;
  const std::uint64_t expected = RunningExperiment("diffusion_10.xml", kLate, options).HashAtTheEnd();
  EXPECT_NE(RunningExperiment("diffusion_10.xml", {{"framework.maxclock", "300"}}).HashAtTheEnd(), expected);
  options.checkpoint_every = 0;
  options.restore_file = (folder / CheckpointName(100)).string();
  EXPECT_EQ(RunningExperiment("diffusion_10.xml", kLate, options).HashAtTheEnd(), expected);
}

}  // namespace
}  // namespace swarmanoid
