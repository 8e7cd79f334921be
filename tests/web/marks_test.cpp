#include "visualiser/web/marks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "common/configuration/xml_reader.h"
#include "common/math/elementary.h"
#include "common/mesh/convex_hull.h"
#include "common/plugin_descriptions/describe_builtins.h"

namespace swarmanoid
{
namespace
{

using Pairs = std::set<std::pair<int, int>>;

// Footbots in one engine that have rays and hear each other from 2 m; then blocks that are in it, too.
class MarksTest : public testing::Test
{
protected:
  MarksTest()
  {
    DescribeBuiltins();
    experiment_.arena_size = {10, 10, 2};
    EngineConfiguration& engine = experiment_.engines.emplace_back();
    engine.tag = "dummy_engine";
    engine.id = "ground";
    ControllerConfiguration& controller = experiment_.controllers.emplace_back();
    controller.id = "c";
    controller.sensors = {{"footbot_proximity", "generic_footbot_proximity", {}},
                          {"range_and_bearing", "generic_range_and_bearing", {}}};
    SetReceiver("range='2'");
  }
  void SetReceiver(const std::string& attributes)
  {
    experiment_.controllers[0].sensors[1].tree =
        TConfigurationTree(ReadXml("<range_and_bearing " + attributes + "/>", "test.xml"));
  }
  void Add(EntityKind kind, const Vector3& position, const Vector3& size, double yaw = 0)
  {
    EntityConfiguration& entity = experiment_.entities.emplace_back();
    entity.kind = kind;
    entity.id = "e" + std::to_string(experiment_.entities.size() - 1);
    entity.pose = {position, QuaternionFromYaw(yaw)};
    entity.size = size;
    entity.movable = true;
    if (IsRobot(kind)) entity.controller = "c";
    experiment_.engines[0].entities.push_back(static_cast<std::uint32_t>(experiment_.entities.size() - 1));
  }
  void AddFootbot(double x, double y, double yaw = 0)
  {
    Add(EntityKind::kFootbot, {x, y, 0}, DescriptionOf(EntityKind::kFootbot).size, yaw);
  }
  CSwarmanoidSpace& Space()
  {
    if (!space_) space_ = std::make_unique<CSwarmanoidSpace>(experiment_);
    return *space_;
  }
  void Send(std::uint32_t robot) { Space().SetAttribute(Space().GetEntity(robot).SlotOf("message"), 1); }
  nlohmann::json Marks(const MarksRequest& request)
  {
    return nlohmann::json::parse(MarksWriter(Space()).Text(request));
  }
  static Pairs PairsOf(const nlohmann::json& list)
  {
    Pairs pairs;
    for (std::size_t i = 0; i + 1 < list.size(); i += 2) pairs.emplace(list[i], list[i + 1]);
    return pairs;
  }

