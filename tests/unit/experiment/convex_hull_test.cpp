// The hulls of bodies: their faces, volume, centre and inertia.
#include "common/mesh/convex_hull.h"

#include <gtest/gtest.h>

#include "common/math/convex_outline.h"
#include "common/math/random.h"
#include "common/mesh/mesh_points.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

std::vector<Vector3> CornersOfBox(const Vector3& size)
{
  std::vector<Vector3> corners;
  for (const double x : {0.0, 1.0})
    for (const double y : {0.0, 1.0})
      for (const double z : {0.0, 1.0}) corners.push_back(size.cwiseProduct(Vector3(x, y, z)));
  return corners;
}

TEST(ConvexHull, ABoxHasSixFacesAndTheMassOfABox)
{
  const Vector3 size(0.2, 0.4, 0.6);
  std::vector<Vector3> points = CornersOfBox(size);
  points.push_back(size / 2);
  points.push_back(size.cwiseProduct(Vector3(0.5, 0.5, 1)));
  const ConvexHull hull = HullOf(points);
  EXPECT_EQ(hull.corners.size(), 8U);
  EXPECT_EQ(hull.faces.size(), 6U);
  EXPECT_EQ(hull.edges.size(), 12U);
  EXPECT_NEAR(hull.volume, 0.048, 1e-15);
  EXPECT_LT((hull.centre - size / 2).norm(), 1e-15);
  EXPECT_NEAR(hull.inertia(0, 0), 0.048 * (0.16 + 0.36) / 12, 1e-15);
  EXPECT_NEAR(hull.inertia(1, 1), 0.048 * (0.04 + 0.36) / 12, 1e-15);
  EXPECT_NEAR(hull.inertia(2, 2), 0.048 * (0.04 + 0.16) / 12, 1e-15);
  EXPECT_NEAR(hull.inertia(0, 1), 0, 1e-15);
  EXPECT_NEAR(hull.DepthOf({0.1, 0.1, 0.1}), 0.1, 1e-15);
  EXPECT_NEAR(hull.DepthOf({0.1, 0.1, 0.7}), -0.1, 1e-15);
}

// The corner of a cube has volume 1/6 and centre 1/4. About the centre it has moments of 1/80 and products of -1/480
// (by hand).
TEST(ConvexHull, ATetrahedronHasTheInertiaOfItsIntegrals)
{
  const ConvexHull hull = HullOf(std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  EXPECT_NEAR(hull.volume, 1.0 / 6, 1e-15);
  EXPECT_LT((hull.centre - Vector3::Constant(0.25)).norm(), 1e-15);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(hull.inertia(i, j), i == j ? 1.0 / 80 : 1.0 / 480, 1e-15);
}

// The mean of its corners is at a fifth.
TEST(ConvexHull, APyramidHasItsCentreAtAQuarterOfItsHeight)
{
  const ConvexHull hull = HullOf(std::vector<Vector3>{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0, 0, 1}});
  EXPECT_NEAR(hull.volume, 4.0 / 3, 1e-12);
  EXPECT_LT((hull.centre - Vector3(0, 0, 0.25)).norm(), 1e-12);
}

TEST(ConvexHull, EveryPointIsWithinAndEveryCornerIsAPoint)
{
  for (std::uint64_t trial = 0; trial < 200; ++trial)
  {
    RandomStream random(1, trial, 0, 0);
    std::vector<Vector3> points;
    const bool on_grid = trial % 2 == 1;
    for (int k = 0; k < 40; ++k)
    {
      Vector3 point(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
      if (on_grid) point = (point * 2).array().round() / 2;
      points.push_back(point);
    }
    const ConvexHull hull = HullOf(points);
    for (const Vector3& point : points) EXPECT_GT(hull.DepthOf(point), -1e-4) << trial;
    for (const Vector3& corner : hull.corners)
    {
      EXPECT_NE(std::find(points.begin(), points.end(), corner), points.end());
      EXPECT_LT(hull.DepthOf(corner), 1e-4);
    }
    EXPECT_EQ(hull.corners.size() + hull.faces.size(), hull.edges.size() + 2);
  }
}

TEST(ConvexHull, AFineMeshHasTheBoxThatItFillsAndFewCorners)
{
  RandomStream random(1, 0, 0, 0);
  std::vector<Vector3> ball;
  for (int k = 0; k < 5000; ++k)
    ball.push_back(Vector3(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1) + 1e-3).normalized());
  const ConvexHull hull = HullOf(ball);
  EXPECT_LE(hull.corners.size(), kMostHullCorners);
  EXPECT_NEAR(hull.volume, 4.18879, 0.4);
  Eigen::AlignedBox3d of_hull, of_ball;
  for (const Vector3& corner : hull.corners) of_hull.extend(corner);
  for (const Vector3& point : ball) of_ball.extend(point);
  EXPECT_LT((of_hull.sizes() - of_ball.sizes()).norm(), 1e-12);
}

TEST(ConvexHull, WhatHasNoInsideIsRefused)
{
  const auto mistake = [](const std::vector<Vector3>& points) -> std::string
  { return test::MessageOf<std::invalid_argument>([&] { HullOf(points); }); };
  EXPECT_EQ(mistake({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), "a body needs at least four corners");
  EXPECT_EQ(mistake({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), "its corners lie in one plane");
  EXPECT_EQ(mistake({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}), "its corners lie in one plane");
  EXPECT_EQ(mistake({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}), "its corners lie in one plane");
  EXPECT_EQ(mistake({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::nan("")}}), "a corner is at no place");
}

TEST(ConvexOutline, RunsCounterClockwiseWithoutPointsOnItsEdges)
{
  const std::vector<Vector2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(ConvexOutline({{1, 1}, {0, 0}, {0.5, 0}, {0, 1}, {0.5, 0.5}, {1, 0}}), square);
  EXPECT_TRUE(ConvexOutline({}).empty());
  EXPECT_TRUE(ConvexOutline({{1, 1}}).empty());
}

// The tetrahedra from the origin to the triangles of a closed surface have its volume together.
TEST(MeshPoints, TrianglesCloseTheSurfaceOfTheFile)
{
  const test::TemporaryFolder folder;
  const std::string file = folder.Write("corner.obj",
                                        "v 1 1 1\nv 3 1 1\nv 1 2 1\nv 1 1 5\n"
                                        "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const MeshPoints points = ReadMeshPoints(file);
  ASSERT_EQ(points.triangles.size(), 4U);
  double volume = 0;
  for (const auto& [a, b, c] : points.triangles)
    volume += points.corners[a].dot(points.corners[b].cross(points.corners[c])) / 6;
  EXPECT_NEAR(volume, 2.0 * 1 * 4 / 6, 1e-6);
}

}  // namespace
}  // namespace swarmanoid
