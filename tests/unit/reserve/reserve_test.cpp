// Entities that come and go: what robots, sensors and engines notice of it.
#include <gmock/gmock.h>

#include <functional>

#include "ci_controller.h"
#include "footbot/ci_footbot_ground_sensor.h"
#include "footbot/ci_footbot_light_sensor.h"
#include "footbot/ci_footbot_proximity_sensor.h"
#include "footbot/ci_footbot_wheels_actuator.h"
#include "simulation/register_all.h"
#include "simulation/simulator.h"
#include "space_server/experiment_functions.h"
#include "tests/world/experiment_text.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Pose At(double x, double y, double z = 0) { return {{x, y, z}, Quaternion::Identity()}; }

// Calls the function of the test at each tick.
class Script : public CExperimentFunctions
{
public:
  static inline std::function<void(SpaceEditor&)> at_tick;
  void Init(const TConfigurationTree, SpaceEditor&) override {}
  void PreStep(SpaceEditor& space) override { at_tick(space); }
};

REGISTER_EXPERIMENT_FUNCTIONS(Script, {.label = "reserve_script", .brief = "for tests"})

// Drives straight on and writes down what it feels.
class Feeler : public CCI_Controller
{
public:
  struct Felt
  {
    std::uint64_t steps = 0;
    double ahead = 0;  // the strongest of the proximity readings
    double light = 0;
    std::uint32_t floor = 0;
  };
  static inline std::map<std::string, Felt> felt;

  int Init(const TConfigurationTree) override
  {
    wheels_ = &GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
    proximity_ = &GetRobot()->Sensor<CCI_FootBotProximitySensor>("footbot_proximity");
    light_ = &GetRobot()->Sensor<CCI_FootBotLightSensor>("footbot_light");
    ground_ = &GetRobot()->Sensor<CCI_FootBotGroundSensor>("footbot_ground");
    return RETURN_OK;
  }
  void ControlStep() override
  {
    Felt& mine = felt[GetRobot()->GetId()];
    ++mine.steps;
    mine.ahead = std::ranges::max(proximity_->GetAllSensorReadings());
    mine.light = std::ranges::max(light_->GetAllSensorReadings());
    mine.floor = ground_->GetFloorColour();
    wheels_->SetFootBotWheelsLinearVelocity(0.1, 0.1);
  }

private:
  CCI_FootBotWheelsActuator* wheels_ = nullptr;
  CCI_FootBotProximitySensor* proximity_ = nullptr;
  CCI_FootBotLightSensor* light_ = nullptr;
  CCI_FootBotGroundSensor* ground_ = nullptr;
};
REGISTER_CONTROLLER(Feeler, "reserve_feeler")

class Reserve : public ::testing::TestWithParam<const char*>
{
protected:
  Reserve() { Feeler::felt.clear(); }

  static test::ExperimentText Text(const std::string& engine, const std::string& more = "")
  {
    RegisterBuiltins();
    return {.framework = "<maxclock>200</maxclock>",
            .controllers = test::Controller(
                {.tag = "reserve_feeler",
                 .id = "feeler",
                 .actuators = {"dummy_footbot_wheels"},
                 .sensors = {"generic_footbot_proximity", "generic_footbot_light", "generic_footbot_ground"}}),
            .size = "10,10,2",
            .arena = R"(
    <footbot id="fb" position="1,5,0" controller="feeler"/>
    <reserve quantity="2"><footbot id="late" controller="feeler"/></reserve>
    <reserve quantity="2"><cylindric_prey id="prey" radius="0.1" height="0.1"/></reserve>
    <reserve quantity="1"><block id="box" movable="true" size="0.2,0.2,0.2"/></reserve>
    <reserve quantity="1"><light_bulb id="lamp" intensity="0.5"/></reserve>
    <reserve quantity="1"><ground_patch id="mat" size="0.5,0.5" colour="red"/></reserve>
    <wall id="wall" position="9,5,0.5" size="0.1,5,1"/>)" +
                     more,
            .engines = "<" + engine + " id='e'/>",
            .functions = "<reserve_script id='script'/>"};
  }
  static std::unique_ptr<Experiment> Load(const std::string& engine) { return Text(engine).Load(); }

  static void Run(CSimulator& simulator, int ticks)
  {
    for (int tick = 0; tick < ticks; ++tick) simulator.Step();
  }
};

INSTANTIATE_TEST_SUITE_P(AllEngines, Reserve, ::testing::Values("dummy_engine", "dynamics2d", "dynamics3d"));

