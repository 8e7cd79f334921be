// Fields on the floor: the explicit scheme against closed forms, and tiles against a computation of all cells.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "common/space/floor_field.h"
#include "common/space/floor_fields.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

FloorFieldConfiguration Configuration(std::size_t columns, std::size_t rows, double evaporation = 0,
                                      double diffusion = 0)
{
  FloorFieldConfiguration field;
  field.id = "trail";
  field.cell_m = 0.05;
  field.columns = columns;
  field.rows = rows;
  field.evaporation_per_s = evaporation;
  field.diffusion_m2_per_s = diffusion;
  return field;
}

TEST(FloorField, StaysEmptyWithoutDeposits)
{
  const FloorFieldConfiguration configuration = Configuration(33, 17, 0.1, 1e-3);
  FloorField field(configuration, 0.1);
  for (int step = 0; step < 10; ++step) field.Step();
  EXPECT_EQ(field.Total(), 0);
  EXPECT_EQ(field.Largest(), 0);
  field.VisitRuns([](std::size_t cell, std::span<const float>) { ADD_FAILURE() << cell; });
}

TEST(FloorField, PutsADepositIntoTheCellUnderThePoint)
{
  const FloorFieldConfiguration configuration = Configuration(4, 3);
  FloorField field(configuration, 0.1);
  field.Add(0.12, 0.149, 2);  // column 2, row 2
  EXPECT_FLOAT_EQ(field.ValueOf(2 * 4 + 2), 2 / 0.0025F);
  EXPECT_NEAR(field.Total(), 2, 1e-6);
  field.Add(-1e-9, 0.1, 1);
  field.Add(0.2, 0.1, 1);
  field.Add(0.1, 0.151, 1);
  EXPECT_NEAR(field.Total(), 2, 1e-6) << "points outside get nothing";
  field.Add(0.12, 0.12, -5);
  EXPECT_EQ(field.Total(), 0) << "no cell is below 0";
  field.Add(0.12, 0.12, 1e300);
  EXPECT_EQ(field.Largest(), FloorField::kMost);
  EXPECT_EQ(field.CellAt(0, 0), 0U);
  EXPECT_EQ(field.CellAt(0.2, 0), field.Cells());
}

TEST(FloorField, EvaporatesAsAnExponential)
{
  const FloorFieldConfiguration configuration = Configuration(40, 40, 0.1);
  FloorField field(configuration, 0.5);
  field.Add(1, 1, 3);
  for (int step = 0; step < 20; ++step) field.Step();
  EXPECT_NEAR(field.Total(), 3 * std::exp(-0.1 * 10), 3e-6);
}

TEST(FloorField, SetsWhatIsLessThanTheLeastTo0)
{
  FloorFieldConfiguration configuration = Configuration(40, 40, 1);
  configuration.least = 10;
  FloorField field(configuration, 1);
  field.Set(0, 20);
  field.Set(41, 40);
  field.Step();
  EXPECT_EQ(field.ValueOf(0), 0);
  EXPECT_FLOAT_EQ(field.ValueOf(41), 40 * std::exp(-1.0F));
}

// M / (4 π D t) · exp(−r² / (4 D t) − λ t)
TEST(FloorField, SpreadsAPointSourceAsTheClosedForm)
{
  for (const double flow : {0.05, 0.125, 0.2})
  {
    const double step_s = 0.1, rate = 0.02;
    const double diffusion = flow * 0.05 * 0.05 / step_s;
    const FloorFieldConfiguration configuration = Configuration(121, 121, rate, diffusion);
    FloorField field(configuration, step_s);
    const double middle = 60.5 * 0.05;
    field.Add(middle, middle, 7);
    const int steps = static_cast<int>(std::lround(60 / flow));
    for (int step = 0; step < steps; ++step) field.Step();
    const double time = steps * step_s;
    const double spread = 4 * diffusion * time;
    const double peak = 7 / (std::numbers::pi * spread) * std::exp(-rate * time);
    double worst = 0;
    for (std::size_t cell = 0; cell < field.Cells(); ++cell)
    {
      const double x = (static_cast<double>(cell % 121) + 0.5) * 0.05 - middle;
      const double y = (static_cast<double>(cell / 121) + 0.5) * 0.05 - middle;
      worst = std::max(worst, std::abs(field.ValueOf(cell) - peak * std::exp(-(x * x + y * y) / spread)));
    }
    EXPECT_LT(worst, 0.006 * peak) << "flow " << flow;
    EXPECT_NEAR(field.Total(), 7 * std::exp(-rate * time), 3.5e-3 * std::exp(-rate * time));
  }
}

