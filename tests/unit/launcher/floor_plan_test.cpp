// Floor plans become walls that cover the dark pixels and nothing else.
#include "launcher/worlds/floor_plan.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "common/configuration/configuration_tree.h"
#include "launcher/worlds/ros_map.h"
#include "simulation/register_all.h"
#include "tests/unit/launcher/world_lines.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string PgmMistake(const std::string& bytes)
{
  return test::MessageOf<std::runtime_error>([&] { PgmPicture(bytes); });
}

LoadedExperiment LoadedPlan(const FloorPlan& plan)
{
  RegisterBuiltins();
  return LoadExperimentText(plan.experiment, "made.xml", "/");
}

TEST(FloorPlan, WallsCoverTheDarkPixelsAndNothingElse)
{
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial)
  {
    GreyPicture picture;
    picture.columns = 1 + static_cast<int>(random() % 12);
    picture.rows = 1 + static_cast<int>(random() % 12);
    for (int k = 0; k < picture.columns * picture.rows; ++k) picture.values.push_back(random() % 2 == 0 ? 0.2 : 0.6);
    picture.values[0] = 0;
    const FloorPlan plan = PlanFromPicture(picture, {0.25, 0.5, 0.4}, "plan.png");
    const LoadedExperiment loaded = LoadedPlan(plan);
    EXPECT_THAT(test::LinesOf(loaded.errors), IsEmpty());
    ASSERT_TRUE(loaded.experiment);
    EXPECT_EQ(loaded.experiment->arena_size, Vector3(picture.columns * 0.25, picture.rows * 0.25, 1));
    std::vector<int> covered(picture.values.size(), 0);
    for (const EntityConfiguration& wall : loaded.experiment->entities)
    {
      EXPECT_DOUBLE_EQ(wall.pose.position.z(), 0.2);
      for (int y = 0; y < picture.rows; ++y)
        for (int x = 0; x < picture.columns; ++x)
        {
          // The upper row of the picture is at the largest y.
          const Vector3 middle((x + 0.5) * 0.25, (picture.rows - y - 0.5) * 0.25, 0.2);
          const Vector3 from_centre = (middle - wall.pose.position).cwiseAbs();
          if ((from_centre.array() < (wall.size / 2).array()).all())
            ++covered[static_cast<std::size_t>(y * picture.columns + x)];
        }
    }
    for (std::size_t k = 0; k < covered.size(); ++k) EXPECT_EQ(covered[k], picture.values[k] < 0.5 ? 1 : 0);
  }
}

TEST(FloorPlan, ALongWallIsOneBoxInBothDirections)
{
  for (const bool along_x : {true, false})
  {
    GreyPicture picture;
    picture.columns = along_x ? 50 : 3;
    picture.rows = along_x ? 3 : 50;
    for (int k = 0; k < 150; ++k) picture.values.push_back((along_x ? k / 50 : k % 3) == 1 ? 0 : 1);
    EXPECT_EQ(PlanFromPicture(picture, {0.1, 0.5, 0.5}, "p").walls, 1U);
  }
  // Comb: ten walls along y, each of which would be twenty runs along x.
  GreyPicture comb;
  comb.columns = 20;
  comb.rows = 20;
  for (int k = 0; k < 400; ++k) comb.values.push_back(k % 2 == 0 || k < 20 ? 0 : 1);
  EXPECT_LE(PlanFromPicture(comb, {0.1, 0.5, 0.5}, "p").walls, 20U);
}

TEST(FloorPlan, APictureWithoutWallsIsAMistake)
{
  GreyPicture white;
  white.columns = white.rows = 2;
  white.values = {1, 1, 0.5, 1};
  EXPECT_THAT(test::MessageOf<std::runtime_error>(
                  [&] {
                    PlanFromPicture(white, {0.1, 0.5, 0.5}, "p.png");
                  }),
              HasSubstr("no pixel of 'p.png' is darker than the threshold 0.5"));
  EXPECT_EQ(PlanFromPicture(white, {0.1, 0.6, 0.5}, "p.png").walls, 1U);
}

