// The parts of the reader of experiments that are used one by one: mistakes, ids, actors, joints.
#include "common/experiment/diagnostics.h"

#include <gmock/gmock.h>

#include <memory>

#include "common/experiment/actors.h"
#include "common/experiment/moving_links.h"
#include "common/experiment/unique_ids.h"
#include "common/math/elementary.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> Texts(std::vector<Diagnostic> diagnostics)
{
  std::vector<std::string> texts;
  for (const Diagnostic& diagnostic : diagnostics) texts.push_back(diagnostic.message);
  return texts;
}

TEST(Diagnostics, AreInTheOrderOfTheFileBehindThoseOfOtherFiles)
{
  const auto own = std::make_shared<const std::string>("a.xml"), other = std::make_shared<const std::string>("b.urdf");
  Diagnostics diagnostics;
  EXPECT_TRUE(diagnostics.Empty());
  diagnostics.Add({own, 7, 3}, "line 7, column 3");
  diagnostics.Add({own, 2, 9}, "line 2");
  diagnostics.Add({own, 7, 1}, "line 7, column 1");
  diagnostics.Add({other, 90, 1}, "of another file");
  EXPECT_EQ(diagnostics.Count(), 4U);
  EXPECT_FALSE(diagnostics.Empty());
  EXPECT_THAT(Texts(diagnostics.Take("a.xml")),
              ElementsAre("of another file", "line 2", "line 7, column 1", "line 7, column 3"));
  EXPECT_TRUE(diagnostics.Empty());
}

TEST(Diagnostics, BeyondAThousandAreCounted)
{
  const auto file = std::make_shared<const std::string>("a.xml");
  Diagnostics diagnostics;
  for (int line = 1; line <= 1000; ++line) diagnostics.Add({file, line, 1}, "mistake");
  EXPECT_EQ(diagnostics.Take("a.xml").size(), 1000U);
  for (int line = 1; line <= 1003; ++line) diagnostics.Add({file, line, 1}, "mistake");
  const std::vector<Diagnostic> all = diagnostics.Take("a.xml");
  ASSERT_EQ(all.size(), 1001U);
  EXPECT_EQ(all.back().message, "and 3 more mistakes");
}

TEST(Diagnostics, KnowWhichNamesWereLost)
{
  Diagnostics diagnostics;
  diagnostics.Lose("fb");
  diagnostics.Lose("");
  for (const char* name : {"fb", "fb_0", "fb_12"}) EXPECT_TRUE(diagnostics.IsLost(name)) << name;
  for (const char* name : {"", "f", "fb_", "fb12", "fb_x", "fb_1x", "fb-1", "_0", "12"})
    EXPECT_FALSE(diagnostics.IsLost(name)) << name;
  EXPECT_TRUE(diagnostics.HasLost([](const std::string& name) { return name == "fb"; }));
  EXPECT_FALSE(diagnostics.HasLost([](const std::string& name) { return name.empty(); }));
}

TEST(UniqueIds, NameTheLineOfTheFirst)
{
  UniqueIds ids("entities");
  EXPECT_EQ(ids.Add("a", 3), "");
  EXPECT_EQ(ids.Add("b", 4), "");
  EXPECT_EQ(ids.Add("", 5), "");
  EXPECT_EQ(ids.Add("", 6), "");
  EXPECT_EQ(ids.Add("a", 7), "two entities have the id 'a'; the first is in line 3");
}

TEST(Actors, AreFoundByTheirKindAndNumber)
{
  Experiment experiment;
  test::AddController(experiment, "lua_controller", "first", {"footbot_wheels"},
                      {"footbot_proximity", "footbot_light"});
  test::AddController(experiment, "my_controller", "second", {"footbot_leds"}, {"footbot_camera"});
  EntityConfiguration robot = test::Entity(EntityKind::kFootbot, "fb");
  robot.controller = "second";
  test::Add(experiment, test::Entity(EntityKind::kBlock, "block"));
  test::Add(experiment, robot);
  experiment.engines.resize(2);
  experiment.engines[1].id = "air";
  experiment.engines[1].tag = "dynamics3d";
  experiment.functions.resize(1);
  experiment.functions[0].id = "goal";
  experiment.functions[0].tag = "my_functions";
  experiment.visualisations.resize(2);
  experiment.visualisations[1].id = "film";
  experiment.visualisations[1].tag = "image_render";
  const std::tuple<Actor, const char*, const char*> rows[] = {
      {RobotActor(experiment, 1), "fb", "second"},
      {EngineActor(experiment, 1), "air", "dynamics3d"},
      {FunctionsActor(experiment, 0), "goal", "my_functions"},
      {VisualisationActor(experiment.visualisations[1], 1), "film", "image_render"},
      {SensorActor(experiment, 0, 1), experiment.controllers[0].sensors[1].type.c_str(), "first"},
      {SensorActor(experiment, 1, 0), experiment.controllers[1].sensors[0].type.c_str(), "second"},
      {ActuatorActor(experiment, 1, 0), experiment.controllers[1].actuators[0].type.c_str(), "second"}};
  for (const auto& [actor, id, type] : rows)
  {
    EXPECT_STREQ(actor.id, id);
    EXPECT_STREQ(actor.type, type);
    const Actor found = ActorOf(experiment, actor.kind, actor.number);
    EXPECT_EQ(found.kind, actor.kind) << id;
    EXPECT_EQ(found.number, actor.number) << id;
    EXPECT_STREQ(found.id, id);
    EXPECT_STREQ(found.type, type);
  }
  EXPECT_EQ(ActorOf(experiment, Actor::kWatcher, 0).kind, Actor::kWatcher);
  EXPECT_EQ(ActorOf(experiment, Actor::kNobody, 0).kind, Actor::kNobody);
  const std::pair<Actor::Kind, std::uint32_t> missing[] = {
      {Actor::kRobot, 2},          {Actor::kEngine, 2},   {Actor::kFunctions, 1},
      {Actor::kVisualisation, 2},  {Actor::kSensor, 2},   {Actor::kSensor, (1U << 12U) + 1},
      {Actor::kSensor, 2U << 12U}, {Actor::kActuator, 1}, {Actor::kActuator, 2U << 12U}};
  for (const auto& [kind, number] : missing)
    EXPECT_EQ(ActorOf(experiment, kind, number).kind, Actor::kNobody) << kind << " " << number;
}

