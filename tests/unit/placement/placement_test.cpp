// <distribute> in terrain, and with the outlines of the engines: as these are described.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "common/experiment/body.h"
#include "common/experiment/load_experiment.h"
#include "common/math/random.h"
#include "common/plugin_descriptions/describe_builtins.h"
#include "common/space/terrain/terrain.h"
#include "test_folders.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid
{
namespace
{

std::unique_ptr<Experiment> Loaded(const test::ExperimentText& text)
{
  DescribeBuiltins();
  return text.Load("/");
}

// The entities of an arena with one engine of the tag that holds all.
std::vector<EntityConfiguration> EntitiesIn(const std::string& engine, const std::string& size,
                                            const std::string& content)
{
  const auto experiment = Loaded({.size = size, .arena = content, .engines = "<" + engine + " id='e'/>"});
  return experiment ? experiment->entities : std::vector<EntityConfiguration>{};
}

const std::string kHills = "<terrain id='hills' position='0,0,0'><heightmap file='" SWARMANOID_SOURCE_FOLDER
                           "/configs/terrain/hills.png' size='4, 4' height='0.4'/></terrain>";

// Points all over the body of an entity that are inside a terrain.
int PointsInRock(const EntityConfiguration& entity, const EntityConfiguration& terrain)
{
  const auto rock = LoadTerrain(terrain, "/");
  const placement::Body body = placement::BodyOf(entity).value();
  int inside = 0;
  RandomStream random(1, 0, 0, 0);
  for (int i = 0; i < 3000; ++i)
  {
    const Vector3 part(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
    if (body.cylinder && part.head<2>().norm() > 0.97) continue;
    const Vector3 point = body.centre + body.orientation * (0.97 * part.cwiseProduct(body.half));
    inside += rock->IsSolid(terrain.pose.Inverse().Apply(point));
  }
  return inside;
}

TEST(Distribute, LetsRobotsDownOntoTheTerrain)
{
  const auto entities =
      EntitiesIn("dynamics3d", "4,4,2",
                 kHills + "<distribute quantity='40'><position drop_from='2'/><footbot id='fb'/></distribute>");
  ASSERT_EQ(entities.size(), 41U);
  const auto hills = LoadTerrain(entities[0], "/");
  double highest = 0;
  for (std::size_t i = 1; i < entities.size(); ++i)
  {
    const Vector3& place = entities[i].pose.position;
    EXPECT_LE(PointsInRock(entities[i], entities[0]), 3) << entities[i].id;  // between the points that were looked at
    const double below = hills->GroundBelow({place.x(), place.y(), 2}).value();
    EXPECT_GE(place.z(), below);
    EXPECT_LE(place.z(), below + 0.1) << "stands on the ground";
    highest = std::max(highest, place.z());
  }
  EXPECT_GT(highest, 0.1);
}

TEST(Distribute, StartsNobodyInsideARock)
{
  const std::string content = "<distribute quantity='20'><position max='4,4,0.6'/><footbot id='fb'/></distribute>";
  const auto free = EntitiesIn("dynamics3d", "4,4,2", content);
  const auto entities = EntitiesIn("dynamics3d", "4,4,2", kHills + content);
  ASSERT_EQ(entities.size(), 21U);
  int moved = 0;
  for (std::size_t i = 0; i < free.size(); ++i) moved += free[i].pose.position != entities[i + 1].pose.position;
  EXPECT_GT(moved, 0) << "without terrain some would start in it";
  for (std::size_t i = 1; i < entities.size(); ++i) EXPECT_LE(PointsInRock(entities[i], entities[0]), 3) << i;
}

// The outline of figure 3.9 has the gripper's square in front of the body; the turret may turn it anywhere. The same
// robots start at the same places in each engine.
TEST(Distribute, KeepsGrippersApart)
{
  const std::string crowd = "<distribute quantity='250' max_trials='1000'><footbot id='fb'/></distribute>";
  const auto kinematic = EntitiesIn("kinematics2d", "5,5,1", crowd);
  double nearest = 10;
  for (std::size_t i = 0; i < kinematic.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      nearest = std::min(nearest, (kinematic[i].pose.position - kinematic[k].pose.position).norm());
  EXPECT_GE(nearest, 2 * std::hypot(0.1, 0.015));
  EXPECT_LT(nearest, 0.23) << "a crowd";
  for (const char* engine : {"dynamics2d", "dynamics3d"})
  {
    const auto others = EntitiesIn(engine, "5,5,1", crowd);
    for (std::size_t i = 0; i < others.size(); ++i)
      EXPECT_EQ(others[i].pose.position, kinematic[i].pose.position) << engine;
  }
}

// Returns an experiment with two engines that share the robots of one <distribute>, in the order of their numbers or of
// their positions.
std::unique_ptr<Experiment> Ordered(const std::string& order)
{
  return Loaded(
      {.size = "60,60,2",
       .arena = "<footbot id='first' position='1,1,0'/><distribute quantity='900' order='" + order +
                "'><footbot id='fb'/></distribute><footbot id='last' position='59,59,0'/>",
       .engines = "<dummy_engine id='a'/><dummy_engine id='b'/>",
       .physics = "<engine id='a'><entity id='fb_7'/><entity id='last'/></engine><engine id='b'><all/></engine>"});
}

double WayAlong(const std::vector<EntityConfiguration>& entities)
{
  double way = 0;
  for (std::size_t i = 2; i + 1 < entities.size(); ++i)
    way += (entities[i].pose.position - entities[i - 1].pose.position).norm();
  return way;
}

TEST(Distribute, InTheOrderOfTheirPlacesNeighboursStandTogetherAndNothingElseChanges)
{
  const auto by_number = Ordered("number");
  const auto by_place = Ordered("place");
  ASSERT_TRUE(by_number && by_place);
  ASSERT_EQ(by_place->entities.size(), 902U);
  EXPECT_EQ(by_place->entities.front().id, "first");
  EXPECT_EQ(by_place->entities.back().id, "last");
  std::map<std::string, Pose> poses;
  for (const EntityConfiguration& entity : by_place->entities) poses[entity.id] = entity.pose;
  for (const EntityConfiguration& entity : by_number->entities)
  {
    EXPECT_EQ(poses.at(entity.id).position, entity.pose.position) << entity.id;
    EXPECT_EQ(poses.at(entity.id).orientation.coeffs(), entity.pose.orientation.coeffs()) << entity.id;
  }
  for (std::size_t i = 1; i <= 900; ++i) EXPECT_EQ(by_number->entities[i].id, "fb_" + std::to_string(i - 1));
  // There are 900 robots, 2 m apart: the distances are from each to the next one, not across the arena.
  EXPECT_LT(WayAlong(by_place->entities), 900 * 3.0);
  EXPECT_GT(WayAlong(by_number->entities), 900 * 20.0);
}

TEST(Distribute, EnginesHaveTheSameRobotsInEitherOrder)
{
  for (const char* order : {"number", "place"})
  {
    const auto experiment = Ordered(order);
    ASSERT_TRUE(experiment);
    std::vector<std::string> ids;
    for (const std::uint32_t i : experiment->engines[0].entities) ids.push_back(experiment->entities[i].id);
    EXPECT_EQ(ids, (std::vector<std::string>{"fb_7", "last"})) << order;
    EXPECT_EQ(experiment->engines[1].entities.size(), 902U);
    EXPECT_TRUE(std::ranges::is_sorted(experiment->engines[1].entities));
  }
}

}  // namespace
}  // namespace swarmanoid
