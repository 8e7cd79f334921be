// The regions of a plane have about equal work.
#include "engine_worker/engines/kinematics2d/region_cuts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace swarmanoid::kinematics2d
{
namespace
{

using Cut = std::vector<std::uint8_t>;

EngineSplit Split(const char* text) { return *EngineSplit::Parse(text); }

std::vector<std::uint64_t> BodiesOf(const Cut& cut, const std::vector<std::uint32_t>& bodies, unsigned regions)
{
  std::vector<std::uint64_t> of_regions(regions, 0);
  for (std::size_t block = 0; block < cut.size(); ++block) of_regions.at(cut[block]) += bodies[block];
  return of_regions;
}

TEST(RegionCuts, HalveAnEvenPlaneAcrossItsLongerSide)
{
  const std::vector<std::uint32_t> bodies(8, 10);
  EXPECT_EQ(CutPlane(bodies, 4, Split("1")), Cut(8, 0));
  EXPECT_EQ(CutPlane(bodies, 4, Split("2")), (Cut{0, 0, 1, 1, 0, 0, 1, 1}));
  EXPECT_EQ(CutPlane(bodies, 4, Split("4")), (Cut{0, 1, 2, 3, 0, 1, 2, 3}));
  EXPECT_EQ(CutPlane(bodies, 2, Split("2")), (Cut{0, 0, 0, 0, 1, 1, 1, 1}));
}

TEST(RegionCuts, AreAGridWhereOneIsWanted)
{
  const std::vector<std::uint32_t> bodies(16, 10);
  EXPECT_EQ(CutPlane(bodies, 4, Split("2x2")), (Cut{0, 0, 2, 2, 0, 0, 2, 2, 1, 1, 3, 3, 1, 1, 3, 3}));
  EXPECT_EQ(CutPlane(bodies, 4, Split("1x4")), (Cut{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3}));
  EXPECT_EQ(CutPlane(bodies, 4, Split("4x1")), (Cut{0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3}));
}

TEST(RegionCuts, FollowTheBodies)
{
  // All of them are in one corner.
  std::vector<std::uint32_t> bodies(20UL * 20UL, 0);
  for (std::uint32_t row = 0; row < 6; ++row)
    for (std::uint32_t column = 0; column < 6; ++column) bodies[row * 20 + column] = 50;
  for (const char* split : {"2", "3", "4", "8", "2x2", "3x2"})
  {
    const unsigned regions = Split(split).regions;
    const auto of_regions = BodiesOf(CutPlane(bodies, 20, Split(split)), bodies, regions);
    EXPECT_LE(*std::ranges::max_element(of_regions), 36 * 50 / regions * 3 / 2) << split;
    EXPECT_EQ(std::accumulate(of_regions.begin(), of_regions.end(), std::uint64_t{0}), 36U * 50U);
  }
  // A crowd costs more than as many bodies that are apart.
  std::vector<std::uint32_t> line{400, 100, 100, 100, 100, 100};
  EXPECT_EQ(CutPlane(line, 6, Split("2")), (Cut{0, 1, 1, 1, 1, 1}));
}

TEST(RegionCuts, LeaveRegionsEmptyIfThereAreTooFewBlocks)
{
  const std::vector<std::uint32_t> bodies{7, 7};
  const Cut cut = CutPlane(bodies, 2, Split("8"));
  EXPECT_NE(cut[0], cut[1]);
  EXPECT_TRUE(std::ranges::all_of(cut, [](std::uint8_t region) { return region < 8; }));
  EXPECT_EQ(CutPlane(std::vector<std::uint32_t>{3}, 1, Split("2x2")).size(), 1U);
}

TEST(EngineSplit, IsANumberOrAGrid)
{
  const auto parsed = [](const char* text)
  {
    const auto split = EngineSplit::Parse(text);
    return split ? std::pair(split->regions, split->columns) : std::pair(0U, 0U);
  };
  EXPECT_EQ(parsed("1"), std::pair(1U, 0U));
  EXPECT_EQ(parsed("32"), std::pair(32U, 0U));
  EXPECT_EQ(parsed("2x3"), std::pair(6U, 2U));
  EXPECT_EQ(parsed("32x1"), std::pair(32U, 32U));
  for (const char* wrong : {"", "0", "33", "-1", "+2", "2.0", "x", "2x", "x2", "2x2x2", "8x5", "2 x 2", "auto"})
    EXPECT_EQ(parsed(wrong), std::pair(0U, 0U)) << wrong;
}

}  // namespace
}  // namespace swarmanoid::kinematics2d
