#include "visualiser/web/page_messages.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include <octomap/OcTree.h>

#include "common/messages/control_verbs.h"
#include "tests/web/four_entities.h"
#include "tests/world/fake_run.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

TEST(WebMessages, RequestsAreRead)
{
  EXPECT_THAT(std::get<WatchRequest>(ParseRequest(R"({"do": "watch", "entities": [3, 1]})")).entities,
              ElementsAre(3, 1));
  EXPECT_EQ(std::get<ProveRequest>(ParseRequest(R"({"do": "prove", "proof": "ab"})")).proof, "ab");
  const auto marks =
      std::get<MarksRequest>(ParseRequest(R"({"do": "marks", "rays": [1], "bodies": [], "links": [2, 3]})"));
  EXPECT_THAT(marks.rays, ElementsAre(1));
  EXPECT_THAT(marks.bodies, ElementsAre());
  EXPECT_THAT(marks.links, ElementsAre(2, 3));
}

nlohmann::json JsonOf(const ControlOrder& order)
{
  nlohmann::json json{{"do", order.verb}};
  for (const ControlArgument& argument : order.arguments)
    if (const auto* pose = std::get_if<std::vector<double>>(&argument.value))
    {
      json["position"] = std::vector<double>(pose->begin(), pose->begin() + 3);
      if (pose->size() == 6) json["angles"] = std::vector<double>(pose->begin() + 3, pose->end());
    }
    else
      std::visit([&](const auto& plain) { json[argument.name] = plain; }, argument.value);
  return json;
}

TEST(WebMessages, OrdersAreTheRowsOfTheTable)
{
  const auto refusal = [](const nlohmann::json& json) -> std::string
  {
    try
    {
      ParseRequest(json.dump());
    }
    catch (const std::invalid_argument& error)
    {
      return error.what();
    }
    return "";
  };
  for (const ControlVerb& verb : ControlVerbs())
  {
    ControlOrder order{verb.name};
    for (const ControlParameter& parameter : verb.parameters)
    {
      ControlValue value = std::string("über");
      if (parameter.type == ArgumentType::kWhole || parameter.type == ArgumentType::kChange)
        value = static_cast<std::int64_t>(parameter.minimum + 1);
      if (parameter.type == ArgumentType::kNumber) value = parameter.minimum;
      if (parameter.type == ArgumentType::kPose) value = std::vector<double>{1, 2, 0.5, 0, 0, 90};
      if (parameter.type == ArgumentType::kChoice) value = parameter.choices[0];
      order.arguments.push_back({parameter.name, value});
    }
    const nlohmann::json good = JsonOf(order);
    if (verb.who > Asker::kMember)
    {
      EXPECT_THAT(refusal(good), HasSubstr("there is no request '" + verb.name + "'"));
      continue;
    }
    EXPECT_EQ(std::get<ControlOrder>(ParseRequest(good.dump())), order);
    nlohmann::json extra = good;
    extra["extra"] = 1;
    EXPECT_THAT(refusal(extra), HasSubstr(FormOf(verb)));
    for (const ControlParameter& parameter : verb.parameters)
    {
      const std::string member = parameter.type == ArgumentType::kPose ? "position" : parameter.name;
      nlohmann::json missing = good;
      missing.erase(member);
      EXPECT_EQ(refusal(missing).empty(), parameter.optional) << verb.name << " " << member;
      for (const nlohmann::json& bad : {nlohmann::json({1, 2}), nlohmann::json(1e300), nlohmann::json(true)})
      {
        nlohmann::json wrong = good;
        wrong[member] = bad;
        EXPECT_NE(refusal(wrong), "") << verb.name << " " << member << " " << bad;
      }
    }
  }
}

