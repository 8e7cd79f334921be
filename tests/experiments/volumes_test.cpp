// Robots and preys that change their engine at the border of its volume.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <map>

#include "common/checkpoint/checkpoint.h"
#include "common/control_interface/ci_controller.h"
#include "common/control_interface/footbot/ci_footbot_encoders_sensor.h"
#include "common/control_interface/footbot/ci_footbot_gripper_actuator.h"
#include "common/control_interface/footbot/ci_footbot_turret_actuator.h"
#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"
#include "common/space/attributes.h"
#include "common/space/space.h"
#include "simulation/register_all.h"
#include "space_server/experiment_functions.h"
#include "tests/experiments/running_experiment.h"
#include "tests/world/experiment_text.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

using testing::HasSubstr;

constexpr double kRadius = 0.085036758;
constexpr double kFront = 0.1;  // of the gripper
constexpr double kWheelRadius = 0.029112741;
constexpr double kTick = 0.1;  // s

// Drives at a speed until a tick; the gripper is closed until another one; the turret turns at a rate.
class Traveller : public CCI_Controller
{
public:
  static inline std::map<std::string, double> travelled;  // m, by the encoders of the left wheel

  int Init(const TConfigurationTree tree) override
  {
    speed_ = tree.GetNumber("speed");
    until_ = tree.GetNumber("until");
    gripped_until_ = tree.GetNumber("gripped_until");
    turret_ = tree.GetNumber("turret");
    travelled[GetRobot()->GetId()] = 0;
    return RETURN_OK;
  }
  void ControlStep() override
  {
    const double speed = GetTick() < until_ ? speed_ : 0;
    GetRobot()
        ->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels")
        .SetFootBotWheelsAngularVelocity(speed / kWheelRadius, speed / kWheelRadius);
    GetRobot()->Actuator<CCI_FootBotGripperActuator>("footbot_gripper").SetGripper(GetTick() < gripped_until_ ? 1 : 0);
    GetRobot()->Actuator<CCI_FootBotTurretActuator>("footbot_turret").SetTurretAngularVelocity(turret_);
    travelled[GetRobot()->GetId()] +=
        GetRobot()->Sensor<CCI_FootBotEncodersSensor>("footbot_encoders").GetLeftDistance(kTick);
  }

private:
  double GetTick() const { return static_cast<double>(GetRobot()->GetTick()); }
  double speed_ = 0, until_ = 0, gripped_until_ = 0, turret_ = 0;
};
REGISTER_CONTROLLER(Traveller, {.label = "test_traveller",
                                .parameters = {{.name = "speed", .default_value = "0"},
                                               {.name = "until", .default_value = "1e9"},
                                               {.name = "gripped_until", .default_value = "0"},
                                               {.name = "turret", .default_value = "0"}}})

std::string TravellerText(const std::string& id, const std::string& parameters)
{
  return test::Controller({.tag = "test_traveller",
                           .id = id,
                           .actuators = {"dummy_footbot_wheels", "dummy_footbot_gripper", "dummy_footbot_turret"},
                           .sensors = {"engine_footbot_encoders"},
                           .parameters = parameters});
}

std::string Footbot(const std::string& id, double x, double y, double degrees, const std::string& controller = "")
{
  return fmt::format("<footbot id='{}' position='{}, {}, 0' orientation='0, 0, {}' {}/>", id, x, y, degrees,
                     controller.empty() ? "" : "controller='" + controller + "'");
}

// Two engines, "west" for x below 2 m and "east" for the rest, of an arena of 4 m by 4 m.
struct TwoEngines
{
  std::string west = "dummy_engine";
  std::string east = "dynamics3d";
  std::string controllers{};
  std::string arena{};
  std::string outside = "stop";
  std::string further{};  // parameters of both engines

