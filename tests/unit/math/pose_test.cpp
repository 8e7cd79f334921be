#include "common/math/pose.h"

#include <gtest/gtest.h>

#include "common/math/elementary.h"
#include "common/math/random.h"

namespace swarmanoid
{
namespace
{

TEST(Pose, EulerAnglesTurnAboutTheFixedAxesInOrder)
{
  // The pose turns a quarter about x, then a quarter about z: y goes to z by the first, and stays there by the second.
  const Quaternion q = QuaternionFromEuler({kPi / 2, 0, kPi / 2});
  EXPECT_TRUE((q * Vector3::UnitY()).isApprox(Vector3::UnitZ(), 1e-12));
  EXPECT_TRUE((q * Vector3::UnitX()).isApprox(Vector3::UnitY(), 1e-12));
}

TEST(Pose, EulerAnglesSurviveTheWayThroughAQuaternion)
{
  RandomStream random(1, 1, 1, 1);
  for (int i = 0; i < 1000; ++i)
  {
    const EulerAngles angles{random.Uniform(-3, 3), random.Uniform(-1.5, 1.5), random.Uniform(-3, 3)};
    const EulerAngles back = EulerFromQuaternion(QuaternionFromEuler(angles));
    EXPECT_NEAR(back.alpha, angles.alpha, 1e-9);
    EXPECT_NEAR(back.beta, angles.beta, 1e-9);
    EXPECT_NEAR(back.gamma, angles.gamma, 1e-9);
  }
}

TEST(Pose, GimbalLockKeepsTheOrientation)
{
  const Quaternion q = QuaternionFromEuler({0.3, kPi / 2, 0.5});
  const EulerAngles angles = EulerFromQuaternion(q);
  const Quaternion back = QuaternionFromEuler(angles);
  EXPECT_NEAR(std::abs(back.dot(q)), 1, 1e-9);
}

TEST(Pose, InverseUndoesAPose)
{
  const Pose pose{{1, 2, 3}, QuaternionFromEuler({0.1, 0.2, 0.3})};
  const Pose identity = pose.Compose(pose.Inverse());
  EXPECT_LT(identity.position.norm(), 1e-12);
  EXPECT_NEAR(identity.orientation.w(), 1, 1e-12);
}

TEST(Pose, YawIsTheHeading)
{
  EXPECT_NEAR(YawOf(QuaternionFromYaw(2.5)), 2.5, 1e-12);
  EXPECT_NEAR(YawOf(QuaternionFromEuler({0, 0, -1.2})), -1.2, 1e-12);
}

}  // namespace
}  // namespace swarmanoid