TEST(FloorField, KeepsTheAmountAtTheBorderAndBecomesEven)
{
  FloorFieldConfiguration configuration = Configuration(19, 35, 0, 0.005);
  FloorField field(configuration, 0.1);
  field.Add(0.01, 0.01, 5);
  for (int step = 0; step < 20'000; ++step) field.Step();
  EXPECT_NEAR(field.Total(), 5, 0.002);
  const double even = 5 / (19 * 35 * 0.0025);
  for (std::size_t cell = 0; cell < field.Cells(); ++cell) EXPECT_NEAR(field.ValueOf(cell), even, 0.01 * even) << cell;
}

// All cells, without tiles and lanes.
std::vector<float> StepOfAll(const std::vector<float>& before, std::size_t columns, std::size_t rows, float flow,
                             float stays, float least)
{
  std::vector<float> after(before.size());
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t x = 0; x < columns; ++x)
    {
      const auto at = [&](std::size_t column, std::size_t row) { return before[row * columns + column]; };
      const float c = at(x, y);
      const float around = (at(x == 0 ? 0 : x - 1, y) + at(std::min(x + 1, columns - 1), y)) +
                           (at(x, y == 0 ? 0 : y - 1) + at(x, std::min(y + 1, rows - 1)));
      const float value = stays * (c + flow * (around - 4.0F * c));
      after[y * columns + x] = value < least ? 0 : value;
    }
  return after;
}

TEST(FloorField, HasTheSameBitsAsAComputationOfAllCells)
{
  std::mt19937 random(1);
  for (const auto& [columns, rows] :
       {std::pair<std::size_t, std::size_t>{1, 1}, {16, 16}, {7, 50}, {33, 17}, {100, 64}})
  {
    FloorFieldConfiguration configuration = Configuration(columns, rows, 0.3, 0.004);
    configuration.least = 1;
    FloorField field(configuration, 0.1);
    std::vector<float> all(columns * rows);
    const auto flow = static_cast<float>(0.004 * 0.1 / (0.05 * 0.05));
    const auto stays = static_cast<float>(std::exp(-0.03));
    for (int step = 0; step < 200; ++step)
    {
      if (step % 25 < 3)
      {
        const std::size_t cell = random() % all.size();
        all[cell] = static_cast<float>(random() % 1000);
        field.Set(cell, all[cell]);
      }
      if (step == 120)
      {
        field.Clear();
        std::fill(all.begin(), all.end(), 0.0F);
      }
      field.Step();
      all = StepOfAll(all, columns, rows, flow, stays, 1);
      for (std::size_t cell = 0; cell < all.size(); ++cell)
        ASSERT_EQ(field.ValueOf(cell), all[cell]) << columns << " by " << rows << ", step " << step << ", " << cell;
    }
  }
}

TEST(FloorField, IsInterpolatedBetweenTheMiddlesOfCells)
{
  const FloorFieldConfiguration configuration = Configuration(20, 10);
  FloorField field(configuration, 0.1);
  const auto ramp = [](double x, double y) { return 3 + 40 * x + 20 * y; };
  for (std::size_t cell = 0; cell < field.Cells(); ++cell)
    field.Set(cell, static_cast<float>(ramp((static_cast<double>(cell % 20) + 0.5) * 0.05,
                                            (static_cast<double>(cell / 20) + 0.5) * 0.05)));
  EXPECT_NEAR(field.ValueAt(0.333, 0.211), ramp(0.333, 0.211), 1e-5);
  EXPECT_NEAR(field.GradientAt(0.333, 0.211).x(), 40, 1e-3);
  EXPECT_NEAR(field.GradientAt(0.333, 0.211).y(), 20, 1e-3);
  EXPECT_NEAR(field.ValueAt(-5, 0.211), ramp(0.025, 0.211), 1e-5) << "outside: that of the border";
  EXPECT_NEAR(field.ValueAt(5, 5), ramp(0.975, 0.475), 1e-5);
}