TEST(WebMessages, EverythingElseIsRefusedWithAReason)
{
  const auto refusal = [](const std::string& text) -> std::string
  { return test::MessageOf<std::invalid_argument>([&] { ParseRequest(text); }); };
  EXPECT_THAT(refusal("{"), HasSubstr("JSON"));
  EXPECT_THAT(refusal("[1]"), HasSubstr("JSON"));
  EXPECT_THAT(refusal("\xff\xfe"), HasSubstr("JSON"));
  EXPECT_THAT(refusal(R"({"do": "explode"})"), HasSubstr("no request 'explode'"));
  EXPECT_THAT(refusal(R"({"do": 3})"), HasSubstr("'do'"));
  EXPECT_THAT(refusal(R"({"do": "step", "ticks": 0})"), HasSubstr("1 to"));
  EXPECT_THAT(refusal(R"({"do": "speed", "factor": "fast"})"), HasSubstr("no multiple of real time"));
  EXPECT_THAT(refusal(R"({"do": "speed", "factor": 1e300})"), HasSubstr("0 to"));
  EXPECT_THAT(refusal(R"({"do": "watch", "entities": ["fb_0"]})"), HasSubstr("number"));
  EXPECT_THAT(refusal(R"({"do": "watch", "entities": [1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17]})"), HasSubstr("16"));
  EXPECT_THAT(refusal(R"({"do": "move", "entity": "fb_0", "position": [1, 2]})"), HasSubstr("three"));
  EXPECT_THAT(refusal(R"({"do": "move", "entity": "fb_0", "angles": [0, 0, 90]})"), HasSubstr("write move ENTITY"));
  EXPECT_THAT(refusal(R"({"do": "move", "entity": "fb_0", "position": [1, 2, 1e99], "angles": [0, 0, 0]})"),
              HasSubstr("1e+99"));
  EXPECT_THAT(refusal(R"({"do": "remove"})"), HasSubstr("'entity' is missing"));
  EXPECT_THAT(refusal(R"({"do": "prove", "proof": 1})"), HasSubstr("'proof'"));
  EXPECT_THAT(refusal(R"({"do": "marks", "rays": [1]})"), HasSubstr("'bodies'"));
  EXPECT_THAT(refusal(R"({"do": "press", "key": "\u0000"})"), HasSubstr("without control characters"));
  EXPECT_THAT(refusal(R"({"do": "select", "entity": "a\nb"})"), HasSubstr("one line"));
  EXPECT_THAT(refusal(R"({"do": "select", "entity": ")" + std::string(1025, 'x') + "\"}"),
              HasSubstr("has 1025 bytes; it must have at most 1024"));
  // Deeper than any stack would like.
  EXPECT_THAT(refusal(std::string(60000, '[')), HasSubstr("JSON"));
}

TEST(WebMessages, TheWorldNamesEntitiesOwnersAndBodies)
{
  const FourEntities world;
  const auto json = nlohmann::json::parse(WorldText(world.space, world.assignment));
  EXPECT_EQ(json["entities"]["id"][0], "fb_0");
  EXPECT_EQ(json["kinds"][json["entities"]["kind"][0].get<int>()], "footbot");
  EXPECT_EQ(json["looks"]["footbot"]["role"], "robot");
  EXPECT_EQ(json["looks"]["block"]["form"], "box");
  EXPECT_EQ(json["looks"]["light_bulb"]["form"], "none");
  EXPECT_EQ(json["entities"]["movable"], nlohmann::json({1, 1, 1, 0}));
  EXPECT_EQ(json["entities"]["engine"][0], 0);
  EXPECT_EQ(json["engines"][0]["id"], "ground");
  // The robots' bodies are the page's own.
  ASSERT_EQ(json["bodies"].size(), 2u);
  EXPECT_EQ(json["bodies"][0]["entity"], 2);
  EXPECT_EQ(json["bodies"][0]["size"], nlohmann::json({0.1, 0.1, 0.2}));
}

TEST(WebMessages, AChallengeIsGivenOnlyIfThereIsSomethingToProve)
{
  const auto needed = nlohmann::json::parse(WelcomeText(true, "0123"));
  EXPECT_EQ(needed["control"], "token needed");
  EXPECT_EQ(needed["challenge"], "0123");
  const auto watched = nlohmann::json::parse(WelcomeText(false, "0123"));
  EXPECT_EQ(watched["control"], "read-only");
  EXPECT_FALSE(watched.contains("challenge"));
}

TEST(WebMessages, TheWorldHasViewpointsAndTheRaysOfEachKind)
{
  const FourEntities world;
  Viewpoints viewpoints;
  viewpoints.Store(2, {.position = {1, 2, 3}, .heading = 90, .pitch = -20, .roll = 5});
  const auto json = nlohmann::json::parse(WorldText(world.space, world.assignment, viewpoints, true));
  EXPECT_EQ(json["viewpoints"],
            nlohmann::json::parse(
                R"([{"number": 2, "position": [1.0, 2.0, 3.0], "heading": 90.0, "pitch": -20.0, "roll": 5.0}])"));
  EXPECT_EQ(json["begins_at_viewpoint"], true);
  EXPECT_EQ(json["looks"]["footbot"]["proximity"]["sensors"].size(), 24u);
  EXPECT_EQ(json["looks"]["eyebot"]["proximity"]["sensors"].size(), 24u);
  EXPECT_FALSE(json["looks"].at("cylindric_prey").contains("proximity"));
}

