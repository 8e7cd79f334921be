#include "engine_worker/engines/plane_frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/math/elementary.h"
#include "common/mesh/convex_hull.h"
#include "common/space/space.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

double AreaOf(const std::vector<Vector2>& polygon)
{
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vector2& a = polygon[i];
    const Vector2& b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

TEST(PlaneFrame, AxesAreRightHandedPermutations)
{
  const Vector3 point(1, 2, 3);
  const Pose pose{point, Quaternion::Identity()};
  const PlanePose z = PlaneFrame(PlaneAxis::kZ, 0.5).ToPlane(pose);
  EXPECT_DOUBLE_EQ(z.u, 1);
  EXPECT_DOUBLE_EQ(z.v, 2);
  const PlanePose x = PlaneFrame(PlaneAxis::kX, 0.5).ToPlane(pose);
  EXPECT_DOUBLE_EQ(x.u, 2);
  EXPECT_DOUBLE_EQ(x.v, 3);
  EXPECT_DOUBLE_EQ(PlaneFrame(PlaneAxis::kX, 0.5).StanceOf(pose).height, 0.5);
  const PlanePose y = PlaneFrame(PlaneAxis::kY, -1).ToPlane(pose);
  EXPECT_DOUBLE_EQ(y.u, 3);
  EXPECT_DOUBLE_EQ(y.v, 1);
  EXPECT_DOUBLE_EQ(PlaneFrame(PlaneAxis::kY, -1).StanceOf(pose).height, 3);
}

TEST(PlaneFrame, ARobotOnAWallLooksAlongTheWallAndStandsOffIt)
{
  const PlaneFrame wall(PlaneAxis::kX, 2);
  const Pose pose = wall.ToSpace({1, 0.5, kPi / 2});
  EXPECT_LT((pose.position - Vector3(2, 1, 0.5)).norm(), 1e-12);
  EXPECT_LT((pose.orientation * Vector3::UnitX() - Vector3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((pose.orientation * Vector3::UnitZ() - Vector3::UnitX()).norm(), 1e-12);
}

TEST(PlaneFrame, RoundTripKeepsAnyPoseInAnyPlane)
{
  const Pose tilted{Vector3(1, -2, 0.3), QuaternionFromEuler({0.3, -0.4, 1.1})};
  for (const PlaneFrame& plane : {PlaneFrame(PlaneAxis::kX, 1.5), PlaneFrame(PlaneAxis::kY, -2),
                                  PlaneFrame(PlaneAxis::kZ, 0), PlaneFrame(tilted)})
  {
    for (double angle = -3; angle <= 3; angle += 0.25)
    {
      const Pose pose{Vector3(angle, 1 - angle, 0.2), QuaternionFromEuler({0.2, 0.1 * angle, angle})};
      const Pose back = plane.ToSpace(plane.ToPlane(pose), plane.StanceOf(pose));
      EXPECT_LT((back.position - pose.position).norm(), 1e-12);
      EXPECT_NEAR(std::abs(back.orientation.dot(pose.orientation)), 1, 1e-12);
    }
  }
}

TEST(PlaneFrame, CutsABoxThatStandsOnThePlaneOrWhoseCentreIsFarAway)
{
  const PlaneFrame ground(PlaneAxis::kZ, 0);
  EXPECT_NEAR(AreaOf(ground.CutBox({Vector3(5, 5, 0.25), Quaternion::Identity()}, Vector3(0.5, 0.05, 0.5))), 0.025,
              1e-12);
  EXPECT_NEAR(AreaOf(ground.CutBox({Vector3(5, 5, 40), QuaternionFromYaw(0.7)}, Vector3(0.5, 0.4, 100))), 0.2, 1e-12);
  EXPECT_TRUE(ground.CutBox({Vector3(5, 5, 0.3), Quaternion::Identity()}, Vector3(0.5, 0.05, 0.5)).empty());
}

TEST(PlaneFrame, CutsATiltedCubeInAHexagon)
{
  // Seen along a body diagonal, the cut through the centre of a unit cube is a regular hexagon of area 3 sqrt(3) / 4.
  const Quaternion diagonal_up = Quaternion::FromTwoVectors(Vector3(1, 1, 1), Vector3::UnitZ());
  const auto cut = PlaneFrame(PlaneAxis::kZ, 3).CutBox({Vector3(0, 0, 3), diagonal_up}, Vector3(1, 1, 1));
  EXPECT_EQ(cut.size(), 6U);
  EXPECT_NEAR(AreaOf(cut), 3 * std::sqrt(3.0) / 4, 1e-12);
}

// A cone stands on its base of 24 corners, half a metre high: half way up, the disc has half the radius.
TEST(PlaneFrame, CutsAHullInAPolygonOfFewCornersWithinIt)
{
  std::vector<Vector3> corners{{0, 0, 0.25}};
  for (int k = 0; k < 24; ++k) corners.emplace_back(std::cos(k * kPi / 12), std::sin(k * kPi / 12), -0.25);
  Experiment experiment;
  EntityConfiguration block = test::Entity(EntityKind::kBlock, "", {0, 0, 0}, {2, 2, 0.5}, false);
  block.hull = std::make_shared<const ConvexHull>(HullOf(corners));
  experiment.entities.push_back(block);
  const CSwarmanoidSpace space(experiment);
  const std::vector<Vector2> cut =
      PlaneFrame(PlaneAxis::kZ, 0).CutBody(space.GetEntity(0), {Vector3(3, 4, 0), Quaternion::Identity()});
  EXPECT_EQ(cut.size(), kMostCutCorners);
  for (const Vector2& corner : cut) EXPECT_NEAR((corner - Vector2(3, 4)).norm(), 0.5, 0.01);
  EXPECT_NEAR(AreaOf(cut), 0.25 * 2 * std::sqrt(2.0), 0.03);
}

TEST(PlaneFrame, CutsUprightBodiesThatReachIt)
{
  const Pose standing{Vector3(0, 0, 0), Quaternion::Identity()};
  EXPECT_TRUE(PlaneFrame(PlaneAxis::kZ, 0).CutsUpright(standing, 0.1));
  EXPECT_TRUE(PlaneFrame(PlaneAxis::kZ, 0.09).CutsUpright(standing, 0.1));
  EXPECT_FALSE(PlaneFrame(PlaneAxis::kZ, 0.2).CutsUpright(standing, 0.1));
}

}  // namespace
}  // namespace swarmanoid