  std::unique_ptr<Experiment> Load() const
  {
    RegisterBuiltins();
    test::ExperimentText text{.controllers = controllers,
                              .size = "4,4,2",
                              .arena = arena,
                              .engines = fmt::format("<{0} id='west' {2}/><{1} id='east' {2}/>", west, east, further),
                              .physics =
                                  "<engine id='west' volume='0, 0, 2, 4'><all/></engine>"
                                  "<engine id='east' volume='2, 0, 4, 4'><all/></engine>"};
    std::string all = text.Text();
    all.replace(all.find("<arena_physics>"), 15, "<arena_physics outside='" + outside + "'>");
    LoadedExperiment loaded = LoadExperimentText(all, "test.xml", ".");
    for (const Diagnostic& mistake : loaded.errors) ADD_FAILURE() << mistake.message;
    return std::move(loaded.experiment);
  }
};

std::uint32_t EngineOf(const CSwarmanoidSpace& space, const std::string& id)
{
  const auto& choices = space.GetExperiment().engine_choices.entities;
  const std::uint32_t entity = space.FindEntity(id)->GetIndex();
  const auto k = std::lower_bound(choices.begin(), choices.end(), entity) - choices.begin();
  return static_cast<std::uint32_t>(space.Attributes()[space.EngineSlot(static_cast<std::size_t>(k))]);
}

class Volumes : public testing::Test
{
protected:
  void Start(const TwoEngines& scene)
  {
    experiment_ = scene.Load();
    ASSERT_NE(experiment_, nullptr);
    SimulatorOptions options;
    options.visualisations = false;
    simulator_ = std::make_unique<CSimulator>(*experiment_, options);
  }
  void Run(int ticks)
  {
    for (int k = 0; k < ticks; ++k) ASSERT_TRUE(simulator_->Step());
  }
  const CSwarmanoidSpace& Space() const { return simulator_->GetSpace(); }
  Vector3 At(const std::string& id) const { return Space().FindEntity(id)->GetPosition(); }
  double Yaw(const std::string& id) const { return YawOf(Space().FindEntity(id)->GetOrientation()); }
  std::uint32_t Engine(const std::string& id) const { return EngineOf(Space(), id); }

  std::unique_ptr<Experiment> experiment_;
  std::unique_ptr<CSimulator> simulator_;
};

using Pair = std::pair<const char*, const char*>;
class BetweenEngines : public Volumes, public testing::WithParamInterface<Pair>
{
protected:
  TwoEngines Scene() const { return {.west = GetParam().first, .east = GetParam().second}; }
};

TEST_P(BetweenEngines, ARobotDrivesAcrossTheBorderWithoutAJump)
{
  TwoEngines scene = Scene();
  scene.controllers = TravellerText("c", "<speed>0.2</speed><turret>0.3</turret>");
  scene.arena = Footbot("fb", 1.3, 1.2, 30, "c");
  Start(scene);
  Run(15);  // it has its speed
  ASSERT_EQ(Engine("fb"), 0U);
  double longest = 0, shortest = 1, turned = 0, turret = 0;
  int changed = 0;
  for (int tick = 0; tick < 60; ++tick)
  {
    const Vector3 before = At("fb");
    const double heading = Yaw("fb");
    const double turret_before = Space().FindEntity("fb")->GetAttribute("turret_angle");
    const std::uint32_t engine = Engine("fb");
    Run(1);
    changed += engine != Engine("fb") ? 1 : 0;
    EXPECT_EQ(Engine("fb"), At("fb").x() < 2 ? 0U : 1U);
    const double way = (At("fb") - before).norm();
    longest = std::max(longest, way);
    shortest = std::min(shortest, way);
    turned = std::max(turned, std::abs(WrapAngle(Yaw("fb") - heading)));
    turret = std::max(turret, std::abs(WrapAngle(Space().FindEntity("fb")->GetAttribute("turret_angle") -
                                                 turret_before - 0.3 * kTick)));
  }
  EXPECT_EQ(changed, 1);
  EXPECT_NEAR(longest, 0.2 * kTick, 0.02 * 0.2 * kTick);
  EXPECT_NEAR(shortest, 0.2 * kTick, 0.02 * 0.2 * kTick);
  EXPECT_LT(turned, 2e-3);
  EXPECT_LT(turret, 1e-3);
  // The encoders of both engines add up to the way; the last tick is not read yet.
  EXPECT_NEAR(Traveller::travelled["fb"], (At("fb") - Vector3(1.3, 1.2, 0)).norm() - 0.2 * kTick, 0.01);
}