TEST_P(Reserve, RobotsJoinDriveAndLeave)
{
  Script::at_tick = [](SpaceEditor& space)
  {
    const std::uint64_t tick = space.GetSpace().GetTick();
    if (tick == 40) space.RemoveEntity("late_0");
    if (tick != 20 && tick != 60) return;
    EXPECT_EQ(space.AddEntity("late", At(tick == 20 ? 2 : 4, 3)), "late_0");
  };
  const auto experiment = Load(GetParam());
  CSimulator simulator(*experiment);
  const CSwarmanoidSpace& space = simulator.GetSpace();
  const CSwarmanoidSpaceEntity& late = *space.FindEntity("late_0");
  Run(simulator, 20);
  EXPECT_FALSE(space.IsPresent(late.GetIndex()) && space.GetTick() < 20);
  EXPECT_EQ(Feeler::felt.count("late_0"), 0U);
  Run(simulator, 19);
  // It drives at 0.1 m/s for 1.9 s; wheels of dynamic engines start more slowly.
  EXPECT_NEAR(late.GetPosition().x(), 2.19, 0.03);
  EXPECT_EQ(Feeler::felt["late_0"].steps, 19U);
  Run(simulator, 20);
  EXPECT_FALSE(space.IsPresent(late.GetIndex()));
  EXPECT_EQ(Feeler::felt["late_0"].steps, 20U);
  Run(simulator, 21);
  EXPECT_NEAR(late.GetPosition().x(), 4.2, 0.03);
  EXPECT_EQ(Feeler::felt["late_0"].steps, 40U);
  // The robot that was there all the time noticed nothing of it.
  EXPECT_NEAR(space.FindEntity("fb")->GetPosition().x(), 1 + 0.01 * static_cast<double>(space.GetTick()), 0.03);
  EXPECT_FALSE(space.IsPresent(space.FindEntity("late_1")->GetIndex()));
}

TEST_P(Reserve, SensorsSeeWhatIsInTheArenaAndNothingElse)
{
  Script::at_tick = [](SpaceEditor& space)
  {
    if (space.GetSpace().GetTick() == 1)
    {
      space.AddEntity("box", At(1.25, 5, 0.1));
      space.AddEntity("lamp", At(1, 6, 0.05));
      space.AddEntity("mat", At(1, 5));
    }
    if (space.GetSpace().GetTick() == 3)
      for (const char* id : {"box_0", "lamp_0", "mat_0"}) space.RemoveEntity(id);
  };
  const auto experiment = Load(GetParam());
  CSimulator simulator(*experiment);
  const Feeler::Felt& felt = Feeler::felt["fb"];
  const auto expect = [&](bool there)
  {
    EXPECT_EQ(felt.ahead > 0, there);
    EXPECT_EQ(felt.light > 0, there);
    EXPECT_EQ(felt.floor, there ? 0xff0000U : 0xffffffU);
  };
  Run(simulator, 1);
  expect(false);
  Run(simulator, 1);
  expect(true);
  Run(simulator, 2);
  expect(false);
}

TEST_P(Reserve, BodiesThatAreAddedPushBackAndThoseThatWaitDoNot)
{
  Script::at_tick = [](SpaceEditor& space)
  {
    if (space.GetSpace().GetTick() == 0) space.AddEntity("prey_1", At(1.5, 5));
  };
  const auto experiment = Load(GetParam());
  CSimulator simulator(*experiment);
  Run(simulator, 100);
  const CSwarmanoidSpace& space = simulator.GetSpace();
  EXPECT_GT(space.FindEntity("prey_1")->GetPosition().x(), 1.55) << "the robot drove through the prey";
  EXPECT_LT(space.FindEntity("fb")->GetPosition().x(), space.FindEntity("prey_1")->GetPosition().x() - 0.15);
  // Waiting entities stay exactly where they were put at the start.
  for (const char* id : {"prey_0", "late_0", "late_1", "box_0"})
  {
    const CSwarmanoidSpaceEntity& entity = *space.FindEntity(id);
    EXPECT_EQ(entity.GetPosition(), entity.GetConfiguration().pose.position) << id;
  }
}