Experiment TwoFields()
{
  Experiment experiment;
  experiment.floor_fields = {Configuration(20, 10), Configuration(3, 3)};
  experiment.floor_fields[1].id = "food";
  return experiment;
}

TEST(FloorFields, AreTheSameAfterTheirCellsWereSent)
{
  const Experiment experiment = TwoFields();
  FloorFields fields(experiment), others(experiment);
  EXPECT_EQ(fields.Cells(), 209U);
  EXPECT_EQ(fields.NumberOf("food"), 1U);
  EXPECT_THROW(fields.NumberOf("fod"), std::invalid_argument);
  for (const std::uint32_t cell : {0U, 1U, 19U, 20U, 199U, 200U, 208U})
    fields.Set(cell, 1.0F + static_cast<float>(cell));
  others.Set(5, 9);
  FieldCells cells;
  fields.WriteCells(cells);
  EXPECT_EQ(cells.runs, (std::vector<std::uint32_t>{0, 2, 19, 1, 20, 1, 199, 1, 200, 1, 208, 1}));
  EXPECT_EQ(MistakeIn(cells, 209), "");
  others.Load(cells);
  for (std::uint32_t cell = 0; cell < 209; ++cell) EXPECT_EQ(others.ValueOf(cell), fields.ValueOf(cell)) << cell;
  FieldCells none;
  others.Load(none);
  others.WriteCells(cells);
  EXPECT_TRUE(cells.values.empty());
}

TEST(FloorFields, RefuseCellsThatCannotBe)
{
  const auto mistake = [](std::vector<std::uint32_t> runs, std::vector<float> values) {
    return MistakeIn({std::move(runs), std::move(values)}, 10);
  };
  EXPECT_EQ(mistake({}, {}), "");
  EXPECT_EQ(mistake({0, 2, 5, 5}, {0, 1, 2, 3, 4, 5, 6}), "");
  EXPECT_EQ(mistake({0, 2, 5}, {0, 1}), "a run of cells has no length");
  EXPECT_EQ(mistake({3, 2, 4, 1}, {0, 1, 2}), "cell 4 does not ascend");
  EXPECT_EQ(mistake({3, 0}, {}), "cell 3 does not ascend");
  EXPECT_EQ(mistake({9, 2}, {0, 1}), "there is no cell 10; the floor fields have 10");
  EXPECT_EQ(mistake({4294967295U, 4294967295U}, {0, 1}), "there is no cell 8589934589; the floor fields have 10");
  EXPECT_EQ(mistake({0, 2}, {0}), "there are 1 values for 2 cells");
  EXPECT_EQ(mistake({0, 1}, {-1}), "the value -1 is not from 0 to 1e30");
  EXPECT_EQ(mistake({0, 1}, {std::nanf("")}), "the value nan is not from 0 to 1e30");
}

TEST(FloorFields, CollectRunsOfChangedCells)
{
  FieldCells cells;
  for (const std::uint32_t cell : {3U, 4U, 6U}) AddCell(cells, cell, static_cast<float>(cell));
  EXPECT_EQ(cells.runs, (std::vector<std::uint32_t>{3, 2, 6, 1}));
  EXPECT_EQ(cells.values, (std::vector<float>{3, 4, 6}));
}

TEST(FloorFields, AreInTheHashWithTheirCells)
{
  const Experiment experiment = TwoFields();
  const auto hash = [&](std::vector<std::uint32_t> runs, std::vector<float> values)
  {
    CSwarmanoidSpace space(experiment);
    SpaceState state;
    state.fields = {std::move(runs), std::move(values)};
    space.Apply(state);
    return space.Hash();
  };
  const std::set<std::uint64_t> hashes{hash({}, {}),        hash({3, 1}, {2}),         hash({4, 1}, {2}),
                                       hash({3, 1}, {4}),   hash({3, 2}, {2, 2}),      hash({3, 1, 5, 1}, {2, 2}),
                                       hash({203, 1}, {2}), hash({3, 1, 6, 1}, {2, 2})};
  EXPECT_EQ(hashes.size(), 8U);
  EXPECT_EQ(hash({3, 1}, {2}), hash({3, 1}, {2}));
}

}  // namespace
}  // namespace swarmanoid
