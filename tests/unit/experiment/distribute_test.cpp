// Tests <distribute>: many entities are placed without overlaps, from the seed alone.
#include <gtest/gtest.h>

#include <chrono>
#include <map>

#include "common/experiment/body.h"
#include "common/math/elementary.h"
#include "tests/unit/experiment/fake_plugins.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid::test
{
namespace
{

std::string Arena(const std::string& content, const std::string& size = "10,10,3", const std::string& framework = "")
{
  return ExperimentText{.framework = framework, .size = size, .arena = content, .engines = ""}.Text();
}

std::vector<EntityConfiguration> EntitiesOf(const std::string& text)
{
  const LoadedExperiment loaded = LoadText(text);
  EXPECT_EQ(ErrorsOf(text), "");
  return loaded.experiment ? loaded.experiment->entities : std::vector<EntityConfiguration>{};
}

TEST(Distribute, PlacesTheQuantityWithNumberedIds)
{
  const auto entities = EntitiesOf(Arena("<distribute quantity='100'><footbot id='fb'/></distribute>"));
  ASSERT_EQ(entities.size(), 100U);
  EXPECT_EQ(entities.front().id, "fb_0");
  EXPECT_EQ(entities.back().id, "fb_99");
}

TEST(Distribute, BodiesNeitherOverlapNorLeaveTheFloor)
{
  const auto entities =
      EntitiesOf(Arena("<block id='b' position='2,2,0.5' orientation='0,0,30' size='3,0.2,1'/>"
                       "<distribute quantity='500'><footbot id='fb'/></distribute>"
                       "<distribute quantity='5'><handbot id='hb'/></distribute>"));
  ASSERT_EQ(entities.size(), 506U);
  for (std::size_t i = 0; i < entities.size(); ++i)
  {
    const placement::Body body = placement::BodyOf(entities[i]).value();
    const Vector3 half = body.HalfExtent();
    if (entities[i].kind != EntityKind::kBlock)
    {
      EXPECT_GE((body.centre - half).minCoeff(), -1e-9);
      EXPECT_LE((body.centre + half).head<2>().maxCoeff(), 10 + 1e-9);
      EXPECT_EQ(entities[i].pose.position.z(), 0);
    }
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(placement::Overlap(body, placement::BodyOf(entities[k]).value()));
  }
}

// A body counts wherever in the file it is written: before, between or after the elements that distribute.
TEST(Distribute, EveryBodyOfTheFileIsInTheWay)
{
  const std::string left = "<block id='left' position='0.75,1,0.5' size='1.5,2,1'/>";
  const std::string right = "<block id='right' position='3.25,1,0.5' size='1.5,2,1'/>";
  const std::string robots = "<distribute quantity='8'><footbot id='fb'/></distribute>";
  const std::string preys = "<distribute quantity='8'><cylindric_prey id='p' radius='0.05' height='0.1'/></distribute>";
  for (const std::string& content : {left + right + robots + preys, left + robots + right + preys,
                                     robots + left + preys + right, robots + preys + left + right})
  {
    for (const EntityConfiguration& entity : EntitiesOf(Arena(content, "4,2,1")))
    {
      if (entity.kind == EntityKind::kBlock) continue;
      EXPECT_GT(entity.pose.position.x(), 1.5) << entity.id << " in " << content;
      EXPECT_LT(entity.pose.position.x(), 2.5) << entity.id << " in " << content;
    }
  }
}

TEST(Distribute, TheSeedDecidesThePlacesAndNothingElse)
{
  const std::string content = "<distribute quantity='50'><footbot id='fb'/></distribute>";
  const auto first = EntitiesOf(Arena(content));
  const auto again = EntitiesOf(Arena(content));
  const auto other = EntitiesOf(Arena(content, "10,10,3", "<seed>2</seed>"));
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    EXPECT_EQ(first[i].pose.position, again[i].pose.position);
    EXPECT_EQ(first[i].pose.orientation.coeffs(), again[i].pose.orientation.coeffs());
    EXPECT_NE(first[i].pose.position, other[i].pose.position);
  }
}

// Common random numbers: an entity is placed by its id, independent of its place in the file and the entities before
// it.
TEST(Distribute, OthersInTheFileShiftNoPlaces)
{
  const std::string robots = "<distribute quantity='20'><footbot id='fb'/></distribute>";
  const std::string preys =
      "<distribute quantity='20'><cylindric_prey id='p' radius='0.01' height='0.1'/></distribute>";
  const std::string block = "<block id='b' position='39,39,0.5' size='0.2,0.2,1'/>";
  const auto places = [](const std::string& content)
  {
    std::map<std::string, Pose> poses;
    for (const EntityConfiguration& entity : EntitiesOf(Arena(content, "40,40,3"))) poses[entity.id] = entity.pose;
    return poses;
  };
  const auto alone = places(robots);
  for (const std::string& content : {block + robots, robots + block, robots + preys, preys + robots,
                                     "<distribute quantity='30'><footbot id='fb'/></distribute>" + block})
  {
    const auto among_others = places(content);
    for (const auto& [id, pose] : alone)
    {
      EXPECT_EQ(among_others.at(id).position, pose.position) << id << " in " << content;
      EXPECT_EQ(among_others.at(id).orientation.coeffs(), pose.orientation.coeffs()) << id;
    }
  }
}

TEST(Distribute, IdsWhoseRandomNumbersWouldBeEqualAreRefused)
{
  EXPECT_EQ(
      ErrorsOf(Arena("<light_bulb id='7mohtcOFVz' position='1,1,1'/>\n<light_bulb id='c1E51sSEyx' "
                     "position='2,1,1'/>")),
      "test.xml:4:13: the ids 'c1E51sSEyx' and '7mohtcOFVz' (line 3) of two entities have the same 64-bit name, by "
      "which random numbers are drawn; rename one of them\n");
}

TEST(Distribute, UniformStaysInItsBoxWithTheGivenHeadings)
{
  const auto entities =
      EntitiesOf(Arena("<distribute quantity='10'><position min='1,2,1' max='4,5,2'/>"
                       "<orientation method='constant' value='0,0,90'/><eyebot id='eb'/></distribute>"));
  for (const EntityConfiguration& entity : entities)
  {
    EXPECT_TRUE((entity.pose.position.array() >= Eigen::Array3d(1, 2, 1)).all());
    EXPECT_TRUE((entity.pose.position.array() <= Eigen::Array3d(4, 5, 2)).all());
    EXPECT_NEAR(YawOf(entity.pose.orientation), kPi / 2, 1e-12);
  }
}

TEST(Distribute, UniformFillsTheFloorEvenly)
{
  const auto entities = EntitiesOf(Arena("<distribute quantity='1000'><footbot id='fb'/></distribute>", "40,40,1"));
  int quarter[4] = {};
  for (const EntityConfiguration& entity : entities)
  {
    ++quarter[(entity.pose.position.x() > 20 ? 1 : 0) + (entity.pose.position.y() > 20 ? 2 : 0)];
  }
  // Each count is 250, with a standard deviation of 13.7.
  for (const int count : quarter) EXPECT_NEAR(count, 250, 60);
}

TEST(Distribute, GaussianHasItsMeanAndDeviation)
{
  const auto entities =
      EntitiesOf(Arena("<distribute quantity='2000'><position method='gaussian' mean='50,40,0' deviation='5,10,0'/>"
                       "<cylindric_prey id='p' radius='0.01' height='0.1'/></distribute>",
                       "100,100,1"));
  Vector3 mean = Vector3::Zero(), square = Vector3::Zero();
  for (const EntityConfiguration& entity : entities) mean += entity.pose.position / 2000;
  for (const EntityConfiguration& entity : entities) square += (entity.pose.position - mean).cwiseAbs2() / 2000;
  EXPECT_NEAR(mean.x(), 50, 0.5);
  EXPECT_NEAR(mean.y(), 40, 1);
  EXPECT_NEAR(std::sqrt(square.x()), 5, 0.4);
  EXPECT_NEAR(std::sqrt(square.y()), 10, 0.8);
}

TEST(Distribute, GridGoesAlongXFirst)
{
  const auto entities =
      EntitiesOf(Arena("<distribute quantity='5'><position method='grid' centre='5,5,0' "
                       "spacing='1,2,0' layout='3,2,1'/><footbot id='fb'/></distribute>"));
  ASSERT_EQ(entities.size(), 5U);
  const Vector3 expected[] = {{4, 4, 0}, {5, 4, 0}, {6, 4, 0}, {4, 6, 0}, {5, 6, 0}};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_TRUE(entities[i].pose.position.isApprox(expected[i])) << i;
}

TEST(Distribute, GridsOfNegativeSpacingBeginAtTheLargestCoordinatesAndOrientationsMayBeAGrid)
{
  const auto entities = EntitiesOf(Arena(
      "<distribute quantity='5'><position method='grid' centre='5,5,0' spacing='-1,-2,0' layout='3,2,1'/>"
      "<orientation method='grid' centre='0,0,10' spacing='0,0,-30' layout='1,1,4'/><footbot id='fb'/></distribute>"));
  ASSERT_EQ(entities.size(), 5U);
  const std::vector<Vector3> expected = {{6, 6, 55}, {5, 6, 25}, {4, 6, -5}, {6, 4, -35}, {5, 4, 55}};
  for (std::size_t k = 0; k < expected.size(); ++k)
  {
    EXPECT_EQ(entities[k].pose.position, Vector3(expected[k].x(), expected[k].y(), 0)) << k;
    EXPECT_NEAR(RadiansToDegrees(YawOf(entities[k].pose.orientation)), expected[k].z(), 1e-9) << k;
  }
}

TEST(Distribute, AnglesMayBeAboutZThenYThenX)
{
  const auto turned = [](const std::string& orientation)
  {
    return EntitiesOf(Arena("<distribute quantity='30'><position method='uniform' min='1,1,1' max='9,9,2'/>" +
                            orientation + "<block id='b' size='0.1,0.1,0.1'/></distribute>"));
  };
  const Quaternion expected = Eigen::AngleAxisd(DegreesToRadians(10), Vector3::UnitX()) *
                              Eigen::AngleAxisd(DegreesToRadians(20), Vector3::UnitY()) *
                              Eigen::AngleAxisd(DegreesToRadians(30), Vector3::UnitZ());
  for (const EntityConfiguration& entity : turned("<orientation method='constant' axes='zyx' value='30,20,10'/>"))
    EXPECT_LT(entity.pose.orientation.angularDistance(expected), 1e-9);
  // The axis of a body that turns about its axis and then tilts about y leans by the second angle.
  double least = 90, most = 0;
  for (const EntityConfiguration& entity :
       turned("<orientation method='uniform' axes='zyx' min='0,0,0' max='360,60,0'/>"))
  {
    const Vector3 axis = entity.pose.orientation * Vector3::UnitZ();
    EXPECT_NEAR(axis.y(), 0, 1e-9);
    const double lean = RadiansToDegrees(std::atan2(axis.x(), axis.z()));
    least = std::min(least, lean);
    most = std::max(most, lean);
  }
  EXPECT_TRUE(0 <= least && least < 15 && 45 < most && most <= 60) << least << " " << most;
}

TEST(Distribute, GridWithoutSettingsHoldsAll)
{
  EXPECT_EQ(
      EntitiesOf(Arena("<distribute quantity='10'><position method='grid'/><block id='b' size='1,1,1'/></distribute>"))
          .size(),
      10U);
}

TEST(Distribute, ErrorsSayWhatDoesNotFit)
{
  EXPECT_EQ(ErrorsOf(Arena("<distribute quantity='100' max_trials='50'><footbot id='fb'/></distribute>", "1,1,1")),
            "test.xml:3:1: the footbot 'fb_8' does not fit after 8 of 100 were placed: no place free of others and "
            "of rock in 50 trials; "
            "lower the "
            "quantity, enlarge the region or raise max_trials\n");
  EXPECT_EQ(ErrorsOf(Arena(
                "<distribute quantity='5'><position method='grid' layout='2,2,1'/><footbot id='fb'/></distribute>")),
            "test.xml:3:50: a grid of 2 x 2 x 1 has 4 points; 5 are needed\n");
  EXPECT_EQ(ErrorsOf(Arena("<distribute quantity='5'><position max='5,20,0'/><footbot id='fb'/></distribute>")),
            "test.xml:3:26: the box of the positions reaches from 0.085036758, 0.085036758, 0 to 5, 20, 0 m; it must "
            "lie within "
            "the arena of 10, 10, 3 m\n");
  EXPECT_EQ(ErrorsOf(Arena("<distribute quantity='5'/>")),
            "test.xml:3:1: <distribute> must hold one entity element such as <footbot id=\"fb\"/>; it holds 0\n");
  EXPECT_EQ(ErrorsOf(Arena("<distribute quantity='-1'><footbot id='fb' position='1,1,0'/></distribute>")),
            "test.xml:3:13: 'quantity' of <distribute> is -1; it must be from 0 to 2000000\n"
            "test.xml:3:44: <footbot> has no attribute 'position'; allowed: id, controller\n");
}

TEST(Distribute, NoneIsAQuantityToo)
{
  const ExperimentText text{
      .arena = "<distribute quantity='0'><footbot id='fb'/></distribute><footbot id='one' position='1,1,0'/>",
      .physics = "<engine id='e'><entity id='fb_*'/><entity id='one'/></engine>"};
  const LoadedExperiment loaded = LoadText(text.Text());
  ASSERT_TRUE(loaded.experiment);
  EXPECT_EQ(loaded.experiment->entities.size(), 1U);
}

TEST(Distribute, EnginesTakeThemByPatternOrAll)
{
  const ExperimentText text{
      .arena = "<light_bulb id='lamp' position='1,1,2'/><distribute quantity='20'><footbot id='fb'/></distribute>",
      .engines = "<dummy_engine id='a'/><dummy_engine id='b'/><dummy_engine id='c'/>",
      .physics =
          "<engine id='a'><entity id='fb_1?'/></engine><engine id='b'><all/></engine>"
          "<engine id='c'><all kind='footbot'/></engine>"};
  const LoadedExperiment loaded = LoadText(text.Text());
  ASSERT_TRUE(loaded.experiment);
  EXPECT_EQ(loaded.experiment->engines[0].entities.size(), 10U);
  EXPECT_EQ(loaded.experiment->engines[1].entities.size(), 20U);
  EXPECT_EQ(loaded.experiment->engines[2].entities.size(), 20U);
}

}  // namespace
}  // namespace swarmanoid::test