  Experiment experiment_;
  std::unique_ptr<CSwarmanoidSpace> space_;
};

TEST_F(MarksTest, RaysEndWhereTheyMeetACylinder)
{
  constexpr double kRadius = 0.1, kAway = 0.22;
  AddFootbot(3, 4, 0.3);
  const Vector3 prey(3 + kAway * std::cos(0.3), 4 + kAway * std::sin(0.3), 0);
  Add(EntityKind::kCylindricPrey, prey, {kRadius, kRadius, 0.2});
  const auto rays = Marks({.rays = {0, 1}, .bodies = {}, .links = {}})["rays"];
  ASSERT_EQ(rays["entities"], nlohmann::json({0}));
  const ProximityRing& ring = *DescriptionOf(EntityKind::kFootbot).proximity;
  int hits = 0;
  for (std::size_t i = 0; i < ring.sensors.size(); ++i)
  {
    // The expected numbers are in the frame of the robot, by the formula of a line and a circle.
    const auto& [place, direction] = ring.sensors[i];
    const Vector2 way(std::cos(direction), std::sin(direction));
    const Vector2 to = Vector2(kAway, 0) - place;
    const double along = to.dot(way), aside = to.squaredNorm() - along * along;
    const double distance = aside < kRadius * kRadius ? along - std::sqrt(kRadius * kRadius - aside) : 1e9;
    const bool meets = distance > 0 && distance < ring.range_m;
    hits += meets;
    EXPECT_NEAR(rays["hits"][0][i].get<double>(), meets ? distance / ring.range_m : 1, 1e-4) << i;
  }
  EXPECT_GT(hits, 1);
}

TEST_F(MarksTest, LinksAreThoseInRangeAndInSightOfWhoSends)
{
  AddFootbot(1, 1);
  AddFootbot(2.9, 1);  // in range of the first
  AddFootbot(1, 3.1);  // out of range of all
  AddFootbot(2, 2);    // behind a block for the second alone
  AddFootbot(1, 1.5);  // in sight of the first
  Add(EntityKind::kBlock, {2.45, 1.5, 0.2}, {0.3, 0.3, 0.4});
  Send(0);
  Send(3);
  Send(4);
  const auto links = Marks({.rays = {}, .bodies = {}, .links = {0, 1, 2, 3, 4, 5}})["links"];
  EXPECT_EQ(PairsOf(links["both"]), (Pairs{{0, 3}, {0, 4}, {3, 4}}));
  EXPECT_EQ(PairsOf(links["one"]), (Pairs{{0, 1}, {3, 2}, {4, 1}, {4, 2}}));
}

TEST_F(MarksTest, LinksAreThoseOfTheReceiversAntennaAndSight)
{
  AddFootbot(1, 1);
  AddFootbot(2, 1);
  Add(EntityKind::kBlock, {1.5, 1, 0.15}, {0.1, 1, 0.3});
  Send(0);
  const auto links = [&] { return PairsOf(Marks({.rays = {}, .bodies = {}, .links = {0, 1}})["links"]["one"]); };
  EXPECT_EQ(links(), Pairs{}) << "the block is higher than the antennas";
  space_.reset();
  SetReceiver("range='2' antenna='0.31'");
  Send(0);
  EXPECT_EQ(links(), (Pairs{{0, 1}}));
  space_.reset();
  SetReceiver("range='2' line_of_sight='false'");
  Send(0);
  EXPECT_EQ(links(), (Pairs{{0, 1}}));
}

TEST_F(MarksTest, LinksNeedOnlyTheRangeOfAUsersSensor)
{
  PluginDescription own;
  own.label = "range_and_bearing";
  own.implementation = "own_range_and_bearing";
  own.parameters = {
      {"range", ParameterType::kNumber, "m", "3", "Distance from which packets are received.", 0.001, 10}};
  PluginCatalogue::Instance().Add(PluginKind::kSensor, own);
  experiment_.controllers[0].sensors[1].implementation = own.implementation;
  AddFootbot(1, 1);
  AddFootbot(2.5, 1);
  AddFootbot(1, 3.5);
  AddFootbot(1, 4.5);
  Add(EntityKind::kBlock, {1.7, 1, 0.15}, {0.1, 0.5, 0.3});
  Send(0);
  const auto links = Marks({.rays = {}, .bodies = {}, .links = {0}})["links"];
  EXPECT_EQ(PairsOf(links["one"]), Pairs{}) << "out of range, or behind the block";
  SetReceiver("range='3'");
  space_.reset();
  Send(0);
  EXPECT_EQ(PairsOf(Marks({.rays = {}, .bodies = {}, .links = {0}})["links"]["one"]), (Pairs{{0, 2}}));
}

TEST_F(MarksTest, LinksAreTheSameWhoeverIsAskedFirst)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0.5, 6);
  for (int i = 0; i < 40; ++i) AddFootbot(place(random), place(random));
  for (std::uint32_t i = 0; i < 40; i += 3) Send(i);
  std::vector<std::uint32_t> all(40);
  for (std::uint32_t i = 0; i < 40; ++i) all[i] = i;
  const auto whole = Marks({.rays = {}, .bodies = {}, .links = all})["links"];
  Pairs sum_both, sum_one;
  for (std::uint32_t i = 0; i < 40; ++i)
  {
    const auto links = Marks({.rays = {}, .bodies = {}, .links = {i}})["links"];
    for (auto [a, b] : PairsOf(links["both"])) sum_both.emplace(std::min(a, b), std::max(a, b));
    sum_one.merge(PairsOf(links["one"]));
  }
  EXPECT_EQ(PairsOf(whole["both"]), sum_both);
  EXPECT_EQ(PairsOf(whole["one"]), sum_one);
  EXPECT_GT(sum_one.size(), 20u);
}

TEST_F(MarksTest, BodiesAreThoseThatEnginesCollideAndEachModelIsToldOnce)
{
  AddFootbot(1, 1);
  AddFootbot(2, 1);
  Add(EntityKind::kBlock, {3, 1, 0.1}, {0.4, 0.6, 0.2});
  const auto shapes = Marks({.rays = {}, .bodies = {0, 1, 2, 77}, .links = {}})["shapes"];
  EXPECT_EQ(shapes["entities"], nlohmann::json({0, 1, 2}));
  EXPECT_EQ(shapes["models"], nlohmann::json({0, 0, 1}));
  const auto& block = shapes["bodies"][1];
  ASSERT_EQ(block.size(), 1u);
  EXPECT_EQ(block[0], nlohmann::json({0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.2, 0.3, 0.1}));
}

