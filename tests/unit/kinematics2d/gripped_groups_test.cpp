// A gripped group moves as its members together would like best.
#include "engine_worker/engines/kinematics2d/gripped_groups.h"

#include <gtest/gtest.h>

#include "common/math/elementary.h"
#include "common/math/random.h"
#include "engine_worker/engines/kinematics2d/step_constants.h"

namespace swarmanoid::kinematics2d
{
namespace
{

// A prey is at the origin, body 0, and robots around it grip it.
struct GroupScene
{
  Bodies bodies;
  Groups groups;

  explicit GroupScene(std::span<const Pose2> robots)
  {
    bodies.models.push_back(CircleModel(0.1));
    bodies.Add(0, {}, false);
    for (const Pose2& robot : robots)
    {
      const std::uint32_t body = bodies.Add(0, robot, false);
      groups.grips.push_back({body, 0, robot});
    }
    bodies.MakeRoom();
    groups.Rebuild(bodies);
  }
};

TEST(Groups, OneRobotDrivesItsPreyAsItDrivesAlone)
{
  const Pose2 robot{0.2, 0.1, RotorOf(1.0)};
  GroupScene scene({&robot, 1});
  const Twist twist{0.1, 0, 0.5};
  scene.bodies.twists.Set(1, twist);
  FindGroupTwists(scene.bodies, scene.groups);
  // A moment later, the robot is where it would be alone.
  const Pose2 prey = Advanced({}, scene.groups.with_groups.Get(0), 1e-3);
  const Pose2 moved = Compose(prey, robot);
  const Pose2 alone = Advanced(robot, twist, 1e-3);
  EXPECT_NEAR(moved.x, alone.x, 1e-12);
  EXPECT_NEAR(moved.y, alone.y, 1e-12);
  EXPECT_NEAR(AngleOf(moved.heading), AngleOf(alone.heading), 1e-12);
}

TEST(Groups, TheTwistOfManyIsTheLeastSquaresOne)
{
  RandomStream random(1, 0, 0, 0);
  std::vector<Pose2> robots;
  for (int k = 0; k < 5; ++k)
    robots.push_back({random.Uniform(-0.3, 0.3), random.Uniform(-0.3, 0.3), RotorOf(random.Uniform(-kPi, kPi))});
  GroupScene scene(robots);
  for (std::uint32_t body = 1; body <= robots.size(); ++body)
    scene.bodies.twists.Set(body, {random.Uniform(-0.1, 0.1), 0, random.Uniform(-1, 1)});
  FindGroupTwists(scene.bodies, scene.groups);
  // Returns the sum of squares that the wheels of all members miss if the group moves like this.
  const auto missed = [&](const Twist& group)
  {
    double sum = 0;
    for (const Grip& grip : scene.groups.grips)
    {
      const Twist own = scene.bodies.twists.Get(grip.body);
      const double c = CosOf(grip.relative.heading);
      const double s = SinOf(grip.relative.heading);
      const double x = group.forward - group.turn * grip.relative.y - (c * own.forward - s * own.left);
      const double y = group.left + group.turn * grip.relative.x - (s * own.forward + c * own.left);
      const double turn = kGripArm * (group.turn - own.turn);
      sum += x * x + y * y + turn * turn;
    }
    return sum;
  };
  const Twist best = scene.groups.with_groups.Get(0);
  for (int k = 0; k < 100; ++k)
    EXPECT_LE(missed(best), missed({best.forward + random.Uniform(-0.01, 0.01), best.left + random.Uniform(-0.01, 0.01),
                                    best.turn + random.Uniform(-0.1, 0.1)}));
}

TEST(Groups, ThePreyLeadsAndWeighsAsMuchAsAll)
{
  const Pose2 robots[] = {{0.2, 0, {}}, {-0.2, 0, {}}};
  const GroupScene scene(robots);
  EXPECT_EQ(scene.groups.LeaderOf(1), 0U);
  EXPECT_EQ(scene.groups.LeaderOf(2), 0U);
  EXPECT_EQ(scene.groups.mobility[0], 1.0 / 3);
  EXPECT_EQ(scene.groups.mobility[scene.groups.LeaderOf(99)], 0) << "static shapes cannot be pushed";
  EXPECT_EQ(scene.groups.FindGrip(2)->prey, 0U);
  EXPECT_EQ(scene.groups.FindGrip(0), nullptr);
  EXPECT_EQ(scene.groups.GripsOf(0).size(), 2U);
}

}  // namespace
}  // namespace swarmanoid::kinematics2d