TEST(WebMessages, ColoursOfWhatStandsStillFollowTheSpace)
{
  FourEntities world;
  world.space.GetEntity(3).SetAttribute("colour", 0x123456);
  const auto json = nlohmann::json::parse(ColoursText(world.space));
  EXPECT_EQ(json["entities"], nlohmann::json({3}));
  EXPECT_EQ(json["colours"], nlohmann::json({0x123456}));
}

TEST(WebMessages, WatchedEntitiesShowTheirAttributes)
{
  FourEntities world;
  world.space.GetEntity(0).SetAttribute("gripper_aperture", 0.5);
  const std::vector<std::uint32_t> watched{0};
  const auto json = nlohmann::json::parse(WatchedText(world.space, watched, nullptr));
  EXPECT_EQ(json["entities"][0]["entity"], 0);
  EXPECT_EQ(json["entities"][0]["attributes"]["gripper_aperture"], nlohmann::json({0.5}));
  EXPECT_EQ(json["entities"][0]["attributes"]["led"].size(), 12u);
}

TEST(WebMessages, TheTimelineHasTheFirstEventsAndTellsHowManyThereWere)
{
  const std::vector<TimelineEvent> events(1500, {7, "move", "fb_1", "anna@lab:3"});
  const auto json = nlohmann::json::parse(TimelineText("/runs/a", 100, 200, events));
  EXPECT_EQ(json["run"], "/runs/a");
  EXPECT_EQ(json["first"], 100);
  EXPECT_EQ(json["last"], 199);
  EXPECT_EQ(json["events"].size(), 1000u);
  EXPECT_EQ(json["all_events"], 1500);
  EXPECT_EQ(json["events"][0],
            nlohmann::json::parse(R"({"tick": 7, "what": "move", "entity": "fb_1", "from": "anna@lab:3"})"));
}

TEST(WebMessages, ThePastHasAttributesAndColoursOfItsTick)
{
  FourEntities world;
  world.space.GetEntity(3).SetAttribute("colour", 0x123456);
  const std::vector<std::uint32_t> wanted{0};
  const auto json = nlohmann::json::parse(PastText(world.space, wanted));
  EXPECT_EQ(json["type"], "past");
  EXPECT_EQ(json["tick"], world.space.GetTick());
  EXPECT_EQ(json["entities"][0]["attributes"]["led"].size(), 12u);
  EXPECT_EQ(json["colours"]["colours"], nlohmann::json({0x123456}));
}

TEST(WebMessages, WhoeverLooksMayLookBack)
{
  const PageRequest request = ParseRequest(R"({"do": "look_back", "tick": 500, "entities": [3]})");
  EXPECT_FALSE(std::holds_alternative<ControlOrder>(request));
  EXPECT_EQ(std::get<LookBackRequest>(request).tick, 500u);
  EXPECT_EQ(std::get<LookBackRequest>(request).entities, std::vector<std::uint32_t>{3});
  const PageRequest earlier = ParseRequest(R"({"do": "look_back", "tick": 7, "entities": [], "earlier": true})");
  EXPECT_EQ(std::get<EarlierRequest>(earlier).look_back.tick, 7u);
  EXPECT_TRUE(std::holds_alternative<LookBackRequest>(
      ParseRequest(R"({"do": "look_back", "tick": 7, "entities": [], "earlier": "yes"})")));
  EXPECT_THROW(ParseRequest(R"({"do": "look_back", "tick": -1})"), std::invalid_argument);
  EXPECT_THROW(ParseRequest(R"({"do": "look_back", "entities": []})"), std::invalid_argument);
}

