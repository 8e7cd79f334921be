#include "visualiser/web/page_messages.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/messages/control_verbs.h"
#include "tests/web/four_entities.h"
#include "tests/world/fake_run.h"
#include "tests/world/message_of.h"

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
