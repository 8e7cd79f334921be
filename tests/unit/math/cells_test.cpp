#include "common/math/cells.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "common/math/random.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

struct Point
{
  double x_m, y_m, z_m;
  double x() const { return x_m; }
  double y() const { return y_m; }
  double z() const { return z_m; }
};

template <class Cells, class... Corners>
std::vector<std::uint32_t> CellsIn(const Cells& cells, const Corners&... corners)
{
  std::vector<std::uint32_t> found;
  cells.ForEachRow(corners...,
                   [&](std::uint32_t first, std::uint32_t last)
                   {
                     for (std::uint32_t cell = first; cell <= last; ++cell) found.push_back(cell);
                   });
  return found;
}

TEST(CellEdge, IsTheSmallestThatTheLimitAllows)
{
  EXPECT_EQ(CellEdge<2>({10, 5}, 0.5, 1000), 0.5);
  RandomStream random(3, 0, 0, 0);
  for (int round = 0; round < 1000; ++round)
  {
    const std::array<double, 3> extent{random.Uniform(0, 100), random.Uniform(0, 100), random.Uniform(0, 3)};
    const double smallest = random.Uniform(0.01, 2);
    const double most = 1 + static_cast<double>(random.Below(5000));
    const auto cells = [&](double edge)
    { return CellsAcross(extent[0], edge) * CellsAcross(extent[1], edge) * CellsAcross(extent[2], edge); };
    const double edge = CellEdge(extent, smallest, most);
    EXPECT_GE(edge, smallest);
    EXPECT_LE(cells(edge), most);
    // A much shorter edge would give nearly as many cells as allowed, or more. A thin plate is an exception, since its
    // volume says little about its cells.
    if (edge > smallest && extent[2] > edge)
    {
      EXPECT_GT(cells(edge / 1.7), most * 0.4);
    }
  }
}

TEST(CellEdge, EndsForAnyExtent)
{
  EXPECT_EQ(CellEdge<2>({0, 0}, 0.2, 1), 0.2);
  EXPECT_EQ(CellEdge<2>({kNotANumber, 1}, 0.5, 100), 0.5);
  EXPECT_LE(CellsAcross(1e9, CellEdge<2>({1e9, 1e-9}, 0.1, 1000)), 1000);
  EXPECT_EQ(CellEdge<3>({kInfinity, 1, 1}, 0.1, 1000), kInfinity);
}

TEST(CellAxis, PointsOutsideBelongToTheNearestCell)
{
  const CellAxis<double> axis(-2, 5, 0.5);
  ASSERT_EQ(axis.Count(), 10U);
  EXPECT_EQ(axis.CellOf(-2), 0U);
  EXPECT_EQ(axis.CellOf(-1.501), 0U);
  EXPECT_EQ(axis.CellOf(-1.5), 1U);
  EXPECT_EQ(axis.CellOf(2.999), 9U);
  EXPECT_EQ(axis.CellOf(3), 9U);
  for (const double far : {3.1, 1e12, 1e300, kInfinity})
  {
    EXPECT_EQ(axis.CellOf(far), 9U);
    EXPECT_EQ(axis.CellOf(-far), 0U);
    EXPECT_EQ(CellAxis<float>(-2, 5, 0.5).CellOf(static_cast<float>(far)), 9U);
  }
  EXPECT_EQ(axis.CellOf(kNotANumber), 0U);
  EXPECT_EQ(CellAxis<float>(-2, 5, 0.5).CellOf(static_cast<float>(kNotANumber)), 0U);
}

TEST(CellAxis, HasAtLeastOneCell)
{
  for (const double length : {0.0, 1e-9, kNotANumber})
  {
    const CellAxis<double> axis(1, length, 0.5);
    EXPECT_EQ(axis.Count(), 1U);
    EXPECT_EQ(axis.CellOf(7), 0U);
  }
}

TEST(PlaneCells, NumbersRowByRow)
{
  const PlaneCells<double> cells(0, 0, 3, 2, 1);
  EXPECT_EQ(cells.Count(), 6U);
  EXPECT_EQ(cells.CellOf(2.5, 1.5), 5U);
  EXPECT_THAT(CellsIn(cells, 0.5, 0.5, 1.5, 1.5), ElementsAre(0, 1, 3, 4));
  EXPECT_THAT(CellsIn(cells, 1.5, -9.0, 1.5, 9.0), ElementsAre(1, 4));
  EXPECT_THAT(CellsIn(cells, 9.0, 0.5, 9.0, 0.5), ElementsAre(2));
  EXPECT_THAT(CellsIn(cells, 2.5, 1.5, 0.5, 0.5), IsEmpty());
}

