// <floor_field> of experiment files: its cells, and each mistake with its place and cure.
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/experiment/fake_plugins.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid::test
{
namespace
{

LoadedExperiment WithFields(const std::string& fields, const std::string& framework = "")
{
  return LoadText(ExperimentText{.framework = framework, .size = "4, 3, 1", .arena = fields}.Text());
}

std::string MistakesOfFields(const std::string& fields, const std::string& framework = "")
{
  std::string all;
  for (const Diagnostic& error : WithFields(fields, framework).errors)
    all +=
        std::to_string(error.location.line) + ":" + std::to_string(error.location.column) + ": " + error.message + "\n";
  return all;
}

TEST(FloorFieldElement, CoversTheArenaWithCells)
{
  const LoadedExperiment loaded = WithFields(
      "<floor_field id='trail'/><floor_field id='food' cell='0.7' evaporation='0.1' diffusion='1e-4' period='10' "
      "least='0.01' colour='red' full='50'/>");
  ASSERT_TRUE(loaded.experiment);
  const auto& fields = loaded.experiment->floor_fields;
  ASSERT_EQ(fields.size(), 2U);
  EXPECT_EQ(fields[0].columns, 80U);
  EXPECT_EQ(fields[0].rows, 60U);
  EXPECT_EQ(fields[0].period, 1U);
  EXPECT_EQ(fields[1].columns, 6U) << "an incomplete cell counts";
  EXPECT_EQ(fields[1].rows, 5U);
  EXPECT_EQ(fields[1].evaporation_per_s, 0.1);
  EXPECT_EQ(fields[1].period, 10U);
  EXPECT_EQ(fields[1].least, 0.01);
  EXPECT_EQ(fields[1].colour, 0xff0000U);
  EXPECT_EQ(fields[1].full, 50);
}

TEST(FloorFieldElement, RefusesUnstableDiffusionWithTheLimit)
{
  EXPECT_EQ(MistakesOfFields("<floor_field id='trail' diffusion='6.25e-3'/>"), "") << "the limit itself is stable";
  EXPECT_EQ(
      MistakesOfFields("<floor_field id='trail' diffusion='0.01'/>"),
      "3:25: the diffusion of <floor_field> 'trail' is 0.01 m²/s; with cells of 0.05 m and steps of 0.1 s it must "
      "be at most cell² / (4 · step) = 0.00625 m²/s; lower it, or take larger cells\n");
  EXPECT_EQ(
      MistakesOfFields("<floor_field id='trail' diffusion='0.002' period='4'/>", "<clocktick>200</clocktick>"),
      "3:25: the diffusion of <floor_field> 'trail' is 0.002 m²/s; with cells of 0.05 m and steps of 0.8 s it must "
      "be at most cell² / (4 · step) = 0.00078125 m²/s; lower it or the period, or take larger cells\n");
}

TEST(FloorFieldElement, RefusesTooManyCellsAndTwoOfOneId)
{
  EXPECT_EQ(MistakesOfFields("<floor_field id='trail' cell='1e-4'/>"),
            "3:25: <floor_field> 'trail' has 1200000000 cells of 0.0001 m; a field may have 16777216, and all together "
            "67108864; take larger cells\n");
  EXPECT_EQ(MistakesOfFields("<floor_field id='trail'/>\n<floor_field id='trail'/>"),
            "4:14: two <floor_field> have the id 'trail'; the first is in line 3\n");
}

}  // namespace
}  // namespace swarmanoid::test
