// Entities that loop functions of ARGoS3 make, devices that users register, behaviours of Kilobots, and drawings in a
// run. What a file is converted to depends on names in the library of its loop functions, so these tests write one.
#include <argos3/core/simulator/actuator.h>
#include <argos3/core/simulator/sensor.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/robots/kilobot/control_interface/ci_kilobot_controller.h>
#include <argos3/plugins/robots/kilobot/simulator/kilobot_entity.h>
#include <argos3/plugins/simulator/entities/box_entity.h>
#include <argos3/plugins/simulator/entities/cylinder_entity.h>
#include <argos3/plugins/simulator/entities/light_entity.h>
#include <argos3/plugins/simulator/visualizations/qt-opengl/qtopengl_user_functions.h>
#include <gmock/gmock.h>
#include <signal.h>

#include <string>
#include <vector>

#include "argos3/converter/convert.h"
#include "argos3/library/pen.h"
#include "common/configuration/xml_reader.h"
#include "common/configuration/xml_writer.h"
#include "common/experiment/load_experiment.h"
#include "simulation/register_all.h"
#include "simulation/simulator.h"
#include "tests/unit/argos3/argos3_run.h"
#include "tests/world/message_of.h"

// A sensor and an actuator as users write them.
class CCountingSensor : public argos::CSimulatedSensor, public argos::CCI_Sensor
{
public:
  void SetRobot(argos::CComposableEntity& robot) override { robot_ = &robot; }
  void Init(argos::TConfigurationNode& node) override
  {
    argos::GetNodeAttribute(node, "step", step_);
    is_clean_ = !argos::NodeAttributeExists(node, "argos3_library");
  }
  void Update() override { counted_ += step_; }
  void Reset() override { counted_ = 0; }
  void Destroy() override { swarmanoid::test::TheCode().calls += "sensor ends; "; }
  std::string RobotId() const { return robot_->GetId(); }
  bool IsClean() const { return is_clean_; }
  int Counted() const { return counted_; }

private:
  argos::CComposableEntity* robot_ = nullptr;
  int step_ = 0;
  int counted_ = 0;
  bool is_clean_ = false;
};

class CShiningActuator : public argos::CSimulatedActuator, public argos::CCI_Actuator
{
public:
  void SetRobot(argos::CComposableEntity& robot) override
  {
    leds_ = &robot.GetComponent<argos::CLEDEquippedEntity>("leds");
  }
  void Update() override { leds_->SetAllLEDsColors(colour_); }
  void Reset() override { colour_ = argos::CColor::BLACK; }
  void Shine(const argos::CColor& colour) { colour_ = colour; }

private:
  argos::CLEDEquippedEntity* leds_ = nullptr;
  argos::CColor colour_ = argos::CColor::BLACK;
};

// Tells what it is asked to draw, and what the drawing has then.
class CTellingFunctions : public argos::CQTOpenGLUserFunctions
{
public:
  CTellingFunctions()
  {
    RegisterUserFunction<CTellingFunctions, argos::CFootBotEntity>(&CTellingFunctions::DrawRobot);
    RegisterUserFunction<CTellingFunctions, argos::CBoxEntity>(&CTellingFunctions::DrawBoxEntity);
  }
  void Init(argos::TConfigurationNode& node) override
  {
    swarmanoid::test::TheCode().calls += "user " + node.GetAttribute("label") + "; ";
  }
  void Destroy() override { swarmanoid::test::TheCode().calls += "user ends; "; }
  void KeyPressed(QKeyEvent* event) override { Handled("press " + event->text().toStdString()); }
  void KeyReleased(QKeyEvent* event) override { Handled("release " + std::to_string(event->key())); }
  void EntitySelected(argos::CEntity& entity) override { Handled("select " + entity.GetId()); }
  void EntityDeselected(argos::CEntity& entity) override { Handled("deselect " + entity.GetId()); }
  void DrawRobot(argos::CFootBotEntity& robot) { Tell(robot.GetId()); }
  void DrawBoxEntity(argos::CBoxEntity& box) { Tell(box.GetId()); }
  void Draw(argos::CFloorEntity& floor) override { Tell(floor.GetId()); }
  void DrawInWorld() override { Tell("world"); }

private:
  void Handled(const std::string& what) { swarmanoid::test::TheCode().calls += what + "; "; }
  void Tell(const std::string& what)
  {
    DrawPoint(argos::CVector3(1, 2, 3), argos::CColor(static_cast<argos::UInt8>(++drawn_), 0, 0));
    const swarmanoid::Drawing& drawing = swarmanoid::argos3::TheRunning().pen->GetDrawing();
    std::ostringstream text;
    text << what << " in " << drawing.shapes.back().frame << " at " << drawing.numbers[drawing.numbers.size() - 3]
         << "," << drawing.numbers[drawing.numbers.size() - 2] << "," << drawing.numbers.back() << "; ";
    swarmanoid::test::TheCode().calls += text.str();
  }
  int drawn_ = 0;
};