TEST(PlaneCells, WithARingEachCellHasEightNeighbours)
{
  const PlaneCells<double> cells(0, 0, 3, 2, 1, true);
  ASSERT_EQ(cells.Count(), 20U);
  EXPECT_EQ(cells.CellOf(0, 0) - cells.stride - 1, 0U);
  EXPECT_EQ(cells.CellOf(3, 2) + cells.stride + 1, 19U);
  EXPECT_THAT(CellsIn(cells, -9.0, -9.0, 9.0, 9.0), ElementsAre(6, 7, 8, 11, 12, 13));
}

TEST(PlaneCells, FindsTheCellsOfManyPointsAsThoseOfEach)
{
  RandomStream random(5, 0, 0, 0);
  const PlaneCells<double> cells(-3, 2, 11, 7, 0.3, true);
  std::vector<double> x{kNotANumber, kInfinity, -kInfinity, 1e300, -1e300, 8, -3};
  std::vector<double> y{1, kNotANumber, kInfinity, -kInfinity, 1e300, 9, 2};
  for (int i = 0; i < 500; ++i)
  {
    x.push_back(random.Uniform(-5, 10));
    y.push_back(random.Uniform(0, 11));
  }
  // Any number of points: whole lanes, and some more.
  for (std::size_t count = x.size() - 9; count <= x.size(); ++count)
  {
    std::vector<std::uint32_t> found(count + 1, 77777);
    cells.FindCells({x.data(), count}, {y.data(), count}, found.data());
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(found[i], cells.CellOf(x[i], y[i])) << x[i] << ' ' << y[i];
    EXPECT_EQ(found[count], 77777U);
  }
}

TEST(BoxCells, ASingleLayerIsAPlane)
{
  const BoxCells cells{{0, 0, 3, 2, 1}, {}};
  EXPECT_EQ(cells.Count(), 6U);
  EXPECT_THAT(CellsIn(cells, Point{0.5, 0.5, -kInfinity}, Point{1.5, 1.5, kInfinity}), ElementsAre(0, 1, 3, 4));
}

TEST(BoxCells, NumbersLayerByLayer)
{
  const BoxCells cells{{0, 0, 2, 1, 1}, {0, 3, 1}};
  EXPECT_EQ(cells.Count(), 6U);
  EXPECT_THAT(CellsIn(cells, Point{0.5, 0.5, 0.5}, Point{0.5, 0.5, 9}), ElementsAre(0, 2, 4));
  const std::vector<double> x{0.5, 1.5, 1.5, -1}, y{0, 0, 7, 0}, z{0, 1.5, 99, kNotANumber};
  std::vector<std::uint32_t> found(4);
  cells.FindCells(x, y, z, found.data());
  EXPECT_THAT(found, ElementsAre(0, 3, 5, 0));
}

// Whatever the cells, a box touches the cells of all the points in it.
TEST(BoxCells, ABoxTouchesTheCellsOfAllItsPoints)
{
  RandomStream random(7, 0, 0, 0);
  for (int round = 0; round < 2000; ++round)
  {
    const double edge = random.Uniform(0.05, 4);
    const BoxCells cells{
        {random.Uniform(-5, 5), random.Uniform(-5, 5), random.Uniform(0, 9), random.Uniform(0, 9), edge},
        {random.Uniform(-1, 1), random.Uniform(0, 3), edge}};
    const Point low{random.Uniform(-9, 9), random.Uniform(-9, 9), random.Uniform(-3, 3)};
    const Point high{low.x_m + random.Uniform(0, 5), low.y_m + random.Uniform(0, 5), low.z_m + random.Uniform(0, 2)};
    const std::vector<std::uint32_t> touched = CellsIn(cells, low, high);
    const std::vector<double> x{random.Uniform(low.x_m, high.x_m)}, y{random.Uniform(low.y_m, high.y_m)},
        z{random.Uniform(low.z_m, high.z_m)};
    std::uint32_t cell = 0;
    cells.FindCells(x, y, z, &cell);
    EXPECT_LT(cell, cells.Count());
    EXPECT_TRUE(std::ranges::binary_search(touched, cell));
  }
}

