// configs/pile.xml: 300 footbots push into a corner, and none ends up inside another one or a wall.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "tests/experiments/running_experiment.h"

namespace swarmanoid
{
namespace
{

constexpr double kPreyRadius = 0.085036758;
constexpr double kPromised = 0.004 * kPreyRadius;  // docs/engines.md
constexpr double kWall = 0.05;                     // inner faces at 0.05 and 9.95 m

// The outer corners of the square at the front of the turret, which stays ahead.
std::array<Vector2, 2> CornersOf(const Pose& pose)
{
  const Vector3 left = pose.Apply({0.1, 0.015, 0}), right = pose.Apply({0.1, -0.015, 0});
  return {left.head<2>(), right.head<2>()};
}

double DeepestOverlap(const std::vector<Pose>& poses)
{
  double deepest = 0;
  for (const Pose& a : poses)
  {
    const Vector2 place = a.position.head<2>();
    const double nearest = std::min(place.minCoeff() - kWall, 10 - kWall - place.maxCoeff());
    deepest = std::max(deepest, kPreyRadius - nearest);
    for (const Vector2& corner : CornersOf(a))
    {
      deepest = std::max({deepest, kWall - corner.minCoeff(), corner.maxCoeff() - (10 - kWall)});
      for (const Pose& b : poses)
        if (&a != &b) deepest = std::max(deepest, kPreyRadius - (corner - b.position.head<2>()).norm());
    }
    for (const Pose& b : poses)
      if (&a < &b) deepest = std::max(deepest, 2 * kPreyRadius - (place - b.position.head<2>()).norm());
  }
  return deepest;
}

// Returns how many robots have three others around them.
int InThePile(const std::vector<Pose>& poses)
{
  int in_the_pile = 0;
  for (const Pose& a : poses)
  {
    int neighbours = -1;  // itself
    for (const Pose& b : poses) neighbours += (a.position - b.position).norm() < 2.6 * kPreyRadius;
    in_the_pile += neighbours >= 3;
  }
  return in_the_pile;
}

TEST(Pile, NobodyIsInsideAnotherOneOrAWallAtAnyTick)
{
  RunningExperiment run("pile.xml");
  for (int tick = 0; tick <= 400; ++tick)
  {
    if (tick > 0) run.Run(1);
    std::vector<Pose> poses;
    for (const CSwarmanoidSpaceEntity* robot : run.EntitiesOf("fb_")) poses.push_back(robot->GetPose());
    ASSERT_EQ(poses.size(), 300U);
    ASSERT_LE(DeepestOverlap(poses), kPromised + 1e-6) << "at tick " << tick;
    if (tick == 400)
    {
      EXPECT_GT(InThePile(poses), 60);
    }
  }
}

}  // namespace
}  // namespace swarmanoid