TEST_P(BetweenEngines, ARobotDoesNotPassThroughOneBeyondTheBorder)
{
  TwoEngines scene = Scene();
  scene.controllers = TravellerText("c", "<speed>0.15</speed>") + TravellerText("still", "");
  scene.arena = Footbot("driver", 1.5, 1, 0, "c") + Footbot("other", 2.1, 1, 0, "still");
  Start(scene);
  for (int tick = 0; tick < 60; ++tick)
  {
    Run(1);
    EXPECT_GT(At("other").x() - At("driver").x(), 2 * kRadius - 0.006);
  }
}

// The front of a footbot is 1.5 cm farther ahead in engines of planes than in dynamics3d, so there it may be pushed
// back.
TEST_P(BetweenEngines, RobotsThatMeetAtTheBorderDoNotPassThroughEachOther)
{
  TwoEngines scene = Scene();
  scene.controllers = TravellerText("c", "<speed>0.15</speed>");
  scene.arena = Footbot("a", 1.4, 1, 0, "c") + Footbot("b", 2.6, 1, 180, "c");
  Start(scene);
  for (int tick = 0; tick < 60; ++tick)
  {
    Run(1);
    EXPECT_GT((At("b") - At("a")).norm(), 2 * kRadius - 0.006);
  }
}

TEST_P(BetweenEngines, APreyIsPushedAcrossTheBorder)
{
  TwoEngines scene = Scene();
  scene.controllers = TravellerText("c", "<speed>0.15</speed>");
  scene.arena = Footbot("fb", 1.5, 1, 0, "c") +
                "<cylindric_prey id='prey' position='1.9, 1, 0' radius='0.05' height='0.1' mass='0.2'/>";
  Start(scene);
  Run(80);
  EXPECT_EQ(Engine("prey"), 1U);
  EXPECT_GT((At("prey") - At("fb")).norm(), kRadius + 0.05 - 0.005);
  // A kinematic footbot does not reach a prey of dynamics3d with the part of its front that it lacks there.
  if (std::string(GetParam().first) == "dummy_engine" && std::string(GetParam().second) == "dynamics3d") return;
  EXPECT_GT(At("prey").x(), 2.2);
}

TEST_P(BetweenEngines, AnEntityIsASolidBodyForRobotsOfAllEngines)
{
  TwoEngines scene = Scene();
  scene.controllers = TravellerText("c", "<speed>0.15</speed>");
  scene.arena = Footbot("a", 1.4, 1, 0, "c") + Footbot("b", 2.6, 3, 180, "c") +
                "<wall id='north' position='2.2, 1, 0.2' size='0.1, 0.6, 0.4'/>"
                "<wall id='south' position='1.8, 3, 0.2' size='0.1, 0.6, 0.4'/>";
  Start(scene);
  Run(120);
  EXPECT_NEAR(At("a").x(), 2.15 - kFront, 0.02);
  EXPECT_EQ(Engine("a"), 1U);
  EXPECT_NEAR(At("b").x(), 1.85 + kFront, 0.02);
  EXPECT_EQ(Engine("b"), 0U);
}

TEST_P(BetweenEngines, ACompoundStaysWithItsEngineUntilItIsReleased)
{
  TwoEngines scene = Scene();
  scene.controllers = TravellerText("c", "<speed>0.1</speed><gripped_until>100</gripped_until>");
  scene.arena = Footbot("fb", 1.6, 1, 0, "c") +
                "<cylindric_prey id='prey' position='1.755, 1, 0' radius='0.05' height='0.1' mass='0.2'/>";
  Start(scene);
  Run(99);
  ASSERT_GT(At("fb").x(), 2.1);
  ASSERT_NE(Space().FindEntity("fb")->GetAttribute("gripped"), 0);
  EXPECT_EQ(Engine("fb"), 0U);
  EXPECT_EQ(Engine("prey"), 0U);
  Run(3);
  EXPECT_EQ(Space().FindEntity("fb")->GetAttribute("gripped"), 0);
  EXPECT_EQ(Engine("fb"), 1U);
  EXPECT_EQ(Engine("prey"), 1U);
}

