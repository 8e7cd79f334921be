// Experiments of the kinematic engine, and of several engines in one space.
#include "tests/experiments/running_experiment.h"

namespace swarmanoid
{
namespace
{

constexpr double kFootbotRadius = 0.085036758;

TEST(ThreePlanes, EverybodyDiffusesOnTheOwnPlaneAndWithinItsWalls)
{
  RunningExperiment run("three_planes.xml");
  run.Run(1);
  const std::vector<std::string> groups{"ground_", "climber_", "top_"};
  std::vector<std::vector<Vector3>> starts;
  for (const std::string& group : groups) starts.push_back(run.PositionsOf(group));
  run.Run(499);
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    const Vector3 up = g == 0 ? Vector3(0, 0, 1) : g == 1 ? Vector3(1, 0, 0) : Vector3(0, 0, -1);
    const Vector3 low = g == 1 ? Vector3(0.2, 0.05, 0.1) : Vector3(0.05, 0.05, g == 0 ? 0 : 3);
    const Vector3 high = g == 1 ? Vector3(0.2, 4.95, 2.9) : Vector3(4.95, 4.95, g == 0 ? 0 : 3);
    const Vector3 body = kFootbotRadius * 0.99 * (Vector3::Ones() - up.cwiseAbs());
    for (const CSwarmanoidSpaceEntity* robot : run.EntitiesOf(groups[g]))
    {
      const Vector3 p = robot->GetPosition();
      EXPECT_NEAR((p - low).dot(up), 0, 1e-12) << robot->GetId();
      EXPECT_GE((p - low - body).minCoeff(), -1e-12) << robot->GetId() << " at " << p.transpose();
      EXPECT_GE((high - p - body).minCoeff(), -1e-12) << robot->GetId() << " at " << p.transpose();
      EXPECT_LT((robot->GetOrientation() * Vector3::UnitZ() - up).norm(), 1e-12) << robot->GetId();
    }
    EXPECT_GT(MeanDistance(starts[g], run.PositionsOf(groups[g])), 0.5) << groups[g];
  }
}

TEST(ThreeEngines, EachKeepsItsRobotsInTheirThirdAndTheyGetAsFar)
{
  RunningExperiment run("three_engines.xml");
  const std::vector<std::string> groups{"kinematic_", "flat_", "solid_"};
  std::vector<std::vector<Vector3>> starts;
  for (const std::string& group : groups) starts.push_back(run.PositionsOf(group));
  run.Run(300);
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    const double west = 3.0 * static_cast<double>(g);
    for (const Vector3& p : run.PositionsOf(groups[g]))
    {
      EXPECT_GT(p.x(), west + 0.05 + kFootbotRadius - 0.003) << groups[g];
      EXPECT_LT(p.x(), west + 2.95 - kFootbotRadius + 0.003) << groups[g];
      EXPECT_GT(p.y(), 0.05 + kFootbotRadius - 0.003) << groups[g];
      EXPECT_LT(p.y(), 2.95 - kFootbotRadius + 0.003) << groups[g];
      EXPECT_NEAR(p.z(), 0, 0.003) << groups[g];
    }
    EXPECT_GT(MeanDistance(starts[g], run.PositionsOf(groups[g])), 0.75) << groups[g] << " of 1.5 m without turns";
  }
}

// Engines differ in detail, the swarm spreads alike.
TEST(Diffusion, TheSameRobotsSpreadAlikeInEachEngine)
{
  RunningExperiment kinematic("diffusion_100.xml");
  const std::vector<Vector3> starts = kinematic.PositionsOf("fb_");
  kinematic.Run(300);
  const double distance = MeanDistance(starts, kinematic.PositionsOf("fb_"));
  EXPECT_GT(distance, 1.2) << "of 1.5 m without turns";
  for (const std::string file : {"diffusion_100_dynamics2d.xml", "diffusion_100_dynamics3d.xml"})
  {
    RunningExperiment run(file);
    EXPECT_EQ(run.PositionsOf("fb_"), starts) << file;
    run.Run(300);
    EXPECT_NEAR(MeanDistance(starts, run.PositionsOf("fb_")), distance, 0.12 * distance) << file;
    for (const Vector3& p : run.PositionsOf("fb_"))
      for (const int axis : {0, 1})
      {
        EXPECT_GT(p[axis], 0.05 + kFootbotRadius - 0.003) << file;
        EXPECT_LT(p[axis], 9.95 - kFootbotRadius + 0.003) << file;
      }
  }
}

TEST(Mirrors, PushTheBodiesOfOtherEnginesAndAreNotPushed)
{
  RunningExperiment run("mirrors.xml");
  const Pose statue = run.Entity("statue").GetPose();
  run.Run(200);
  const auto at = [&](const char* id) { return run.Entity(id).GetPosition(); };
  // Two metres at the speed of the wheels, loads, hedge and statue or not.
  EXPECT_NEAR(at("pusher_of_block").x(), 2.4, 0.01);
  EXPECT_NEAR(at("pusher_of_prey").x(), 2.4, 0.02);
  EXPECT_GT(at("prey").x(), 2.4) << "beyond the hedge at 1.6 m and the statue at 2 m, still before its pusher";
  EXPECT_GT((at("prey") - at("pusher_of_prey")).norm(), 0.085 + 0.1 - 0.005);
  EXPECT_GT(at("box").x(), 1.8);
  EXPECT_NEAR(at("alone").x(), 1.45 - 0.1, 0.03) << "its gripper is at the post";
  EXPECT_EQ(run.Entity("statue").GetPosition(), statue.position);
}

}  // namespace
}  // namespace swarmanoid
