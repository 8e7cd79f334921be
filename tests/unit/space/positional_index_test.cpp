#include "common/space/index/positional_index.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/math/random.h"
#include "common/space/index/grid_index.h"
#include "common/space/index/octree_index.h"

namespace swarmanoid
{
namespace
{

struct Cloud
{
  std::vector<double> x, y, z;
  PointArrays Arrays() const { return {x, y, z}; }
};

std::vector<std::uint32_t> BruteWithin(const Cloud& cloud, const Vector3& centre, double radius)
{
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < cloud.x.size(); ++i)
  {
    const double dx = cloud.x[i] - centre.x();
    const double dy = cloud.y[i] - centre.y();
    const double dz = cloud.z[i] - centre.z();
    if (dx * dx + dy * dy + dz * dz <= radius * radius) found.push_back(i);
  }
  return found;
}

std::vector<std::uint32_t> BruteBox(const Cloud& cloud, const Vector3& low, const Vector3& high)
{
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < cloud.x.size(); ++i)
    if (cloud.x[i] >= low.x() && cloud.x[i] <= high.x() && cloud.y[i] >= low.y() && cloud.y[i] <= high.y() &&
        cloud.z[i] >= low.z() && cloud.z[i] <= high.z())
      found.push_back(i);
  return found;
}

class PositionalIndexTest : public testing::TestWithParam<const char*>
{
protected:
  static std::unique_ptr<PositionalIndex> Make(const Vector3& arena, std::size_t points)
  {
    const std::string name = GetParam();
    if (name == "flat") return std::make_unique<GridIndex>(arena, points, false);
    if (name == "layered") return std::make_unique<GridIndex>(arena, points, true);
    return std::make_unique<OctreeIndex>();
  }
};

// Points make 10^5 random moves. They also cross the border of the arena, lie on borders of cells, and meet.
TEST_P(PositionalIndexTest, AnswersAsBruteForceWhilePointsMove)
{
  const Vector3 arena(20, 15, 4);
  constexpr std::size_t kPoints = 500;
  constexpr int kRounds = 200;
  RandomStream random(11, 0, 0, 0);
  Cloud cloud;
  for (std::size_t i = 0; i < kPoints; ++i)
  {
    cloud.x.push_back(random.Uniform(-2, 22));
    cloud.y.push_back(random.Uniform(-2, 17));
    cloud.z.push_back(random.Uniform(-1, 5));
  }
  const auto index = Make(arena, kPoints);
  std::vector<std::uint32_t> found;
  for (int round = 0; round < kRounds; ++round)
  {
    for (std::size_t i = 0; i < kPoints; ++i)
    {
      cloud.x[i] += random.Uniform(-0.4, 0.4);
      cloud.y[i] += random.Uniform(-0.4, 0.4);
      cloud.z[i] += random.Uniform(-0.1, 0.1);
      if (random.Below(20) == 0) cloud.x[i] = std::round(cloud.x[i]);
      if (random.Below(50) == 0) cloud.y[i] = random.Uniform(-100, 100);
      if (random.Below(20) == 0)
      {
        const auto other = random.Below(kPoints);
        cloud.x[i] = cloud.x[other];
        cloud.y[i] = cloud.y[other];
        cloud.z[i] = cloud.z[other];
      }
    }
    index->Update(cloud.Arrays());
    for (int query = 0; query < 20; ++query)
    {
      const Vector3 centre(random.Uniform(-3, 23), random.Uniform(-3, 18), random.Uniform(-1, 5));
      // Some exactly as far as a point is.
      const auto rim = random.Below(kPoints);
      const double radius = query % 4 == 0
                                ? std::min(5.0, (Vector3(cloud.x[rim], cloud.y[rim], cloud.z[rim]) - centre).norm())
                                : random.Uniform(0, 5);
      index->FindWithin(centre, radius, found);
      ASSERT_EQ(found, BruteWithin(cloud, centre, radius));
      const Vector3 high = centre + Vector3(random.Uniform(0, 4), random.Uniform(0, 4), random.Uniform(0, 4));
      index->FindInBox(centre, high, found);
      ASSERT_EQ(found, BruteBox(cloud, centre, high));

      const auto excluded = random.Below(kPoints);
      const auto nearest = index->FindNearest(centre, radius, excluded);
      auto brute = BruteWithin(cloud, centre, radius);
      std::erase(brute, excluded);
      const auto distance = [&](std::uint32_t i)
      { return (Vector3(cloud.x[i], cloud.y[i], cloud.z[i]) - centre).squaredNorm(); };
      const auto best =
          std::min_element(brute.begin(), brute.end(), [&](auto a, auto b) { return distance(a) < distance(b); });
      ASSERT_EQ(nearest.has_value(), best != brute.end());
      if (nearest)
      {
        ASSERT_EQ(*nearest, *best);
      }
    }
  }
}