TEST(FloorPlan, NoiseIsRefused)
{
  GreyPicture noise;
  noise.columns = noise.rows = 700;
  for (int k = 0; k < 490'000; ++k) noise.values.push_back((k + k / 700) % 2);
  EXPECT_THAT(test::MessageOf<std::runtime_error>(
                  [&] {
                    PlanFromPicture(noise, {0.1, 0.5, 0.5}, "p.png");
                  }),
              HasSubstr("make 245000 walls; at most 100000 are made"));
}

TEST(FloorPlan, PgmsOfAllFormsAreRead)
{
  EXPECT_EQ(PgmPicture("P2 # a comment\n2 2\n# another\n4\n0 1\n2 4").values, (std::vector<double>{0, 0.25, 0.5, 1}));
  EXPECT_EQ(PgmPicture(std::string("P5\n2 1\n255\n\x00\xff", 13)).values, (std::vector<double>{0, 1}));
  EXPECT_EQ(PgmPicture(std::string("P5 1 1 65535\n\x80\x00", 15)).values, (std::vector<double>{32768.0 / 65535}));
}

TEST(FloorPlan, DamagedPgmsAreRefused)
{
  EXPECT_THAT(PgmMistake("P6 1 1 255\nabc"), HasSubstr("no PGM"));
  EXPECT_THAT(PgmMistake("P2"), HasSubstr("it has no width"));
  EXPECT_THAT(PgmMistake("P2 3 x"), HasSubstr("it has no height"));
  EXPECT_THAT(PgmMistake("P2 0 1 1 0"), HasSubstr("is 0"));
  EXPECT_THAT(PgmMistake("P2 1 1 0 0"), HasSubstr("is 0"));
  EXPECT_THAT(PgmMistake("P2 99999999999999999999 1 1"), HasSubstr("its width is more than 65536"));
  EXPECT_THAT(PgmMistake("P5 65536 65536 255\n"), HasSubstr("more than 67108864 pixels"));
  EXPECT_THAT(PgmMistake("P5 60000 1000 255\nab"), HasSubstr("it is cut short"));
  EXPECT_THAT(PgmMistake("P2 60000 1000 255\n1 2"), HasSubstr("it is cut short"));
  EXPECT_THAT(PgmMistake("P2 2 1 255 7 "), HasSubstr("it has no grey"));
  EXPECT_THAT(PgmMistake("P2 2 1 3 7 1"), HasSubstr("a grey of 7 is more than its largest, 3"));
  EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { ReadPlanPicture("/nowhere.png"); }),
              HasSubstr("cannot read the picture '/nowhere.png'"));
}

std::string MapMistake(const std::string& text)
{
  return test::MessageOf<ConfigurationError>([&] { ReadRosMap(text, "m.yaml"); });
}

TEST(RosMap, HasWhatMapServersWrite)
{
  const RosMap map = ReadRosMap(
      "%YAML:1.0\n---\n# of a lab\nimage: \"my map.pgm\"  # a name\nresolution: 5e-2\r\norigin: [-10, 2.5, 0.000000]\n"
      "negate: 1\noccupied_thresh: 0.7\nfree_thresh: 0.25\nmode: scale\n",
      "m.yaml");
  EXPECT_EQ(map.image, "my map.pgm");
  EXPECT_EQ(map.resolution_m, 0.05);
  EXPECT_EQ(map.origin, Vector3(-10, 2.5, 0));
  EXPECT_EQ(map.occupied_threshold, 0.7);
  EXPECT_TRUE(map.is_negated);
  const RosMap other = ReadRosMap("image: a#b.png\nresolution: 1\norigin:\n- 1\n  - 2\n- -3\n", "m.yaml");
  EXPECT_EQ(other.image, "a#b.png");
  EXPECT_EQ(other.origin, Vector3(1, 2, -3));
  EXPECT_EQ(other.occupied_threshold, 0.65);
  EXPECT_FALSE(other.is_negated);
  EXPECT_TRUE(IsRosMapFile("maps/lab.yaml"));
  EXPECT_TRUE(IsRosMapFile("lab.yml"));
  EXPECT_FALSE(IsRosMapFile("yaml.png"));
}

TEST(RosMap, MistakesAreNamedWithTheirLine)
{
  EXPECT_THAT(MapMistake(""), HasSubstr("m.yaml:1:1: the map has no image"));
  EXPECT_THAT(MapMistake("image: a\n"), HasSubstr("the map has no resolution"));
  EXPECT_THAT(MapMistake("image: a\nresolution: much\n"),
              HasSubstr("m.yaml:2:1: resolution is 'much'; it must be a number"));
  EXPECT_THAT(MapMistake("image: a\nresolution: -1\n"), HasSubstr("it must be 1e-06 to 1000"));
  EXPECT_THAT(MapMistake("image: a\nresolution: nan\n"), HasSubstr("resolution"));
  EXPECT_THAT(MapMistake("image: a\nresolution: 1\norigin: [1, 2]\n"),
              HasSubstr("m.yaml:3:1: origin is '1, 2'; it must be 3 numbers"));
  EXPECT_THAT(MapMistake("image: a\n\nimage: b\n"), HasSubstr("m.yaml:3:1: image stands in line 1 already"));
  EXPECT_THAT(MapMistake("image: a\nwords\n"), HasSubstr("m.yaml:2:1: 'words' is no line of a map"));
  EXPECT_THAT(MapMistake("image: a\nresolution: 1\nmode: raw\n"), HasSubstr("the mode 'raw' is not read"));
}

}  // namespace
}  // namespace swarmanoid