TEST_F(MarksTest, RaysNeedASensorOfProximityAndScansOneOfRange)
{
  AddFootbot(1, 1);
  AddFootbot(2, 1);
  experiment_.entities[1].controller.clear();
  const auto marks = Marks({.rays = {0, 1}, .bodies = {}, .links = {}});
  EXPECT_EQ(marks["type"], "marks");
  EXPECT_EQ(marks["tick"], 0);
  EXPECT_EQ(marks["rays"]["entities"], nlohmann::json({0}));
  ASSERT_EQ(marks["rays"]["hits"].size(), 1u);
  for (const auto& hit : marks["rays"]["hits"][0]) EXPECT_EQ(hit, 1.0) << "nothing is near";
  EXPECT_EQ(marks["scans"], nlohmann::json::array());
}

TEST_F(MarksTest, BeamsOfScannersEndAtBodiesAndAtTheirRangeInTheFrameOfTheRobot)
{
  experiment_.controllers[0].sensors = {{"range_scanner", "generic_range_scanner", {}}};
  experiment_.controllers[0].sensors[0].tree = TConfigurationTree(
      ReadXml("<range_scanner beams='4' field_of_view='360' range='1.5' position='0, 0, 0.1'/>", "test.xml"));
  AddFootbot(3, 4, kPi / 2);
  Add(EntityKind::kBlock, {3, 5, 0.5}, {1, 1, 1});  // its face is 0.5 m before the robot
  const auto marks = Marks({.rays = {0}, .bodies = {}, .links = {}});
  EXPECT_TRUE(marks["rays"]["entities"].empty());
  ASSERT_EQ(marks["scans"].size(), 1u);
  const auto& scan = marks["scans"][0];
  EXPECT_EQ(scan["entity"], 0);
  EXPECT_EQ(scan["from"], nlohmann::json({0.0, 0.0, 0.1}));
  const auto places = [](const nlohmann::json& numbers)
  {
    std::vector<std::vector<double>> list;
    for (std::size_t k = 0; k + 3 <= numbers.size(); k += 3)
      list.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
    return list;
  };
  const auto at = [](double x, double y)
  {
    using testing::DoubleNear;
    return testing::ElementsAre(DoubleNear(x, 1e-4), DoubleNear(y, 1e-4), DoubleNear(0.1, 1e-4));
  };
  EXPECT_THAT(places(scan["hit"]), testing::ElementsAre(at(0.5, 0)));
  EXPECT_THAT(places(scan["free"]), testing::UnorderedElementsAre(at(-1.5, 0), at(0, 1.5), at(0, -1.5)));
}

TEST_F(MarksTest, HullsAreShownByTheirEdges)
{
  Add(EntityKind::kBlock, {3, 1, 0.1}, {0.4, 0.6, 0.2});
  std::vector<Vector3> corners{{0, 0, -0.1}, {0.2, 0, -0.1}, {0, 0.3, -0.1}, {0, 0, 0.1}};
  experiment_.entities[0].hull = std::make_shared<const ConvexHull>(HullOf(corners));
  const auto shapes = Marks({.rays = {}, .bodies = {0}, .links = {}})["shapes"];
  ASSERT_EQ(shapes["bodies"].size(), 1u);
  const auto& hull = shapes["bodies"][0][0];
  EXPECT_EQ(hull[0], 2);
  EXPECT_EQ(hull.size(), 1 + 6 * 6u) << "a tetrahedron has six edges";
  for (std::size_t k = 1; k < hull.size(); k += 3)
    EXPECT_TRUE(std::ranges::any_of(corners, [&](const Vector3& corner)
                                    { return (corner - Vector3(hull[k], hull[k + 1], hull[k + 2])).norm() < 1e-3; }))
        << k;
}

TEST_F(MarksTest, WhoIsNotInTheArenaHasNone)
{
  AddFootbot(1, 1);
  AddFootbot(1.5, 1);
  Send(0);
  Send(1);
  Space().SetAttribute(Space().PresenceSlot(1), 0);
  const auto marks = Marks({.rays = {0, 1}, .bodies = {0, 1}, .links = {0, 1}});
  EXPECT_EQ(marks["rays"]["entities"], nlohmann::json({0}));
  EXPECT_EQ(marks["shapes"]["entities"], nlohmann::json({0}));
  EXPECT_TRUE(marks["links"]["both"].empty());
  EXPECT_TRUE(marks["links"]["one"].empty());
}

}  // namespace
}  // namespace swarmanoid