TEST(CellSort, StandsMembersOfACellTogetherInTheirOrder)
{
  RandomStream random(9, 0, 0, 0);
  CellSort sort;
  for (const std::size_t cells : {1U, 2U, 50U, 3000U})
  {
    sort.SetCells(cells);
    // The cells are sorted again with more and with fewer members, and with none.
    for (const std::size_t members : {0U, 1U, 700U, 13U})
    {
      std::vector<std::vector<std::uint32_t>> expected(cells);
      const std::span<std::uint32_t> cell = sort.Cells(members);
      ASSERT_EQ(cell.size(), members);
      for (std::uint32_t i = 0; i < members; ++i)
      {
        cell[i] = random.Below(static_cast<std::uint32_t>(cells));
        expected[cell[i]].push_back(i);
      }
      std::vector<std::uint32_t> sorted(members);
      sort.Sort([&](std::size_t member, std::uint32_t place) { sorted[place] = static_cast<std::uint32_t>(member); });
      const std::uint32_t* const start = sort.Starts();
      EXPECT_EQ(start[0], 0U);
      EXPECT_EQ(start[cells], members);
      for (std::size_t c = 0; c < cells; ++c)
        EXPECT_EQ(std::vector(sorted.begin() + start[c], sorted.begin() + start[c + 1]), expected[c]);
    }
  }
}

// Cells, sorting and rows together: whatever the grid, and wherever the points are.
TEST(CellSort, SearchesFindWhatBruteForceFinds)
{
  RandomStream random(13, 0, 0, 0);
  CellSort sort;
  for (int round = 0; round < 300; ++round)
  {
    const double width = random.Uniform(0, 9), height = random.Uniform(0, 9);
    const double edge = CellEdge<2>({width, height}, random.Uniform(0.1, 2), 1 + random.Below(400));
    const PlaneCells<double> cells(random.Uniform(-5, 5), random.Uniform(-5, 5), width, height, edge, round % 2 == 0);
    std::vector<double> x{kNotANumber, kInfinity, -1e300}, y{0, -kInfinity, 1e300};
    for (int i = 0; i < 60; ++i)
    {
      x.push_back(random.Uniform(-12, 12));
      y.push_back(random.Uniform(-12, 12));
    }
    sort.SetCells(cells.Count());
    cells.FindCells(x, y, sort.Cells(x.size()).data());
    std::vector<std::size_t> sorted(x.size());
    sort.Sort([&](std::size_t member, std::uint32_t place) { sorted[place] = member; });

    const double left = random.Uniform(-13, 13), bottom = random.Uniform(-13, 13);
    const double right = left + random.Uniform(0, 15);
    const double top = round % 7 == 0 ? kInfinity : bottom + random.Uniform(0, 15);
    const auto is_in = [&](std::size_t i) { return x[i] >= left && x[i] <= right && y[i] >= bottom && y[i] <= top; };
    std::vector<std::size_t> found, expected;
    cells.ForEachRow(left, bottom, right, top,
                     [&](std::uint32_t first, std::uint32_t last)
                     {
                       for (std::uint32_t k = sort.Starts()[first]; k < sort.Starts()[last + 1]; ++k)
                         if (is_in(sorted[k])) found.push_back(sorted[k]);
                     });
    for (std::size_t i = 0; i < x.size(); ++i)
      if (is_in(i)) expected.push_back(i);
    EXPECT_THAT(found, testing::UnorderedElementsAreArray(expected));
  }
}

TEST(CellLists, ListEachMemberInAllItsCells)
{
  CellLists lists;
  lists.Close(3);
  EXPECT_THAT(lists.In(0, 2), IsEmpty());
  for (const std::uint32_t cell : {0U, 2U}) lists.Add(cell, 40);
  for (const std::uint32_t cell : {2U, 1U, 0U}) lists.Add(cell, 30);
  lists.Close(4);
  EXPECT_THAT(lists.In(0), ElementsAre(40, 30));
  EXPECT_THAT(lists.In(1), ElementsAre(30));
  EXPECT_THAT(lists.In(1, 2), ElementsAre(30, 40, 30));
  EXPECT_THAT(lists.In(3), IsEmpty());
  // Filling the lists again removes their old content.
  lists.Add(1, 5);
  lists.Close(2);
  EXPECT_THAT(lists.In(0), IsEmpty());
  EXPECT_THAT(lists.In(1), ElementsAre(5));
}

}  // namespace
}  // namespace swarmanoid
