#include "tests/experiments/running_experiment.h"

namespace swarmanoid
{
namespace
{

TEST(GrippedChain, TenFootbotsPullThePreyAtTheSpeedOfTheirWheels)
{
  RunningExperiment run("gripped_chain.xml");
  const double start = run.Entity("prey").GetPosition().x();
  run.Run(150);
  for (int k = 0; k < 9; ++k)
    EXPECT_EQ(run.Entity("fb_" + std::to_string(k)).GetAttribute("gripped"),
              1 + run.Entity("fb_" + std::to_string(k + 1)).GetIndex());
  EXPECT_EQ(run.Entity("fb_9").GetAttribute("gripped"), 1 + run.Entity("prey").GetIndex());
  EXPECT_NEAR(run.Entity("prey").GetPosition().x() - start, -0.1 * 15, 0.1) << "but for the start";
}

// Ten robots pull with 10 mu m g = 125.6 N at most; a prey of mass M rubs with 0.5 M g.
TEST(GrippedChain, MovesWhatItsWheelsCanPullAndNothingHeavier)
{
  for (const int mass : {24, 27})
  {
    RunningExperiment run("gripped_chain.xml", {{"arena.cylindric_prey[prey].mass", std::to_string(mass)}});
    run.Run(50);
    const double before = run.Entity("prey").GetPosition().x();
    run.Run(50);
    EXPECT_NEAR(run.Entity("prey").GetPosition().x() - before, mass == 24 ? -0.5 : 0, 0.01) << mass;
  }
}

}  // namespace
}  // namespace swarmanoid