TEST_P(PositionalIndexTest, FindsCoincidentPointsAndPointsOnTheBorderOfTheSearch)
{
  const Cloud cloud{{1, 1, 1, 3}, {2, 2, 2, 2}, {0, 0, 0, 0}};
  const auto index = Make({10, 10, 2}, 4);
  index->Update(cloud.Arrays());
  std::vector<std::uint32_t> found;
  index->FindWithin({1, 2, 0}, 0, found);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{0, 1, 2}));
  index->FindWithin({1, 2, 0}, 2, found);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(index->FindNearest({1, 2, 0}, 5, 0), 1U);
  EXPECT_EQ(index->FindNearest({9, 9, 0}, 1), std::nullopt);
}

TEST_P(PositionalIndexTest, EmptyAndSinglePointSpacesAreFine)
{
  const auto index = Make({10, 10, 2}, 0);
  const Cloud none;
  index->Update(none.Arrays());
  EXPECT_EQ(index->FindNearest({1, 1, 1}, 100), std::nullopt);
  const Cloud one{{5}, {5}, {1}};
  index->Update(one.Arrays());
  EXPECT_EQ(index->FindNearest({1, 1, 1}, 100), 0U);
  EXPECT_EQ(index->FindNearest({1, 1, 1}, 100, 0), std::nullopt);
}

TEST_P(PositionalIndexTest, ACoordinateThatIsNotANumberIsNeverFound)
{
  const Cloud cloud{{1, std::nan("")}, {1, 1}, {0, 0}};
  const auto index = Make({10, 10, 2}, 2);
  index->Update(cloud.Arrays());
  std::vector<std::uint32_t> found;
  index->FindWithin({1, 1, 0}, 1000, found);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{0}));
}

TEST_P(PositionalIndexTest, ABoxContainsItsFaces)
{
  const Vector3 low(1, 2, 0.5), high(3, 5, 1.5);
  const Vector3 middle = (low + high) / 2;
  Cloud cloud;
  for (int axis = 0; axis < 3; ++axis)
    for (const Vector3& face : {low, high})
    {
      Vector3 point = middle;
      point[axis] = face[axis];
      cloud.x.push_back(point.x());
      cloud.y.push_back(point.y());
      cloud.z.push_back(point.z());
    }
  const auto index = Make({10, 10, 2}, 6);
  index->Update(cloud.Arrays());
  std::vector<std::uint32_t> found;
  index->FindInBox(low, high, found);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
}

INSTANTIATE_TEST_SUITE_P(Arrangements, PositionalIndexTest, testing::Values("flat", "layered", "octree"),
                         [](const auto& param) { return std::string(param.param); });

// The worlds are those of docs/architecture.md, "Cost of the space", with 10,000 entities. The measurements are there.
TEST(PositionalIndex, EachWorldOfTheCostTableHasItsQuickestArrangement)
{
  constexpr std::size_t kMany = 10'000;
  EXPECT_STREQ(MakePositionalIndex(SpaceOptimization::k2D, {100, 100, 1}, kMany)->Name(), "flat grid");
  EXPECT_STREQ(MakePositionalIndex(SpaceOptimization::k3D, {60, 60, 22}, kMany)->Name(), "layered grid");
  EXPECT_STREQ(MakePositionalIndex(SpaceOptimization::k3D, {10'000, 10'000, 100}, kMany)->Name(), "oct-tree");
  // There are a few eyebots in a hall, and very few in a large one.
  EXPECT_STREQ(MakePositionalIndex(SpaceOptimization::k3D, {60, 60, 22}, 100)->Name(), "layered grid");
  EXPECT_STREQ(MakePositionalIndex(SpaceOptimization::k3D, {200, 200, 22}, 100)->Name(), "oct-tree");
}

TEST(PositionalIndex, TheArenaDecidesTheArrangement)
{
  EXPECT_STREQ(MakePositionalIndex(SpaceOptimization::k2D, {10, 10, 3}, 100)->Name(), "flat grid");
  EXPECT_STREQ(MakePositionalIndex(SpaceOptimization::k3D, {10, 10, 3}, 100)->Name(), "layered grid");
  EXPECT_STREQ(MakePositionalIndex(SpaceOptimization::k3D, {1000, 1000, 100}, 100)->Name(), "oct-tree");
  EXPECT_STREQ(MakePositionalIndex(SpaceOptimization::kOctree, {10, 10, 3}, 100)->Name(), "oct-tree");
}

}  // namespace
}  // namespace swarmanoid