REGISTER_SENSOR(CCountingSensor, "counting", "default", "", "", "", "", "")
REGISTER_ACTUATOR(CShiningActuator, "shining", "default", "", "", "", "", "")
REGISTER_QTOPENGL_USER_FUNCTIONS(CTellingFunctions, "telling")

namespace
{

using namespace argos;
using swarmanoid::test::Argos3Run;
using swarmanoid::test::Argos3Text;
using swarmanoid::test::Coded;
using swarmanoid::test::MessageOf;
using swarmanoid::test::Placed;
using swarmanoid::test::TheCode;
using testing::HasSubstr;
using testing::Not;

TEST(Argos3Making, RobotsThatTheFileDoesNotDeclareAreAdded)
{
  Argos3Run run({.controllers = Coded("c", "<differential_steering/>", ""),
                 .arena = Placed("foot-bot", "a", "0,0,0", "c"),
                 .names = {"14CFootBotEntityC"}});
  EXPECT_EQ(TheCode().calls, "init a spoken; init 0; ") << "waiting robots have no controllers";
  EXPECT_EQ(run.Space().GetNumberEntities(), 1U);
  TheCode().calls.clear();
  auto* made = new CFootBotEntity("made", "c", CVector3(1, 2, 0), CQuaternion(CRadians::PI_OVER_TWO, CVector3::Z));
  CCI_Controller& controller = made->GetControllableEntity().GetController();
  EXPECT_EQ(controller.GetId(), "made") << "before it is added";
  EXPECT_EQ(TheCode().calls, "init made spoken; ");
  run.Functions().AddEntity(*made);
  EXPECT_EQ(&made->GetControllableEntity().GetController(), &controller);
  EXPECT_EQ(&run.Space().GetEntity("made"), made);
  EXPECT_EQ(run.Space().GetNumberEntities(), 2U);
  int steps = 0;
  TheCode().steps["made"] = [&](CCI_Controller& robot)
  {
    EXPECT_EQ(robot.GetId(), "made");
    ++steps;
  };
  TheCode().calls.clear();
  run.Step(2);
  EXPECT_EQ(steps, 2);
  EXPECT_LT(Distance(run.PlaceOf("made"), CVector3(1, 2, 0)), 1e-6);
  EXPECT_EQ(&run.Space().GetEntity("made"), made);
  EXPECT_THAT(MessageOf<CARGoSException>([&] { run.Functions().AddEntity(*new CFootBotEntity("x", "none")); }),
              HasSubstr("no foot-bot with the controller 'none' can be added as 'x'"));
  TheCode().calls.clear();
  run.Functions().RemoveEntity(*made);
  EXPECT_EQ(TheCode().calls, "destroy made; ") << "its controller ends at once";
  run.Step();
  EXPECT_EQ(run.Space().GetNumberEntities(), 1U);
  EXPECT_EQ(steps, 2);
  TheCode().calls.clear();
  run.Functions().AddEntity(*new CFootBotEntity("late", "c", CVector3(-1, 0, 0)));
  EXPECT_EQ(TheCode().calls, "init late spoken; ");
  run.Step();
  EXPECT_LT(Distance(run.PlaceOf("late"), CVector3(-1, 0, 0)), 1e-6);
  EXPECT_EQ(run.Get("late").GetControllableEntity().GetController().GetId(), "late");
  // One of a hundred has been taken, and one was given back.
  for (int i = 0; i < 99; ++i)
    run.Functions().AddEntity(
        *new CFootBotEntity("r" + std::to_string(i), "c", CVector3(-3 + 0.3 * (i % 20), -3 + 0.3 * (i / 20), 0)));
  EXPECT_THAT(MessageOf<CARGoSException>([&] { run.Functions().AddEntity(*new CFootBotEntity("last", "c")); }),
              HasSubstr("all"));
  run.Step();
  EXPECT_EQ(run.Space().GetNumberEntities(), 101U);
}

TEST(Argos3Making, LightsThatTheFileDoesNotDeclareAreAdded)
{
  Argos3Run run({.controllers = Coded("c", "", ""),
                 .arena = Placed("foot-bot", "a", "0,0,0", "c"),
                 .names = {"12CLightEntityC"}});
  for (int i = 0; i < 20; ++i)
    run.Functions().AddEntity(
        *new CLightEntity("lamp" + std::to_string(i), CVector3(0.1 * i, 1, 0.5), CColor(1, 2, 3), 0.5));
  EXPECT_THROW(run.Functions().AddEntity(*new CLightEntity("more", CVector3(), CColor::RED, 1)), CARGoSException);
  run.Step();
  auto& lamp = run.Get<CLightEntity>("lamp3");
  EXPECT_LT(Distance(lamp.GetPosition(), CVector3(0.3, 1, 0.5)), 1e-9);
  EXPECT_EQ(lamp.GetColor(), CColor(1, 2, 3));
  EXPECT_EQ(lamp.GetIntensity(), 0.5);
  lamp.SetColor(CColor::RED);
  run.Simulator().GetSpace().Reset();
  EXPECT_EQ(lamp.GetColor(), CColor(1, 2, 3)) << "as it was added";
  run.Functions().RemoveEntity("lamp3");
  run.Functions().AddEntity(*new CLightEntity("more", CVector3(2, 2, 1), CColor::RED, 1));
  run.Step();
  EXPECT_LT(Distance(run.Get<CLightEntity>("more").GetPosition(), CVector3(2, 2, 1)), 1e-9);
  EXPECT_EQ(run.Space().GetNumberEntities(), 21U);
}

TEST(Argos3Making, BodiesThatInitMakesAreKeptReady)
{
  const auto make = [](CLoopFunctions& functions)
  {
    auto* lit = new CBoxEntity("lit", CVector3(1, 0, 0), CQuaternion(), true, CVector3(0.2, 0.3, 0.4), 2);
    lit->AddLED(CVector3(0, 0, 0.4), CColor::RED);
    functions.AddEntity(*lit);
    functions.AddEntity(*new CBoxEntity("wall", CVector3(-1, 0, 0), CQuaternion(), false, CVector3(0.1, 1, 0.4)));
    functions.AddEntity(*new CCylinderEntity("can", CVector3(0, 1, 0), CQuaternion(), true, 0.1, 0.2, 3));
  };
  Argos3Run run({.controllers = Coded("c", "", ""),
                 .arena = Placed("foot-bot", "a", "0,0,0", "c"),
                 .names = {"10CBoxEntityC", "15CCylinderEntityC"}},
                {.init = make});
  EXPECT_EQ(run.Space().GetNumberEntities(), 4U);
  run.Step();
  auto& lit = run.Get<CBoxEntity>("lit");
  EXPECT_LT(Distance(run.PlaceOf("lit"), CVector3(1, 0, 0)), 1e-6);
  EXPECT_LT(Distance(run.PlaceOf("wall"), CVector3(-1, 0, 0)), 1e-6);
  EXPECT_LT(Distance(run.PlaceOf("can"), CVector3(0, 1, 0)), 1e-6);
  EXPECT_EQ(lit.GetLEDEquippedEntity().GetLED(0).GetColor(), CColor::RED);
  const SBoundingBox& box = lit.GetEmbodiedEntity().GetBoundingBox();
  EXPECT_LT(Distance(box.MinCorner, CVector3(0.9, -0.15, 0)), 1e-6) << box.MinCorner;
  EXPECT_LT(Distance(box.MaxCorner, CVector3(1.1, 0.15, 0.4)), 1e-6) << box.MaxCorner;
  EXPECT_THROW(lit.Resize(CVector3(1, 1, 1)), CARGoSException);
  CEmbodiedEntity& robot = run.Get("a").GetEmbodiedEntity();
  EXPECT_FALSE(robot.MoveTo(CVector3(-1, 0.3, 0), CQuaternion())) << "the wall is there";
  EXPECT_TRUE(robot.MoveTo(CVector3(-1, 0.7, 0), CQuaternion()));
  // More of the same kind are kept, others are not.
  for (int i = 0; i < 20; ++i)
    run.Functions().AddEntity(*new CCylinderEntity("can" + std::to_string(i), CVector3(-3 + 0.3 * i, 3, 0),
                                                   CQuaternion(), true, 0.1, 0.2, 3));
  EXPECT_EQ(run.Space().GetNumberEntities(), 24U);
  for (CEntity* other :
       {static_cast<CEntity*>(new CCylinderEntity("o", CVector3(3, 0, 0), CQuaternion(), true, 0.1, 0.3, 3)),
        static_cast<CEntity*>(new CCylinderEntity("o", CVector3(3, 0, 0), CQuaternion(), true, 0.1, 0.2, 4)),
        static_cast<CEntity*>(new CBoxEntity("o", CVector3(3, 0, 0), CQuaternion(), true, CVector3(0.1, 1, 0.4)))})
    EXPECT_THAT(MessageOf<CARGoSException>([&] { run.Functions().AddEntity(*other); }), HasSubstr("is left for 'o'"));
  run.Functions().RemoveEntity("lit");
  run.Step();
  EXPECT_EQ(run.Space().GetNumberEntities(), 23U);
  // Without LEDs it is dark.
  run.Functions().AddEntity(
      *new CBoxEntity("dark", CVector3(1, 0, 0), CQuaternion(), true, CVector3(0.2, 0.3, 0.4), 2));
  run.Step();
  auto& dark = run.Get<CBoxEntity>("dark");
  dark.AddLED(CVector3(), CColor::GREEN);
  EXPECT_EQ(dark.GetLEDEquippedEntity().GetLED(0).GetColor(), CColor::GREEN) << "an LED that is added in the arena";
}

TEST(Argos3Making, LoopFunctionsReadTheFile)
{
  Argos3Run run({.controllers = Coded("c", "", "") + Coded("d", "", ""),
                 .arena = Placed("foot-bot", "a", "0,0,0", "c"),
                 .names = {"20GetConfigurationRootE"}});
  TConfigurationNode& root = run.Simulator().GetConfigurationRoot();
  EXPECT_EQ(root.Value(), "argos-configuration");
  EXPECT_EQ(GetNode(GetNode(root, "framework"), "experiment").GetAttribute("random_seed"), "1");
  EXPECT_EQ(GetNode(GetNode(root, "arena"), "foot-bot").GetAttribute("id"), "a");
  EXPECT_EQ(run.Simulator().GetConfigForController("d").GetAttribute("id"), "d");
  EXPECT_EQ(run.Simulator().GetConfigForController("c").Value(), "coded");
  EXPECT_THROW(run.Simulator().GetConfigForController("e"), CARGoSException);
}

TEST(Argos3Making, ARunThatBeginsAgainHasItsLengthEachTime)
{
  Argos3Run run({.controllers = Coded("c", "", ""),
                 .arena = Placed("foot-bot", "a", "0,0,0", "c"),
                 .experiment = "length='0.4' ticks_per_second='10' random_seed='1'",
                 .names = {"10CSimulator5ResetE"}});
  for (int trial = 0; trial < 3; ++trial)
  {
    EXPECT_EQ(run.Simulator().GetMaxSimulationClock(), 4U);
    run.Simulator().Execute();
    EXPECT_EQ(run.Space().GetSimulationClock(), 4U);
    run.Simulator().Reset();
    EXPECT_EQ(run.Space().GetSimulationClock(), 0U);
  }
}

TEST(Argos3Making, DevicesOfUsersReadAndChangeTheArena)
{
  const std::vector<std::string> names{"argos3 sensor counting (default)", "argos3 actuator shining (default)"};
  Argos3Run run({.controllers = Coded("c", "<shining implementation='default'/>",
                                      "<counting implementation='default' step='3'/>", "libcode"),
                 .arena = Placed("foot-bot", "a", "0,0,0", "c") + Placed("foot-bot", "b", "1,0,0", "c"),
                 .names = names});
  run.Step("a",
           [](CCI_Controller& robot)
           {
             const auto* sensor = robot.GetSensor<CCountingSensor>("counting");
             EXPECT_EQ(sensor->RobotId(), "a");
             EXPECT_TRUE(sensor->IsClean()) << "the element is that of the file";
             EXPECT_EQ(sensor->Counted(), 3) << "before the control step";
             robot.GetActuator<CShiningActuator>("shining")->Shine(CColor::BLUE);
           });
  EXPECT_EQ(run.Get("a").GetLEDEquippedEntity().GetLED(5).GetColor(), CColor::BLUE) << "behind the control step";
  EXPECT_EQ(run.Get("b").GetLEDEquippedEntity().GetLED(5).GetColor(), CColor::BLACK);
  run.Step("b",
           [](CCI_Controller& robot)
           {
             EXPECT_EQ(robot.GetSensor<CCountingSensor>("counting")->RobotId(), "b");
             EXPECT_EQ(robot.GetSensor<CCountingSensor>("counting")->Counted(), 6);
           });
  run.Simulator().Reset();
  EXPECT_EQ(run.Get("a").GetLEDEquippedEntity().GetLED(5).GetColor(), CColor::BLACK);
  run.Step("a", [](CCI_Controller& robot) { EXPECT_EQ(robot.GetSensor<CCountingSensor>("counting")->Counted(), 3); });
  EXPECT_EQ(run.Get("a").GetLEDEquippedEntity().GetLED(5).GetColor(), CColor::BLACK);
}

const std::string kBehaviors = SWARMANOID_BUILD_FOLDER "/tests/argos3/libraries/";

// A controller of Kilobots with a behaviour.
std::string Behaving(const std::string& program)
{
  return "<kilobot_controller id='k'><actuators><differential_steering/><kilobot_led/><kilobot_communication/>"
         "</actuators><sensors><kilobot_communication medium='air'/><kilobot_light/></sensors><params behavior='" +
         kBehaviors + program + "'/></kilobot_controller>";
}

CCI_KilobotController& BehaviorOf(Argos3Run& run, const std::string& id)
{
  return dynamic_cast<CCI_KilobotController&>(run.Get(id).GetControllableEntity().GetController());
}

TEST(Argos3Making, BehavioursOfKilobotsDriveAndWait)
{
  Argos3Run run({.controllers = Behaving("kilo_blink"),
                 .arena = Placed("kilobot", "kb4", "0,0,0", "k") +
                          "<light id='lamp' position='0.5,0.1,0.3' orientation='0,0,0' intensity='1' medium='leds'/>",
                 .size = "2,2,1",
                 .media = "<kilobot_communication id='air'/><led id='leds'/>",
                 .experiment = "length='0' ticks_per_second='31' random_seed='5'"});
  CCI_KilobotController& behavior = BehaviorOf(run, "kb4");
  EXPECT_GT(behavior.GetBehaviorPID(), 0);
  const kilobot_state_t* state = behavior.GetRobotState();
  std::string colours;
  const auto steps = [&]
  {
    colours.clear();
    for (int step = 0; step < 44; ++step)
    {
      run.Step();
      const CColor colour = run.Get("kb4").GetLEDEquippedEntity().GetLED(0).GetColor();
      colours += colour == CColor::RED ? 'r' : colour == CColor::BLUE ? 'b' : '?';
    }
    return colours;
  };
  // The delays of half and a quarter of a second last 16 and 8 steps, and the loop is called again in the step after.
  const std::string expected = std::string(16, 'r') + std::string(9, 'b') + std::string(16, 'r') + std::string(3, 'b');
  EXPECT_EQ(steps(), expected);
  EXPECT_EQ(state->left_motor, 51);
  EXPECT_EQ(state->right_motor, 102);
  EXPECT_GT(state->ambientlight, 100);
  const auto& wheels = run.Get<CKilobotEntity>("kb4").GetWheeledEntity();
  EXPECT_NEAR(wheels.GetWheelVelocity(0), 0.024, 1e-9) << "the right motor drives the left leg";
  EXPECT_NEAR(wheels.GetWheelVelocity(1), 0.012, 1e-9);
  const pid_t before = behavior.GetBehaviorPID();
  run.Simulator().Reset();
  EXPECT_NE(behavior.GetBehaviorPID(), before);
  EXPECT_EQ(steps(), expected);
  kill(behavior.GetBehaviorPID(), SIGKILL);
  EXPECT_THAT(MessageOf<CARGoSException>([&] { run.Step(); }), HasSubstr("of the Kilobot 'kb4' ended by signal 9"));
}

TEST(Argos3Making, BehavioursOfKilobotsTalkToEachOther)
{
  Argos3Run run({.controllers = Behaving("kilo_gradient"),
                 .arena = Placed("kilobot", "kb0", "0,0,0", "k") + Placed("kilobot", "kb1", "0.0805,0,0", "k") +
                          Placed("kilobot", "kb2", "0.161,0,0", "k") + Placed("kilobot", "kb7", "0.6,0,0", "k"),
                 .size = "2,2,1",
                 .media = "<kilobot_communication id='air'/><led id='leds'/>",
                 .experiment = "length='0' ticks_per_second='31' random_seed='5'"});
  struct Shown
  {
    UInt8 hops;
    SInt16 nearest;
  };
  Shown* shown = BehaviorOf(run, "kb2").DebugInfoCreate<Shown>();
  EXPECT_EQ(shown->hops, 0);
  int requests = 0, sent = 0;
  for (int step = 0; step < 93; ++step)
  {
    run.Step();
    const UInt8 state = BehaviorOf(run, "kb7").GetRobotState()->tx_state;
    requests += state == 1 ? 1 : 0;
    sent += state == 2 ? 1 : 0;
  }
  // The colours show the hops.
  EXPECT_EQ(BehaviorOf(run, "kb0").GetRobotState()->color, RGB(0, 1, 0));
  EXPECT_EQ(BehaviorOf(run, "kb1").GetRobotState()->color, RGB(1, 1, 0));
  EXPECT_EQ(BehaviorOf(run, "kb2").GetRobotState()->color, RGB(2, 1, 0));
  EXPECT_EQ(BehaviorOf(run, "kb7").GetRobotState()->color, 0) << "it hears none";
  EXPECT_EQ(run.Get("kb2").GetLEDEquippedEntity().GetLED(0).GetColor(), CColor(170, 85, 0));
  EXPECT_EQ(shown->hops, 2);
  EXPECT_EQ(shown->nearest, 80) << "whole mm";
  BehaviorOf(run, "kb2").DebugInfoDestroy(shown);
  // A message each 100 ms: in each fourth step, and one step later each time.
  EXPECT_NEAR(requests, 93 / 5, 1);
  EXPECT_EQ(sent, 0) << "the behaviour has answered that it knows";
}

TEST(Argos3Making, UserFunctionsDrawEntitiesTheFloorAndTheWorld)
{
  namespace fs = std::filesystem;
  TheCode() = {};
  const swarmanoid::test::TemporaryFolder folder;
  const std::string library = Argos3Text().library;
  const auto root = swarmanoid::ReadXml(
      "<argos-configuration><framework><experiment length='0.3' ticks_per_second='10' random_seed='1'/></framework>"
      "<controllers>" +
          Coded("c", "", "") + "</controllers><loop_functions library='" + library +
          "' label='coded'/>"
          "<arena size='4,4,2' center='0,0,1'><floor id='floor' source='loop_functions'/>" +
          Placed("foot-bot", "a", "0,0,0", "c") +
          Placed("box", "crate", "1,0,0", "", "0,0,0", "size='0.2,0.2,0.6' movable='true' mass='1'") +
          Placed("cylinder", "can", "-1,0,0", "", "0,0,0", "radius='0.1' height='0.2' movable='true' mass='3'") +
          "</arena><physics_engines><dummy_engine id='d'/></physics_engines><media/><visualization><qt-opengl>"
          "<user_functions library='" +
          library + "' label='telling'/></qt-opengl></visualization></argos-configuration>",
      "x.argos");
  const swarmanoid::ConvertedExperiment converted = swarmanoid::ConvertArgos3(*root, folder.Path());
  ASSERT_TRUE(converted.mistakes.empty()) << converted.mistakes.front().Text();
  std::string text = swarmanoid::WriteXml(*converted.root);
  const std::string end = "</ahss-config>";
  text.insert(text.rfind(end), "<visualisations><text_render id='v' file='v.txt'/></visualisations>");
  swarmanoid::RegisterBuiltins();
  swarmanoid::LoadedExperiment loaded = swarmanoid::LoadExperimentText(text, "x.xml", folder.Path());
  ASSERT_TRUE(loaded.experiment) << loaded.errors.front().Text();
  swarmanoid::SimulatorOptions options;
  options.output_folder = folder.Path();
  options.events = folder.Write("events.csv",
                                "tick,request,entity,numbers,from,number,when\n2,press,I,,,,\n2,release,I,,,,\n"
                                "2,select,crate,,,,\n2,select,a,,,,\n2,deselect,,,,,\n");
  {
    swarmanoid::CSimulator simulator(*loaded.experiment, options);
    while (simulator.Step()) continue;
    simulator.Finish();
  }
  const std::string& calls = TheCode().calls;
  EXPECT_THAT(calls, HasSubstr("init 0; begin 0; user telling; "));
  // The robot is the first entity, the box the second; its base is 0.3 m below its middle. The arena's corner is our
  // origin.
  EXPECT_THAT(calls, HasSubstr("a in 1 at 1,2,3; crate in 2 at 1,2,2.7; floor in 0 at 3,4,3; world in 0 at 3,4,3; "));
  EXPECT_THAT(calls, HasSubstr("user ends; end 3; destroy 3; ")) << calls;
  EXPECT_THAT(calls, Not(HasSubstr("pre 4")));
  EXPECT_THAT(calls, HasSubstr("press i; release 73; select crate; deselect crate; select a; deselect a; "));
}

}  // namespace