MovingLink Joint(int parent, const Vector3& anchor, const Vector3& axis, bool slides = false)
{
  MovingLink link;
  link.parent = parent;
  link.anchor = anchor;
  link.axis = axis;
  link.slides = slides;
  return link;
}

TEST(MovingLinks, TurnAboutTheirAxesAndCarryOthers)
{
  const MovingLink links[] = {Joint(MovingLink::kBase, {1, 0, 0}, Vector3::UnitZ()),
                              Joint(0, {2, 0, 0}, Vector3::UnitX(), true), Joint(1, {2, 0, 1}, Vector3::UnitY()),
                              Joint(MovingLink::kBase, {0, 0, 0}, Vector3::UnitZ(), true)};
  const double positions[] = {kPi / 2, 0.5, kPi / 2, -0.25};
  const std::vector<Pose> motions = MotionsOfLinks(links, positions);
  ASSERT_EQ(motions.size(), 4U);
  const auto at = [&](std::size_t link, const Vector3& point) { return Vector3(motions[link].Apply(point)); };
  const auto expect = [](const Vector3& a, const Vector3& b) { EXPECT_LT((a - b).norm(), 1e-12) << a.transpose(); };
  expect(at(0, {1, 0, 0}), {1, 0, 0});  // the anchor stays
  expect(at(0, {2, 0, 0}), {1, 1, 0});  // a quarter to the left
  expect(at(1, {2, 0, 0}), {1, 1.5, 0});
  expect(at(2, {2, 0, 1}), {1, 1.5, 1});  // its own anchor
  expect(at(2, {2, 0, 2}), {1, 2.5, 1});  // what was above is ahead of the turned arm
  expect(at(3, {1, 2, 3}), {1, 2, 2.75});
  const double zero[] = {0, 0, 0, 0};
  for (const Pose& motion : MotionsOfLinks(links, zero)) expect(motion.Apply({1, 2, 3}), {1, 2, 3});
}

TEST(JointCommands, AreReadFromTwoNumbers)
{
  using Mode = JointCommand::Mode;
  const auto mode = [](double number) { return JointCommand::From(std::array{number, 0.75}).mode; };
  EXPECT_EQ(mode(0), Mode::kNone);
  EXPECT_EQ(mode(1), Mode::kPosition);
  EXPECT_EQ(mode(2), Mode::kVelocity);
  EXPECT_EQ(JointCommand::From(std::array{1.0, 0.75}).value, 0.75);
  EXPECT_EQ(JointCommand::From(std::array{2.0, 0.75}).value, 0.75);
}

TEST(JointReferences, ApproachTheCommandAtTheLargestSpeedWithinTheRange)
{
  using Mode = JointCommand::Mode;
  MovingLink link;
  link.lowest = -1;
  link.highest = 2;
  link.max_speed = 0.5;
  const auto next = [&](Mode mode, double value, double reference) {
    return NextReference(link, {mode, value}, reference, 1);
  };
  EXPECT_DOUBLE_EQ(next(Mode::kNone, 1, 0.25), 0.25);
  EXPECT_DOUBLE_EQ(next(Mode::kPosition, 2, 0), 0.5);
  EXPECT_DOUBLE_EQ(next(Mode::kPosition, -2, 0), -0.5);
  EXPECT_DOUBLE_EQ(next(Mode::kPosition, 0.2, 0), 0.2);
  EXPECT_DOUBLE_EQ(next(Mode::kPosition, 5, 1.75), 2);
  EXPECT_DOUBLE_EQ(next(Mode::kVelocity, 0.25, 1), 1.25);
  EXPECT_DOUBLE_EQ(next(Mode::kVelocity, 3, 1), 1.5);
  EXPECT_DOUBLE_EQ(next(Mode::kVelocity, -3, 1), 0.5);
  EXPECT_DOUBLE_EQ(next(Mode::kVelocity, 0.5, 1.75), 2);
  EXPECT_DOUBLE_EQ(next(Mode::kVelocity, -0.5, -0.75), -1);
  EXPECT_FALSE(link.IsEndless());
  EXPECT_DOUBLE_EQ(link.Start(), 0);
  link.lowest = 0.5;
  EXPECT_DOUBLE_EQ(link.Start(), 0.5);
  MovingLink endless;
  endless.max_speed = 0.5;
  EXPECT_TRUE(endless.IsEndless());
  // It goes the short way, past half a turn.
  EXPECT_DOUBLE_EQ(NextReference(endless, {Mode::kPosition, -3}, 3, 1), 3 + (2 * kPi - 6));
  EXPECT_DOUBLE_EQ(NextReference(endless, {Mode::kPosition, -2.5}, 3, 1), 3.5);
}

}  // namespace
}  // namespace swarmanoid
