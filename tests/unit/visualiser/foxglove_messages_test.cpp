// The messages of foxglove_render and of `swarmanoid export --mcap`. tests/web/mcap_test.mjs reads them with Foxglove's
// library.
#include "visualiser/foxglove/foxglove_messages.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "common/program/csv.h"
#include "tests/unit/visualiser/small_world.h"

namespace swarmanoid
{
namespace
{

using Json = nlohmann::json;

class FoxgloveMessagesTest : public testing::Test
{
protected:
  FoxgloveMessagesTest() : world_({6, 6, 2})
  {
    world_.Add(EntityKind::kFootbot, "fb", {1, 2, 0}, 90);
    world_.AddBody(EntityKind::kBlock, "block", {3, 2, 0.1}, {0.4, 0.6, 0.2});
    world_.AddBody(EntityKind::kCylindricPrey, "prey", {4, 2, 0}, {0.1, 0.1, 0.3}, 0xff0000);
    world_.AddBody(EntityKind::kGroundPatch, "disc", {2, 4, 0}, {0.5, 0, 0});
    world_.AddBody(EntityKind::kHole, "hole", {4, 4, 0}, {1, 0.5, 0});
    world_.Add(EntityKind::kLightBulb, "light", {3, 3, 1});
    world_.Add(EntityKind::kHandbot, "hb", {5, 5, 0});
  }
  FoxgloveMessages Messages() { return FoxgloveMessages(world_.Space(), {0, 1, 2, 3, 4, 5, 6}); }
  static const Json& Named(const Json& list, const char* id)
  {
    for (const Json& item : list)
      if (item.contains("id") ? item["id"] == id : item["child_frame_id"] == id) return item;
    static const Json none;
    return none;
  }