TEST_F(Reserve, MistakesAreNamed)
{
  std::vector<std::string> mistakes;
  Script::at_tick = [&](SpaceEditor& space)
  {
    if (space.GetSpace().GetTick() > 0) return;
    const auto keep = [&](const std::function<void()>& call)
    { mistakes.push_back(test::MessageOf<std::invalid_argument>(call, "none")); };
    keep([&] { space.AddEntity("pray", At(1, 1)); });
    keep([&] { space.AddEntity("fb", At(1, 1)); });
    keep([&] { space.RemoveEntity("late_0"); });
    keep([&] { space.MoveEntity("late_0", At(1, 1)); });
    keep([&] { space.RemoveEntity("wall"); });
    space.AddEntity("late", At(3, 3));
    space.AddEntity("late", At(4, 4));
    keep([&] { space.AddEntity("late", At(5, 5)); });
    keep([&] { space.AddEntity("prey", At(-1e9, 5)); });
    // The footbot has a radius of 0.085 m, and the prey one of 0.1 m.
    EXPECT_TRUE(space.IsFree("prey", At(3.186, 3)));
    EXPECT_FALSE(space.IsFree("prey", At(3.175, 3)));
    keep([&] { space.AddEntity("prey", At(3.175, 3)); });
    keep([&] { space.AddEntity("box", At(9, 6, 0.1)); });
    // An entity without a body fits anywhere.
    EXPECT_TRUE(space.IsFree("lamp", At(3, 3)));
  };
  const auto experiment = Load("dummy_engine");
  CSimulator simulator(*experiment);
  EXPECT_THAT(
      mistakes,
      ElementsAre(
          "there is no reserve and no entity 'pray'; reserves are: box, lamp, late, mat, prey",
          "entity 'fb' is in the arena already", "entity 'late_0' is not in the arena",
          "entity 'late_0' is not in the arena",
          "the wall 'wall' never moves, so it cannot be added or removed; only robots, preys, movable blocks and "
          "what is in a <reserve> can",
          "all 2 entities of the reserve 'late' are in the arena; give its <reserve> (line 6) a larger quantity",
          "the cylindric_prey 'prey_0' would be at -1e+09, 5, 0, more than 100 m outside the arena, which reaches from "
          "0, "
          "0, 0 to 10, 10, 2",
          "'prey_0' does not fit at 3.175, 3, 0: the footbot 'late_0' stands there, at 3, 3, 0; choose a free place",
          "'box_0' does not fit at 9, 6, 0.1: the wall 'wall' stands there, at 9, 5, 0.5; choose a free place"));
}

TEST_P(Reserve, NobodyIsMovedIntoOthersUnlessTheFunctionsAllowItAndThenTheyPart)
{
  std::string refused, refused_together;
  Script::at_tick = [&](SpaceEditor& space)
  {
    if (space.GetSpace().GetTick() != 1) return;
    space.AddEntity("late", At(5, 7));
    refused = test::MessageOf<std::invalid_argument>([&] { space.MoveEntity("late_0", At(8.97, 5)); }, "none");
    refused_together =
        test::MessageOf<std::invalid_argument>([&] { space.MoveCompound("late_0", At(8.97, 5)); }, "none");
    EXPECT_EQ(space.GetSpace().FindEntity("late_0")->GetPosition(), Vector3(5, 7, 0));
    const Vector3 at = space.GetSpace().FindEntity("fb")->GetPosition();
    space.MoveEntity("late_0", At(at.x() + 0.02, at.y()), EOccupied::kOverlap);
  };
  const auto experiment = Load(GetParam());
  CSimulator simulator(*experiment);
  Run(simulator, 60);
  EXPECT_EQ(refused,
            "'late_0' does not fit at 8.97, 5, 0: the wall 'wall' stands there, at 9, 5, 0.5; choose a free place");
  EXPECT_EQ(refused_together, refused);
  const CSwarmanoidSpace& space = simulator.GetSpace();
  const Vector3 apart = space.FindEntity("late_0")->GetPosition() - space.FindEntity("fb")->GetPosition();
  // With heights one may end on top of the other.
  EXPECT_GT(apart.norm(), std::string(GetParam()) == "dynamics3d" ? 0.13 : 0.169);
}

TEST_F(Reserve, QueriesFindOnlyWhatIsInTheArena)
{
  std::vector<std::size_t> found;
  Script::at_tick = [&](SpaceEditor& space)
  {
    const Vector3 everywhere = Vector3::Constant(1e9);
    found.push_back(space.GetQuery().FindInBox(-everywhere, everywhere).size());
    if (space.GetSpace().GetTick() == 0) space.AddEntity("prey", At(5, 5));
  };
  const auto experiment = Load("dummy_engine");
  CSimulator simulator(*experiment);
  Run(simulator, 1);
  EXPECT_THAT(found, ElementsAre(2, 3));
}

TEST_F(Reserve, FixedBlocksAndWallsCannotWait)
{
  const auto mistake = [](const std::string& element) -> std::string
  {
    const std::string text = Text("dummy_engine", "<reserve quantity='1'>" + element + "</reserve>").Text();
    const LoadedExperiment loaded = LoadExperimentText(text, "test.xml", ".");
    return loaded.errors.empty() ? "none" : loaded.errors[0].Text();
  };
  EXPECT_THAT(mistake("<block id=\"stone\"><size>1, 1, 1</size></block>"),
              HasSubstr("the block 'stone' cannot come and go while it cannot move; give it movable=\"true\""));
  EXPECT_THAT(mistake("<wall id=\"w\"><size>1, 1, 1</size></wall>"), HasSubstr("<reserve> has no element <wall>"));
}

}  // namespace
}  // namespace swarmanoid
