#include "engine_worker/engines/kinematics2d/motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/math/elementary.h"

namespace swarmanoid::kinematics2d
{
namespace
{

Pose2 Moved(const Pose2& pose, const Twist& twist, double seconds)
{
  PoseStore from, to;
  TwistStore twists;
  const std::size_t padded = PaddedCount(1);
  from.Resize(padded);
  to.Resize(padded);
  twists.Resize(padded);
  from.Set(0, pose);
  twists.Set(0, twist);
  Integrate(from, twists, seconds, 0, padded, to);
  return to.Get(0);
}

TEST(Motion, StraightAheadGoesSpeedTimesTime)
{
  const Pose2 end = Moved({1, 2, RotorOf(kPi / 6)}, {0.3, 0, 0}, 0.1);
  EXPECT_NEAR(end.x, 1 + 0.03 * std::cos(kPi / 6), 1e-15);
  EXPECT_NEAR(end.y, 2 + 0.03 * std::sin(kPi / 6), 1e-15);
  EXPECT_DOUBLE_EQ(AngleOf(end.heading), kPi / 6);
}

TEST(Motion, SpinningOnTheSpotTurnsAndStays)
{
  const Pose2 end = Moved({1, 2, RotorOf(3)}, {0, 0, 2}, 0.1);
  EXPECT_EQ(end.x, 1);
  EXPECT_EQ(end.y, 2);
  EXPECT_NEAR(AngleOf(end.heading), 3.2 - 2 * kPi, 1e-14);
}

TEST(Motion, AnArcEndsOnItsCircleForSlowAndFastTurns)
{
  for (const double turn : {1e-9, 1e-4, 0.3, -4.2, 9.9, 10.1, -35.0, 100.0})
  {
    const double start = 0.7;
    const double forward = 0.2;
    const double left = -0.05;
    const double seconds = 0.1;
    const Pose2 end = Moved({0, 0, RotorOf(start)}, {forward, left, turn}, seconds);
    const double angle = start + turn * seconds;
    // It is the integral of the rotated velocity.
    const double x =
        (forward * (std::sin(angle) - std::sin(start)) + left * (std::cos(angle) - std::cos(start))) / turn;
    const double y =
        (forward * (std::cos(start) - std::cos(angle)) + left * (std::sin(angle) - std::sin(start))) / turn;
    const double tolerance = 1e-15 + 1e-16 / std::abs(turn);
    EXPECT_NEAR(end.x, x, tolerance) << turn;
    EXPECT_NEAR(end.y, y, tolerance) << turn;
    EXPECT_NEAR(CosOf(end.heading), std::cos(angle), 2e-15) << turn;
    EXPECT_NEAR(SinOf(end.heading), std::sin(angle), 2e-15) << turn;
  }
}

TEST(Motion, AFullCircleOfSmallStepsCloses)
{
  Pose2 pose{0, 0, RotorOf(0)};
  for (int k = 0; k < 1000; ++k) pose = Moved(pose, {0.1, 0, 2 * kPi / 100}, 0.1);
  EXPECT_NEAR(pose.x, 0, 1e-13);
  EXPECT_NEAR(pose.y, 0, 1e-13);
  EXPECT_NEAR(AngleOf(pose.heading), 0, 1e-12);
  EXPECT_NEAR(pose.heading.z * pose.heading.z + pose.heading.w * pose.heading.w, 1, 1e-15);
}

TEST(Motion, TheSingleFormAgreesWithTheVectorForm)
{
  for (double turn = -20; turn < 20; turn += 0.37)
  {
    const Pose2 pose{0.3, -0.2, RotorOf(turn)};
    const Pose2 a = Moved(pose, {0.2, 0.1, turn}, 0.1);
    const Pose2 b = Advanced(pose, {0.2, 0.1, turn}, 0.1);
    EXPECT_NEAR(a.x, b.x, 1e-16);
    EXPECT_NEAR(a.y, b.y, 1e-16);
    EXPECT_NEAR(a.heading.z, b.heading.z, 3e-16);
    EXPECT_NEAR(a.heading.w, b.heading.w, 3e-16);
  }
}

TEST(Motion, RelativeUndoesCompose)
{
  const Pose2 frame{1, 2, RotorOf(2.5)};
  const Pose2 local{-0.3, 0.4, RotorOf(-1.1)};
  const Pose2 back = Relative(frame, Compose(frame, local));
  EXPECT_NEAR(back.x, local.x, 1e-15);
  EXPECT_NEAR(back.y, local.y, 1e-15);
  EXPECT_NEAR(AngleOf(back.heading), -1.1, 1e-15);
}

}  // namespace
}  // namespace swarmanoid::kinematics2d