TEST(WebMessages, RequestsWithoutAuthorityAreReadUpToTheirLimits)
{
  EXPECT_EQ(std::get<StartBranchRequest>(ParseRequest(R"({"do": "branch", "tick": 12})")).tick, 12u);
  EXPECT_EQ(std::get<StartBranchRequest>(ParseRequest(R"({"do": "branch", "tick": 0})")).tick, 0u);
  EXPECT_THROW(ParseRequest(R"({"do": "branch", "tick": "12"})"), std::invalid_argument);
  EXPECT_THROW(ParseRequest(R"({"do": "branch", "tick": 2e15})"), std::invalid_argument);
  EXPECT_EQ(std::get<FrameRateRequest>(ParseRequest(R"({"do": "frame_period", "ms": 0})")).period_ms, 0u);
  EXPECT_EQ(std::get<FrameRateRequest>(ParseRequest(R"({"do": "frame_period", "ms": 60000})")).period_ms, 60000u);
  EXPECT_THROW(ParseRequest(R"({"do": "frame_period", "ms": 60001})"), std::invalid_argument);
  EXPECT_THROW(ParseRequest(R"({"do": "frame_period", "ms": -1})"), std::invalid_argument);
  const auto with = [](const char* verb, const char* name, std::size_t entities, std::uint64_t last = 0)
  {
    nlohmann::json request{{"do", verb}, {"rays", {}}, {"bodies", {}}, {"links", {}}};
    request["rays"] = request["bodies"] = request["links"] = nlohmann::json::array();
    request[name] = std::vector<std::uint64_t>(entities, last);
    return request.dump();
  };
  EXPECT_EQ(std::get<WatchRequest>(ParseRequest(with("watch", "entities", 16))).entities.size(), 16u);
  EXPECT_THROW(ParseRequest(with("watch", "entities", 17)), std::invalid_argument);
  EXPECT_THAT(std::get<WatchRequest>(ParseRequest(with("watch", "entities", 1, 4294967295))).entities,
              ElementsAre(4294967295));
  EXPECT_THROW(ParseRequest(with("watch", "entities", 1, 4294967296)), std::invalid_argument);
  for (const char* marks : {"rays", "bodies", "links"})
  {
    EXPECT_NO_THROW(ParseRequest(with("marks", marks, 1000))) << marks;
    EXPECT_THROW(ParseRequest(with("marks", marks, 1001)), std::invalid_argument) << marks;
  }
}

TEST(WebMessages, TheFirstMessageHasTheProtocolAndWhetherAFileIsEdited)
{
  const auto run = nlohmann::json::parse(WelcomeText(true, "0123"));
  EXPECT_EQ(run["type"], "welcome");
  EXPECT_EQ(run["protocol"], 3);
  EXPECT_FALSE(run.contains("edits"));
  EXPECT_EQ(nlohmann::json::parse(WelcomeText(true, "0123", true))["edits"], true);
}

TEST(WebMessages, AuthorityIsOneOfThreeWords)
{
  for (const auto& [authority, word] :
       {std::pair(Authority::kControl, "granted"), std::pair(Authority::kWrongToken, "wrong token"),
        std::pair(Authority::kReadOnly, "read-only")})
    EXPECT_EQ(nlohmann::json::parse(AuthorityText(authority)),
              (nlohmann::json{{"type", "authority"}, {"control", word}}));
}

TEST(WebMessages, ShortAnswersHaveTheirFields)
{
  using Json = nlohmann::json;
  EXPECT_EQ(Json::parse(RefusalText("no")), (Json{{"type", "reply"}, {"ok", false}, {"text", "no"}}));
  EXPECT_EQ(Json::parse(LogText(7, "server", "warning", "late")),
            (Json{{"type", "log"}, {"tick", 7}, {"source", "server"}, {"level", "warning"}, {"text", "late"}}));
  EXPECT_EQ(Json::parse(BranchedText({12, "http://here/", ""})),
            (Json{{"type", "branched"}, {"tick", 12}, {"url", "http://here/"}, {"error", ""}}));
  RobotPlaybackAnswer answer;
  answer.tick = 40;
  answer.robots.resize(1);
  answer.robots[0].entity = 3;
  answer.robots[0].tick = 39;
  answer.robots[0].controller = "driver";
  answer.robots[0].state = "TURN";
  answer.robots[0].text = "turns";
  answer.robots[0].sensors = {{"battery", {{"left", "s", 1.5}}}};
  EXPECT_EQ(Json::parse(RobotPlaybackText(answer)), Json::parse(R"({"type": "past_inside", "tick": 40, "error": "",
    "entities": [{"entity": 3, "tick": 39, "controller": "driver", "state": "TURN", "text": "turns", "attributes": {},
                  "sensors": [{"type": "battery", "names": ["left"], "units": ["s"], "values": [1.5]}],
                  "actuators": []}]})"));
}