  SmallWorld world_;
};

TEST_F(FoxgloveMessagesTest, EachTopicHasASchemaOfItsName)
{
  const auto topics = Messages().Topics();
  const std::pair<const char*, const char*> wanted[] = {{"/tf_static", "foxglove.FrameTransforms"},
                                                        {"/tf", "foxglove.FrameTransforms"},
                                                        {"/scene", "foxglove.SceneUpdate"},
                                                        {"/attributes", "swarmanoid.Attributes"},
                                                        {"/events", "foxglove.Log"}};
  for (std::size_t k = 0; k < topics.size(); ++k)
  {
    EXPECT_EQ(topics[k].topic, wanted[k].first);
    EXPECT_EQ(topics[k].schema_name, wanted[k].second);
    const Json schema = Json::parse(topics[k].schema);
    EXPECT_EQ(schema["title"], wanted[k].second);
    EXPECT_EQ(schema["type"], "object");
  }
  EXPECT_TRUE(Json::parse(topics[FoxgloveMessages::kAttributes].schema)["properties"]["entities"]["items"]["properties"]
                  .contains("turret_angle"));
}

TEST_F(FoxgloveMessagesTest, TransformsAreThoseOfMovableEntitiesOrOfTheOthers)
{
  world_.Space().SetTick(25);
  const FoxgloveMessages messages = Messages();
  EXPECT_EQ(messages.Time(), 2'500'000'000U);
  EXPECT_EQ(messages.TimeOfTick(0.5), 50'000'000U);
  const Json moving = Json::parse(messages.Transforms(true))["transforms"];
  EXPECT_EQ(moving.size(), 3U);
  const Json& robot = Named(moving, "fb");
  EXPECT_EQ(robot["parent_frame_id"], "arena");
  EXPECT_EQ(robot["timestamp"], Json::parse(R"({"sec": 2, "nsec": 500000000})"));
  EXPECT_EQ(robot["translation"], Json::parse(R"({"x": 1.0, "y": 2.0, "z": 0.0})"));
  EXPECT_NEAR(robot["rotation"]["z"], std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(robot["rotation"]["w"], std::sqrt(0.5), 1e-12);
  const Json fixed = Json::parse(messages.Transforms(false))["transforms"];
  EXPECT_EQ(fixed.size(), 4U);
  EXPECT_TRUE(Named(fixed, "fb").is_null());
  world_.Space().SetAttribute(world_.Space().PresenceSlot(0), 0);
  EXPECT_TRUE(Named(Json::parse(messages.Transforms(true))["transforms"], "fb").is_null()) << "outside the arena";
}

TEST_F(FoxgloveMessagesTest, BodiesHaveTheirFormSizeAndColourInTheFrameOfTheEntity)
{
  FoxgloveMessages messages = Messages();
  const Json scene = Json::parse(messages.ChangedScene().value());
  EXPECT_EQ(scene["deletions"], Json::parse(R"([{"timestamp": {"sec": 0, "nsec": 0}, "type": 1, "id": ""}])"));
  struct Row
  {
    const char* id;
    const char* list;
    Vector3 size;
    double height;  // m, of the middle above the entity
    std::uint32_t colour;
  };
  const Vector3 footbot = DescriptionOf(EntityKind::kFootbot).size, handbot = DescriptionOf(EntityKind::kHandbot).size;
  const Row rows[] = {{"fb", "cylinders", {2 * footbot.x(), 2 * footbot.x(), footbot.z()}, footbot.z() / 2, 0xc0c0c0},
                      {"hb", "cubes", handbot, handbot.z() / 2, 0xc0c0c0},
                      {"block", "cubes", {0.4, 0.6, 0.2}, 0, 0xc0c0c0},
                      {"prey", "cylinders", {0.2, 0.2, 0.3}, 0.15, 0xff0000},
                      {"disc", "cylinders", {1, 1, 0.002}, 0, 0xc0c0c0},
                      {"hole", "cubes", {1, 0.5, 0.002}, 0, 0},
                      {"light", "spheres", {0.1, 0.1, 0.1}, 0, 0xc0c0c0}};
  for (const Row& row : rows)
  {
    const Json& entity = Named(scene["entities"], row.id);
    ASSERT_FALSE(entity.is_null()) << row.id;
    EXPECT_EQ(entity["frame_id"], row.id);
    EXPECT_EQ(entity["frame_locked"], true);
    EXPECT_EQ(entity["lifetime"], Json::parse(R"({"sec": 0, "nsec": 0})"));
    ASSERT_EQ(entity[row.list].size(), 1U) << row.id;
    const Json& body = entity[row.list][0];
    const auto vector = [](const Json& json) { return Vector3(json["x"], json["y"], json["z"]); };
    EXPECT_TRUE(vector(body["size"]).isApprox(row.size, 1e-12)) << row.id << " " << body["size"];
    EXPECT_LT((vector(body["pose"]["position"]) - Vector3(0, 0, row.height)).norm(), 1e-12) << row.id;
    EXPECT_EQ(body["pose"]["orientation"], Json::parse(R"({"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0})"));
    EXPECT_EQ(body.contains("top_scale"), std::string(row.list) == "cylinders");
    if (std::string(row.id) == "fb" || std::string(row.id) == "hb" || std::string(row.id) == "light") continue;
    const auto channel = [&](unsigned shift) { return (row.colour >> shift & 0xffU) / 255.0; };
    EXPECT_EQ(body["color"], (Json{{"r", channel(16)}, {"g", channel(8)}, {"b", channel(0)}, {"a", 1.0}})) << row.id;
  }
  EXPECT_EQ(Named(scene["entities"], "prey")["metadata"],
            Json::parse(R"([{"key": "kind", "value": "cylindric_prey"}])"));
}

TEST_F(FoxgloveMessagesTest, LedsThatShineAreSmallBalls)
{
  world_.Set("fb", "led", 0x00ff00, 3);
  FoxgloveMessages messages = Messages();
  const Json scene = Json::parse(messages.ChangedScene().value());
  const Json& balls = Named(scene["entities"], "fb")["spheres"];
  ASSERT_EQ(balls.size(), 1U);
  EXPECT_EQ(balls[0]["color"], Json::parse(R"({"r": 0.0, "g": 1.0, "b": 0.0, "a": 1.0})"));
  EXPECT_NEAR(balls[0]["size"]["x"], 0.016, 1e-12);
  EXPECT_NEAR(balls[0]["pose"]["position"]["z"], 0.085, 1e-12);
}

TEST_F(FoxgloveMessagesTest, TheSceneIsSentAgainAfterChangesOfLooksAndPresence)
{
  FoxgloveMessages messages = Messages();
  EXPECT_TRUE(messages.ChangedScene());
  EXPECT_FALSE(messages.ChangedScene());
  world_.Space().SetPose(0, {{2, 2, 0}, Quaternion::Identity()});
  world_.Set("fb", "turret_angle", 1);
  EXPECT_FALSE(messages.ChangedScene()) << "bodies move with their frames";
  world_.Set("fb", "led", 1, 11);
  EXPECT_TRUE(messages.ChangedScene());
  world_.Set("prey", "colour", 0x00ff00);
  EXPECT_TRUE(messages.ChangedScene());
  world_.Space().SetAttribute(world_.Space().PresenceSlot(2), 0);
  const Json scene = Json::parse(messages.ChangedScene().value());
  EXPECT_EQ(scene["entities"].size(), 6U);
  EXPECT_FALSE(messages.ChangedScene());
  messages.ForgetScene();
  EXPECT_TRUE(messages.ChangedScene());
}

TEST_F(FoxgloveMessagesTest, AttributesAreThoseOfEntitiesInTheArena)
{
  world_.Set("fb", "led", 7, 2);
  world_.Space().SetAttribute(world_.Space().PresenceSlot(2), 0);
  world_.Space().SetTick(10);
  const Json json = Json::parse(Messages().Attributes());
  EXPECT_EQ(json["tick"], 10);
  EXPECT_EQ(json["timestamp"], Json::parse(R"({"sec": 1, "nsec": 0})"));
  EXPECT_EQ(json["entities"].size(), 6U);
  const Json& robot = Named(json["entities"], "fb");
  EXPECT_EQ(robot["kind"], "footbot");
  EXPECT_EQ(robot["led"].size(), 12U);
  EXPECT_EQ(robot["led"][2], 7.0);
}

TEST_F(FoxgloveMessagesTest, EventsAreLinesOfALogAndFailuresAreWarnings)
{
  const Json moved = Json::parse(FoxgloveMessages::Event("7,move,fb,1 2 0,anna@lab:3", 1'500'000'000));
  EXPECT_EQ(moved, Json::parse(R"({"timestamp": {"sec": 1, "nsec": 500000000}, "level": 2,
                                   "message": "move fb 1 2 0: anna@lab:3", "name": "move", "file": "events.csv",
                                   "line": 0})"));
  EXPECT_EQ(Json::parse(FoxgloveMessages::Event("7,pause,,,", 0))["message"], "pause");
  for (const auto& [what, level] : {std::pair("failed", 3), std::pair("refused", 3), std::pair("stop", 2)})
    EXPECT_EQ(Json::parse(FoxgloveMessages::Event("7," + std::string(what) + ",fb,", 0))["level"], level) << what;
}

}  // namespace
}  // namespace swarmanoid