INSTANTIATE_TEST_SUITE_P(All, BetweenEngines,
                         testing::Values(Pair("dummy_engine", "dynamics2d"), Pair("dummy_engine", "dynamics3d"),
                                         Pair("dynamics2d", "dummy_engine"), Pair("dynamics2d", "dynamics3d"),
                                         Pair("dynamics3d", "dummy_engine"), Pair("dynamics3d", "dynamics2d"),
                                         Pair("dummy_engine", "dummy_engine"), Pair("dynamics2d", "dynamics2d"),
                                         Pair("dynamics3d", "dynamics3d")),
                         [](const auto& parameters)
                         { return std::string(parameters.param.first) + "_" + parameters.param.second; });

// Two engines of one kind, or one: the border of the two is where a robot meets another body.
class SameEngines : public Volumes, public testing::WithParamInterface<const char*>
{
protected:
  // Returns the places of both after 6 s, in a scene whose border is at `border`.
  std::vector<Vector3> Meeting(const std::string& other, double border)
  {
    // Without a border the scene is in the west.
    const double shift = 2 - border;
    TwoEngines scene{.west = GetParam(), .east = GetParam(), .outside = "keep"};
    scene.controllers = TravellerText("c", "<speed>0.15</speed>") + TravellerText("still", "");
    scene.arena = Footbot("fb", 1.5 + shift, 1, 0, "c") + fmt::format(fmt::runtime(other), 2.1 + shift);
    Start(scene);
    Run(60);
    return {At("fb") - Vector3(shift, 0, 0), At("other") - Vector3(shift, 0, 0)};
  }
};