TEST(WebMessages, TheStatusHasPaceAndProcesses)
{
  FourEntities world;
  world.space.SetTick(30);
  RunStatus status;
  status.tick = 31;
  status.phase = RunStatus::Phase::kPaused;
  status.speed_wanted = 2;
  status.real_time_factor = 1.5;
  status.ticks_per_second = 15;
  status.ended = "goal";
  status.processes.resize(1);
  status.processes[0].name = "controller host 1";
  status.processes[0].process = "lab:7";
  status.processes[0].tick = 29;
  status.processes[0].late_s = 2.5;
  status.processes[0].doing = "runs";
  EXPECT_EQ(nlohmann::json::parse(StatusText(world.space, status, 4)),
            nlohmann::json::parse(R"({"type": "status", "tick": 30, "time_s": 3.0, "phase": "paused",
    "speed_wanted": 2.0, "real_time_factor": 1.5, "ticks_per_second": 15.0, "ended": "goal", "clients": 4,
    "processes": [{"name": "controller host 1", "process": "lab:7", "tick": 29, "late_s": 2.5, "doing": "runs"}]})"));
}

TEST(WebMessages, TheWorldHasWhatNeverChanges)
{
  Experiment experiment = FourEntities::Make();
  experiment.seed = 5;
  experiment.max_clock = 700;
  test::AddController(experiment, "lua_controller", "idle");
  test::AddController(experiment, "driver_controller", "driver");
  experiment.entities[0].controller = "driver";
  experiment.entities[2].pose = {{3, 2, 0}, QuaternionFromYaw(kPi)};
  experiment.entities[2].colour = 0x112233;
  for (const char* id : {"crowd_0", "crowd_1"})
    experiment.entities[test::Add(experiment, test::Entity(EntityKind::kFootbot, id, {1, 3, 0}))].reserve = "crowd";
  const Assignment assignment = MakeAssignment(experiment, 2);
  const CSwarmanoidSpace space(experiment);
  const auto json = nlohmann::json::parse(WorldText(space, assignment));
  using Json = nlohmann::json;
  EXPECT_EQ(json["type"], "world");
  EXPECT_EQ(json["experiment"], "small");
  EXPECT_EQ(json["seed"], 5);
  EXPECT_EQ(json["last_tick"], 700);
  EXPECT_DOUBLE_EQ(json["tick_seconds"], 0.1);
  EXPECT_EQ(json["arena"], Json({4.0, 4.0, 2.0}));
  EXPECT_EQ(json["engines"], Json::parse(R"([{"id": "ground", "tag": "dummy_engine"}])"));
  EXPECT_EQ(json["hosts"], assignment.hosts.size());
  EXPECT_EQ(json["controllers"], Json::parse(R"([{"id": "idle", "tag": "lua_controller"},
                                                 {"id": "driver", "tag": "driver_controller"}])"));
  EXPECT_EQ(json["entities"]["controller"], Json({1, -1, -1, -1, -1, -1}));
  EXPECT_EQ(json["entities"]["host"], Json(assignment.host));
  EXPECT_EQ(json["begins_at_viewpoint"], false);
  EXPECT_EQ(json["viewpoints"], Json::array());
  EXPECT_EQ(json["reserves"], Json::parse(R"([{"id": "crowd", "first": 4, "count": 2}])"));
  EXPECT_EQ(json["meshes"], Json::array());
  EXPECT_EQ(json["bodies"][0]["position"], Json({3.0, 2.0, 0.0}));
  EXPECT_EQ(json["bodies"][0]["colour"], 0x112233);
  EXPECT_NEAR(json["bodies"][0]["orientation"][2], 1, 1e-9);
  EXPECT_NEAR(json["bodies"][0]["orientation"][3], 0, 1e-9);
  const std::map<std::string, std::string> roles{
      {"footbot", "robot"}, {"block", "object"},       {"light_bulb", "light"}, {"sound_source", "sound"},
      {"hole", "hole"},     {"ground_patch", "patch"}, {"terrain", "terrain"}};
  for (const auto& [kind, role] : roles) EXPECT_EQ(json["looks"][kind]["role"], role) << kind;
  EXPECT_EQ(json["looks"]["cylindric_prey"]["form"], "cylinder");
  EXPECT_EQ(json["looks"]["cylindric_prey"]["based"], true);
  EXPECT_EQ(json["looks"]["block"]["based"], false);
  EXPECT_DOUBLE_EQ(json["looks"]["footbot"]["proximity"]["height"], 0.06);
  EXPECT_DOUBLE_EQ(json["looks"]["footbot"]["proximity"]["range"], 0.1);
  EXPECT_FALSE(json["looks"]["footbot"].contains("model")) << "the page has the meshes of built-in robots";
  EXPECT_EQ(json["attributes"]["ground_patch"],
            Json::parse(R"([{"name": "colour", "count": 1, "description": "colour of the surface"}])"));
}

