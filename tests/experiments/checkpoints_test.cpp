// Runs that continue from a checkpoint, at ticks at which something is held. tests/cluster/launcher_checkpoint_test.py
// does the same with these files and ticks, also as clusters.

#include "common/checkpoint/checkpoint.h"
#include "tests/experiments/running_experiment.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

int GripsIn(RunningExperiment& run)
{
  int grips = 0;
  for (std::size_t k = 0; k < run.Space().Size(); ++k)
  {
    const CSwarmanoidSpaceEntity& entity = run.Space().GetEntity(k);
    if (entity.GetKind() == EntityKind::kFootbot || entity.GetKind() == EntityKind::kHandbot)
      grips += entity.GetAttribute("gripped") != 0;
  }
  return grips;
}

class HeldThings : public testing::TestWithParam<std::tuple<const char*, int, int>>
{
};

TEST_P(HeldThings, GoOnFromACheckpointWithTheSameHash)
{
  const auto [name, tick, last] = GetParam();
  const std::string file = std::string(name) + ".xml";
  const test::TemporaryFolder folder;
  const RunningExperiment::Settings settings{{"framework.maxclock", std::to_string(last)}};
  SimulatorOptions options;
  options.output_folder = folder.Path();
  options.checkpoint_every = 100;
  RunningExperiment whole(file, settings, options);
  whole.Run(tick);
  EXPECT_GT(GripsIn(whole), 0);
  const std::uint64_t expected = whole.HashAtTheEnd();

  SimulatorOptions restored;
  restored.output_folder = folder.Path();
  restored.restore_file = (folder / CheckpointName(static_cast<std::uint64_t>(tick))).string();
  EXPECT_EQ(RunningExperiment(file, settings, restored).HashAtTheEnd(), expected);
}

INSTANTIATE_TEST_SUITE_P(Experiments, HeldThings,
                         testing::Values(std::tuple("prey_retrieval", 2100, 2200),
                                         std::tuple("gripped_chain", 100, 200), std::tuple("handbot_shelf", 200, 350)),
                         [](const auto& test) { return std::string(std::get<0>(test.param)); });

}  // namespace
}  // namespace swarmanoid
