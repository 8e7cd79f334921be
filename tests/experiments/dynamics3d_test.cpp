#include "common/space/terrain/terrain.h"
#include "tests/experiments/running_experiment.h"

namespace swarmanoid
{
namespace
{

TEST(HandbotShelf, TheHandbotBringsTheBookToTheFloor)
{
  RunningExperiment run("handbot_shelf.xml");
  const auto book = run.Entity("book").GetIndex();
  bool lifted = false;
  for (int tick = 0; tick < 350; ++tick)
  {
    run.Run(1);
    lifted = lifted ||
             (run.Entity("book").GetPosition().z() > 1.13 && run.Entity("hb").GetAttribute("gripped", 0) == 1 + book);
  }
  EXPECT_TRUE(lifted) << "it was to be held in the hand above the shelf";
  EXPECT_LT(run.Entity("book").GetPosition().z(), 0.15);
  EXPECT_LT(std::abs(run.Entity("hb").GetPosition().z()), 0.02);
  EXPECT_EQ(run.Entity("hb").GetAttribute("gripped", 0), 0) << "it was to be put down";
}

TEST(RoughTerrain, TheFootbotsDriveOverTheHillsWithoutFallingOver)
{
  RunningExperiment run("rough_terrain.xml");
  const auto terrain = LoadTerrain(run.Entity("hills").GetConfiguration(), run.File().folder);
  const std::vector<Vector3> starts = run.PositionsOf("fb_");
  run.Run(300);
  for (const CSwarmanoidSpaceEntity* robot : run.EntitiesOf("fb_"))
  {
    const Pose pose = robot->GetPose();
    const auto ground = terrain->GroundBelow({pose.position.x(), pose.position.y(), 1});
    ASSERT_TRUE(ground.has_value());
    EXPECT_NEAR(pose.position.z(), *ground, 0.015);
    EXPECT_GT((pose.orientation * Vector3::UnitZ()).z(), Cos(DegreesToRadians(30)));
  }
  EXPECT_GT(MeanDistance(starts, run.PositionsOf("fb_")), 0.6);
  run.Run(200);
  const std::vector<Vector3> late = run.PositionsOf("fb_");
  run.Run(100);
  EXPECT_GT(MeanDistance(late, run.PositionsOf("fb_")), 0.35) << "they turn at the walls and drive on";
}

TEST(RoughHoles, TheFootbotsDriveOnTheVoxelsOrLieInAHole)
{
  RunningExperiment run("rough_holes.xml");
  const auto terrain = LoadTerrain(run.Entity("ground").GetConfiguration(), run.File().folder);
  run.Run(20);
  const std::vector<Vector3> starts = run.PositionsOf("fb_");
  double climbed = 0;
  std::vector<double> heights{starts[0].z(), starts[1].z()};
  for (int tick = 0; tick < 580; ++tick)
  {
    run.Run(1);
    for (std::size_t k = 0; k < 2; ++k)
    {
      const Pose pose = run.EntitiesOf("fb_")[k]->GetPose();
      ASSERT_GT(pose.position.z(), terrain->Low().z()) << "through the ground at tick " << tick + 20;
      ASSERT_LT(pose.position.z(), 0.06) << "thrown up at tick " << tick + 20;
      climbed += std::abs(pose.position.z() - heights[k]);
      heights[k] = pose.position.z();
    }
  }
  EXPECT_GT(climbed, 0.01);
  EXPECT_GT(MeanDistance(starts, run.PositionsOf("fb_")), 0.3);
}

}  // namespace
}  // namespace swarmanoid