TEST_P(SameEngines, BodiesMeetAtABorderAsWithinOneEngine)
{
  // In dynamics3d ODE moves a robot that meets the ghost of another one. It lets a braked robot that is pushed creep 22
  // mm more in these 6 s than the solver in the plane, which moves both in one engine.
  const double tolerance = std::string(GetParam()) == "dynamics3d" ? 0.03 : 0.002;
  for (const char* const other :
       {"<footbot id='other' position='{}, 1, 0' controller='still'/>",
        "<footbot id='other' position='{}, 1, 0' orientation='0, 0, 180' controller='c'/>",
        "<cylindric_prey id='other' position='{}, 1, 0' radius='0.05' height='0.1' mass='0.2'/>"})
  {
    const std::vector<Vector3> two = Meeting(other, 2);
    const std::vector<Vector3> one = Meeting(other, 3);
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_LT((two[k] - one[k]).norm(), tolerance)
          << other << ": " << two[k].transpose() << ", " << one[k].transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(All, SameEngines, testing::Values("dummy_engine", "dynamics2d", "dynamics3d"));

class BetweenMasses : public BetweenEngines
{
};

TEST_P(BetweenMasses, ASlidingPreyKeepsItsMomentum)
{
  TwoEngines scene = Scene();
  // The robot gives the prey its speed, and stops.
  scene.controllers = TravellerText("c", "<speed>0.3</speed><until>15</until>");
  scene.arena = Footbot("fb", 0.9, 1, 0, "c") +
                "<cylindric_prey id='prey' position='1.2, 1, 0' radius='0.1' height='0.1' mass='0.5' "
                "ground_friction='0.002' restitution='0'/>";
  Start(scene);
  double speed = 0;
  bool crossed = false;
  for (int tick = 0; tick < 200 && At("prey").x() < 2.4; ++tick)
  {
    const Vector3 before = At("prey");
    const std::uint32_t engine = Engine("prey");
    Run(1);
    const double now = (At("prey") - before).norm() / kTick;
    // Friction takes 2 mm/s in a tick.
    if (engine == 1 || engine != Engine("prey"))
    {
      EXPECT_NEAR(now, speed, 0.006) << At("prey").transpose();
    }
    speed = now;
    crossed |= engine == 1;
  }
  EXPECT_TRUE(crossed);
  EXPECT_GT(speed, 0.1);
}

INSTANTIATE_TEST_SUITE_P(All, BetweenMasses,
                         testing::Values(Pair("dynamics2d", "dynamics3d"), Pair("dynamics3d", "dynamics2d"),
                                         Pair("dynamics3d", "dynamics3d"), Pair("dynamics2d", "dynamics2d")),
                         [](const auto& parameters)
                         { return std::string(parameters.param.first) + "_" + parameters.param.second; });

TEST_F(Volumes, OutsideAllVolumesTheRunStopsOrTheEngineKeepsTheRobot)
{
  TwoEngines scene{.controllers = TravellerText("c", "<speed>0.2</speed>"), .arena = Footbot("fb", 0.3, 1, 180, "c")};
  Start(scene);
  const std::string mistake = test::MessageOf<std::runtime_error>([&] { Run(30); });
  EXPECT_THAT(mistake, HasSubstr("engine 'west' (dummy_engine): Update at tick "));
  EXPECT_THAT(mistake, HasSubstr("the footbot 'fb' left the volumes of all engines that can move it"));
  scene.outside = "keep";
  Start(scene);
  Run(30);
  EXPECT_LT(At("fb").x(), 0);
  EXPECT_EQ(Engine("fb"), 0U);
}

TEST_F(Volumes, ARobotThatIsMovedChangesItsEngineAtOnce)
{
  Start({.controllers = TravellerText("c", "<speed>0.1</speed>"), .arena = Footbot("fb", 1, 1, 0, "c")});
  Run(5);
  simulator_->GetEditor().MoveEntity("fb", {{3, 2, 0}, Quaternion::Identity()});
  EXPECT_EQ(Engine("fb"), 1U);
  Run(5);
  EXPECT_NEAR(At("fb").x(), 3 + 5 * 0.1 * kTick, 0.02);
  EXPECT_NEAR(At("fb").y(), 2, 0.001);
  simulator_->GetEditor().MoveEntity("fb", {{1, 2, 0}, Quaternion::Identity()});
  EXPECT_EQ(Engine("fb"), 0U);
  Run(5);
  EXPECT_NEAR(At("fb").x(), 1 + 5 * 0.1 * kTick, 1e-9);
  EXPECT_THAT(test::MessageOf<std::invalid_argument>(
                  [&] {
                    simulator_->GetEditor().MoveEntity("fb", {{5, 2, 0}, Quaternion::Identity()});
                  }),
              HasSubstr("outside the volumes of all engines that can move it"));
}

TEST_F(Volumes, AReserveIsAddedToTheEngineOfItsPlace)
{
  Start({.controllers = TravellerText("c", "<speed>0.1</speed>"),
         .arena = "<reserve quantity='2'><footbot id='late' controller='c'/></reserve>"});
  Run(2);
  const std::string first = simulator_->GetEditor().AddEntity("late", {{3, 1, 0}, Quaternion::Identity()});
  const std::string second = simulator_->GetEditor().AddEntity("late", {{1, 1, 0}, Quaternion::Identity()});
  Run(10);
  EXPECT_EQ(Engine(first), 1U);
  EXPECT_EQ(Engine(second), 0U);
  EXPECT_NEAR(At(first).x(), 3.1, 0.03);
  EXPECT_NEAR(At(second).x(), 1.1, 1e-9);
  simulator_->GetEditor().RemoveEntity(first);
  Run(5);
  EXPECT_FALSE(Space().IsPresent(Space().FindEntity(first)->GetIndex()));
}

TEST_F(Volumes, MistakesOfTheFileAreNamed)
{
  RegisterBuiltins();
  const auto mistakes = [](const std::string& arena, const std::string& physics)
  {
    const test::ExperimentText text{.size = "4,4,2", .arena = arena, .physics = physics};
    std::string all;
    for (const Diagnostic& mistake : LoadExperimentText(text.Text(), "test.xml", ".").errors)
      all += mistake.message + "\n";
    return all;
  };
  EXPECT_THAT(mistakes(Footbot("fb", 1, 1, 0), "<engine id='e' volume='0, 0, 4'><all/></engine>"),
              HasSubstr("the volume of the engine 'e' is '0, 0, 4': an outline has x and y of at least two corners"));
  EXPECT_THAT(mistakes(Footbot("fb", 1, 1, 0), "<engine id='e' heights='1, 0'><all/></engine>"),
              HasSubstr("the volume of the engine 'e' reaches from 1 to 0 m"));
  EXPECT_THAT(mistakes(Footbot("fb", 1, 1, 0), "<engine id='e' volume='2, 2, 4, 4'><all/></engine>"),
              HasSubstr("the footbot 'fb' starts at 1, 1, 0, outside the volumes of all engines that can move it: "
                        "'e' within 2, 2, 4, 4"));
  // A robot on a terrain that is not there has no height. The missing file is the only mistake.
  const std::string terrain =
      "<terrain id='hills'><position>2, 2, 0</position><heightmap file='nowhere.png' size='2, 2' "
      "height='1'/></terrain>";
  const std::string missing =
      mistakes(terrain + Footbot("fb", 2, 2, 0), "<engine id='e' volume='0, 0, 4, 4'><all/></engine>");
  EXPECT_THAT(missing, HasSubstr("nowhere.png"));
  EXPECT_THAT(missing, testing::Not(HasSubstr("outside the volumes")));
}

// Robots of rough_patch.xml cross the border in both directions, and none enters another one.
TEST(RoughPatch, FootbotsChangeTheirEngineAndStayApart)
{
  RunningExperiment run("rough_patch.xml");
  const std::size_t robots = run.EntitiesOf("south").size() + run.EntitiesOf("north").size();
  std::vector<const CSwarmanoidSpaceEntity*> all = run.EntitiesOf("south");
  for (const CSwarmanoidSpaceEntity* robot : run.EntitiesOf("north")) all.push_back(robot);
  ASSERT_EQ(robots, 12U);
  int into = 0, out = 0;
  double highest = 0, nearest = 1, longest = 0;  // the last one at a change
  for (int tick = 0; tick < 600; ++tick)
  {
    std::vector<std::uint32_t> before;
    std::vector<Vector3> places;
    for (const auto* robot : all)
    {
      before.push_back(EngineOf(run.Space(), robot->GetId()));
      places.push_back(robot->GetPosition());
    }
    run.Run(1);
    for (std::size_t k = 0; k < all.size(); ++k)
    {
      const std::uint32_t now = EngineOf(run.Space(), all[k]->GetId());
      into += before[k] == 0 && now == 1 ? 1 : 0;
      out += before[k] == 1 && now == 0 ? 1 : 0;
      const Vector3 at = all[k]->GetPosition();
      highest = std::max(highest, at.z());
      if (before[k] != now) longest = std::max(longest, (at - places[k]).norm());
      for (std::size_t other = 0; other < k; ++other)
        nearest = std::min(nearest, (at - all[other]->GetPosition()).head<2>().norm());
      EXPECT_TRUE(run.File().engines[now].volume.Holds(at)) << all[k]->GetId() << " at " << at.transpose();
    }
  }
  EXPECT_GT(into, 5);
  EXPECT_GT(out, 3);
  EXPECT_GT(highest, 0.015);
  EXPECT_GT(nearest, 2 * kRadius - 0.005);
  EXPECT_LT(longest, 1.1 * 0.1 * kTick);
}

TEST(RoughPatch, ACheckpointHasTheEngineOfEachRobot)
{
  const test::TemporaryFolder folder;
  SimulatorOptions options;
  options.output_folder = folder.Path();
  options.checkpoint_every = 100;
  const RunningExperiment::Settings settings{{"framework.maxclock", "400"}};
  const std::uint64_t expected = RunningExperiment("rough_patch.xml", settings, options).HashAtTheEnd();
  options.checkpoint_every = 0;
  for (const std::uint64_t tick : {100U, 200U, 300U})
  {
    options.restore_file = (folder / CheckpointName(tick)).string();
    EXPECT_EQ(RunningExperiment("rough_patch.xml", settings, options).HashAtTheEnd(), expected) << tick;
  }
}

}  // namespace
}  // namespace swarmanoid