TEST(WebMessages, TerrainIsAGridOfHeightsWithHoles)
{
  const test::TemporaryFolder folder;
  const std::string path = folder / "stones.bt";
  octomap::OcTree tree(0.1);
  for (const float x : {0.05F, 0.55F}) tree.updateNode(octomap::point3d(x, 0.05F, 0.05F), true);
  tree.writeBinary(path);
  Experiment experiment = FourEntities::Make();
  EntityConfiguration terrain = test::Entity(EntityKind::kTerrain, "stones");
  terrain.tree = test::TerrainTree("octomap", {{"file", path}});
  test::Add(experiment, terrain);
  const CSwarmanoidSpace space(experiment);
  const auto json = nlohmann::json::parse(WorldText(space, MakeAssignment(experiment, 1)));
  const auto& surface = json["bodies"].back()["terrain"];
  ASSERT_TRUE(surface.is_object()) << json["bodies"].back();
  EXPECT_NEAR(surface["low"][0], 0, 1e-6);
  EXPECT_NEAR(surface["high"][0], 0.6, 1e-6);
  EXPECT_NEAR(surface["high"][2], 0.1, 1e-6);
  const auto columns = surface["columns"].get<std::size_t>(), rows = surface["rows"].get<std::size_t>();
  EXPECT_NEAR(static_cast<double>(columns), 128, 1) << "along the longer side";
  EXPECT_NEAR(static_cast<double>(rows), 21, 1) << "cells are squares";
  const auto& heights = surface["heights"];
  ASSERT_EQ(heights.size(), columns * rows);
  for (const std::size_t row : {std::size_t{0}, rows - 1})
  {
    EXPECT_DOUBLE_EQ(heights[row * columns], 0.1);
    EXPECT_DOUBLE_EQ(heights[row * columns + columns - 1], 0.1);
    EXPECT_TRUE(heights[row * columns + columns / 2].is_null()) << "between the stones";
  }
}

TEST(WebMessages, ColoursOfLightsHaveTheirIntensity)
{
  Experiment experiment = FourEntities::Make();
  const std::uint32_t light = test::Add(experiment, test::Entity(EntityKind::kLightBulb, "light", {1, 1, 1}));
  const std::uint32_t wall =
      test::Add(experiment, test::Entity(EntityKind::kWall, "wall", {0, 1, 0.5}, {0.1, 1, 1}, false));
  CSwarmanoidSpace space(experiment);
  space.GetEntity(light).SetAttribute("colour", 0x0a0b0c);
  space.GetEntity(light).SetAttribute("intensity", 2.5);
  const auto json = nlohmann::json::parse(ColoursText(space));
  EXPECT_EQ(json["type"], "colours");
  EXPECT_EQ(json["entities"], nlohmann::json({3, light, wall})) << "the prey moves and is in the frames";
  EXPECT_EQ(json["colours"][1], 0x0a0b0c);
  EXPECT_EQ(json["intensities"], nlohmann::json({1.0, 2.5, 1.0}));
}

TEST(WebMessages, ATimelineOfOneTickBeginsAndEndsThere)
{
  const auto json = nlohmann::json::parse(TimelineText("/runs/a", 5, 5, {}));
  EXPECT_EQ(json["first"], 5);
  EXPECT_EQ(json["last"], 5);
  EXPECT_EQ(json["events"], nlohmann::json::array());
  EXPECT_EQ(nlohmann::json::parse(TimelineText("/runs/a", 5, 6, {}))["last"], 5);
  EXPECT_EQ(nlohmann::json::parse(TimelineText("/runs/a", 5, 7, {}))["last"], 6);
}

// JSON has no word for numbers that are not finite.
TEST(WebMessages, ReadingsMayBeAnyNumber)
{
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const FourEntities world;
  const std::vector<std::uint32_t> watched{0};
  test::FakeMonitor monitor;
  monitor.inside.sensors = {
      {"eyebot_altitude", {{"ground", "m", kInfinity}, {"drift", "rad", std::nan("")}, {"sum", "", 1.5}}}};
  monitor.inside.actuators = {{"footbot_wheels", {{"left", "rad/s", -kInfinity}}}};
  const auto json = nlohmann::json::parse(WatchedText(world.space, watched, &monitor))["entities"][0];
  EXPECT_EQ(json["sensors"][0]["values"], nlohmann::json({nullptr, nullptr, 1.5}));
  EXPECT_EQ(json["actuators"][0]["values"], nlohmann::json::array({nullptr}));
}

}  // namespace
}  // namespace swarmanoid
