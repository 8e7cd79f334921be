// <wind> of experiment files, and each mistake with its place and cure.
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/experiment/fake_plugins.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid::test
{
namespace
{

LoadedExperiment WithWind(const std::string& wind)
{
  return LoadText(ExperimentText{.size = "4, 3, 1", .arena = wind}.Text());
}

std::string MistakesOfWind(const std::string& wind)
{
  std::string all;
  for (const Diagnostic& error : WithWind(wind).errors) all += error.message + "\n";
  return all;
}

TEST(WindElement, GivesVelocityAndGusts)
{
  EXPECT_FALSE(WithWind("").experiment->wind);
  const LoadedExperiment loaded = WithWind("<wind velocity='1, -2, 0.5' gusts='7.7' height='20'/>");
  ASSERT_TRUE(loaded.experiment);
  EXPECT_EQ(loaded.experiment->wind, (WindConfiguration{{1, -2, 0.5}, 7.7, 20}));
  EXPECT_EQ(WithWind("<wind velocity='1, 0, 0'/>").experiment->wind, (WindConfiguration{{1, 0, 0}, 0, 3}));
}

TEST(WindElement, RefusesGustsThatNoWindCarriesAndASecondWind)
{
  EXPECT_EQ(MistakesOfWind("<wind velocity='0, 0, 1' gusts='3'/>"),
            "gusts need a wind that carries them along: give <wind> a velocity along x or y, such as velocity=\"1, 0, "
            "0\"\n");
  EXPECT_NE(MistakesOfWind("<wind velocity='1000, 0, 0'/>"), "");
  EXPECT_NE(MistakesOfWind("<wind gusts='-1'/>"), "");
  EXPECT_NE(MistakesOfWind("<wind/><wind/>"), "");
  EXPECT_EQ(MistakesOfWind("<wind/>"), "");
}

}  // namespace
}  // namespace swarmanoid::test
