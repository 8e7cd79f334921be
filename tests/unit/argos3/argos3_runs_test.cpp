// Devices, entities and loop functions of ARGoS3 in a run of this process. The places and readings follow from the
// scene by hand.
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_proximity_sensor.h>
#include <argos3/plugins/robots/e-puck/simulator/epuck_entity.h>
#include <argos3/plugins/robots/eye-bot/control_interface/ci_eyebot_light_sensor.h>
#include <argos3/plugins/robots/eye-bot/control_interface/ci_eyebot_proximity_sensor.h>
#include <argos3/plugins/robots/eye-bot/simulator/eyebot_entity.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_base_ground_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_distance_scanner_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_distance_scanner_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_gripper_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_light_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_motor_ground_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_proximity_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_turret_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_turret_encoder_sensor.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/robots/generic/control_interface/ci_battery_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_colored_blob_omnidirectional_camera_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_colored_blob_perspective_camera_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_ground_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_leds_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_light_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_positioning_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_proximity_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_quadrotor_position_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_quadrotor_speed_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_sensor.h>
#include <argos3/plugins/simulator/entities/box_entity.h>
#include <argos3/plugins/simulator/entities/cylinder_entity.h>
#include <argos3/plugins/simulator/entities/light_entity.h>
#include <argos3/plugins/simulator/media/rab_medium.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/unit/argos3/argos3_run.h"
#include "tests/world/message_of.h"

class CCoded : public argos::CCI_Controller
{
public:
  void Init(argos::TConfigurationNode& params) override
  {
    std::string word;
    argos::GetNodeAttribute(params, "word", word);
    swarmanoid::test::TheCode().calls += "init " + GetId() + " " + word + "; ";
  }
  void ControlStep() override
  {
    const auto& steps = swarmanoid::test::TheCode().steps;
    if (const auto own = steps.find(GetId()); own != steps.end()) own->second(*this);
  }
  void Reset() override { swarmanoid::test::TheCode().calls += "reset " + GetId() + "; "; }
  void Destroy() override { swarmanoid::test::TheCode().calls += "destroy " + GetId() + "; "; }
};

class CCodedFunctions : public argos::CLoopFunctions
{
public:
  void Init(argos::TConfigurationNode&) override
  {
    Called("init");
    if (const auto& init = swarmanoid::test::TheCode().init) init(*this);
  }
  void Reset() override { Called("reset"); }
  void Destroy() override { Called("destroy"); }
  void PreStep() override { Called("pre"); }
  void PostStep() override { Called("post"); }
  void PreExperiment() override { Called("begin"); }
  void PostExperiment() override { Called("end"); }
  bool IsExperimentFinished() override
  {
    const auto& is_over = swarmanoid::test::TheCode().is_over;
    return is_over && is_over();
  }
  argos::CColor GetFloorColor(const argos::CVector2& place) override
  {
    const auto& floor = swarmanoid::test::TheCode().floor;
    return floor ? floor(place) : argos::CColor::WHITE;
  }

private:
  void Called(const std::string& what)
  {
    swarmanoid::test::TheCode().calls += what + " " + std::to_string(GetSpace().GetSimulationClock()) + "; ";
  }
};

REGISTER_CONTROLLER(CCoded, "coded")
REGISTER_LOOP_FUNCTIONS(CCodedFunctions, "coded")

namespace
{

using namespace argos;
using swarmanoid::test::Argos3Code;
using swarmanoid::test::Argos3Run;
using swarmanoid::test::Argos3Text;
using swarmanoid::test::Coded;
using swarmanoid::test::MessageOf;
using swarmanoid::test::Placed;
using swarmanoid::test::TheCode;
using testing::ElementsAre;

constexpr double kClose = 1e-6;
constexpr double kFootBotRadius = 0.085036758;

CColor BlackOnTheLeft(const CVector2& place) { return place.GetY() > 0 ? CColor::BLACK : CColor::WHITE; }

const std::string kSpace = "<pointmass3d id='p'/>";
const std::string kFloor = "<floor id='floor' source='loop_functions' pixels_per_meter='10'/>";

double HeadingOf(Argos3Run& run, const std::string& robot)
{
  CRadians z, y, x;
  run.Get<CBodyEntity>(robot).GetEmbodiedEntity().GetOrientation().ToEulerAngles(z, y, x);
  return z.GetValue();
}

TEST(Argos3Runs, StepsAreInTheOrderOfArgos3)
{
  Argos3Run run({.controllers = Coded("c", "", ""), .arena = Placed("foot-bot", "a", "0,0,0", "c")});
  EXPECT_EQ(TheCode().calls, "init a spoken; init 0; ");
  TheCode().calls.clear();
  int steps = 0;
  TheCode().steps["a"] = [&](CCI_Controller&)
  {
    ++steps;
    TheCode().calls += "control; ";
  };
  run.Step(2);
  EXPECT_EQ(TheCode().calls, "pre 1; control; post 1; pre 2; control; post 2; ");
  EXPECT_EQ(run.Space().GetSimulationClock(), 2U);
  EXPECT_EQ(run.Simulator().GetRandomSeed(), 1U);
  EXPECT_EQ(run.Simulator().GetMaxSimulationClock(), 0U) << "without an end";
  EXPECT_EQ(CPhysicsEngine::GetSimulationClockTick(), 0.1);
  TheCode().calls.clear();
  TheCode().is_over = [] { return Argos3Run::Space().GetSimulationClock() >= 4; };
  EXPECT_FALSE(run.Simulator().IsExperimentFinished());
  run.Simulator().Execute();
  EXPECT_EQ(TheCode().calls, "begin 2; pre 3; control; post 3; pre 4; control; post 4; end 4; ");
  EXPECT_TRUE(run.Simulator().IsExperimentFinished());
  TheCode().is_over = {};
  run.Simulator().Terminate();
  EXPECT_TRUE(run.Simulator().IsExperimentFinished());
  TheCode().calls.clear();
  run.Simulator().Reset(5);
  EXPECT_EQ(TheCode().calls, "reset a; reset 0; ");
  EXPECT_EQ(run.Simulator().GetRandomSeed(), 5U);
  EXPECT_FALSE(run.Simulator().IsTerminated());
  EXPECT_EQ(steps, 4);
}

TEST(Argos3Runs, ARunHasTheLengthOfItsFile)
{
  Argos3Run run({.controllers = Coded("c", "", ""),
                 .arena = Placed("foot-bot", "a", "0,0,0", "c"),
                 .experiment = "length='0.5' ticks_per_second='20' random_seed='7'"});
  EXPECT_EQ(CPhysicsEngine::GetSimulationClockTick(), 0.05);
  EXPECT_EQ(run.Simulator().GetMaxSimulationClock(), 10U);
  EXPECT_EQ(run.Simulator().GetRandomSeed(), 7U);
  run.Simulator().Execute();
  EXPECT_EQ(run.Space().GetSimulationClock(), 10U);
  EXPECT_THROW(run.Simulator().LoadExperiment(), CARGoSException) << "one experiment at a time";
}

TEST(Argos3Runs, WheelsOfAFootBotTurnAsTheyAreTold)
{
  Argos3Run run({.controllers = Coded("c", "<differential_steering/>", "<differential_steering/>"),
                 .arena = Placed("foot-bot", "a", "1,2,0", "c")});
  EXPECT_EQ(run.PlaceOf("a"), CVector3(1, 2, 0));
  const auto drive = [](double left, double right)
  {
    return [=](CCI_Controller& robot)
    { robot.GetActuator<CCI_DifferentialSteeringActuator>("differential_steering")->SetLinearVelocity(left, right); };
  };
  const auto& wheels = run.Get<CFootBotEntity>("a").GetWheeledEntity();
  EXPECT_EQ(wheels.GetWheelVelocity(0), 0);
  run.Step("a", drive(10, 10));
  EXPECT_EQ(wheels.GetWheelVelocity(0), 0.1);
  run.Step();
  // Bodies move before the controllers, so the first step has moved none.
  EXPECT_NEAR(run.PlaceOf("a").GetX(), 1.01, kClose);
  run.Step("a", drive(4, 8));
  EXPECT_EQ(wheels.GetWheelVelocity(0), 0.04);
  EXPECT_EQ(wheels.GetWheelVelocity(1), 0.08);
  EXPECT_THROW(wheels.GetWheelVelocity(2), CARGoSException);
  run.Step("a",
           [](CCI_Controller& robot)
           {
             const auto& rolled =
                 robot.GetSensor<CCI_DifferentialSteeringSensor>("differential_steering")->GetReading();
             EXPECT_NEAR(rolled.VelocityLeftWheel, 4, kClose);
             EXPECT_NEAR(rolled.VelocityRightWheel, 8, kClose);
             EXPECT_NEAR(rolled.CoveredDistanceLeftWheel, 0.4, kClose);
             EXPECT_NEAR(rolled.CoveredDistanceRightWheel, 0.8, kClose);
             EXPECT_NEAR(rolled.WheelAxisLength, 14, kClose);
           });
  EXPECT_NEAR(HeadingOf(run, "a"), 0.004 / 0.14, 1e-4);
  // After a reset it stands where it stood, and its wheels have not turned.
  run.Simulator().Reset();
  EXPECT_EQ(run.PlaceOf("a"), CVector3(1, 2, 0));
  EXPECT_EQ(wheels.GetWheelVelocity(0), 0);
  EXPECT_EQ(wheels.GetWheelVelocity(1), 0);
  run.Step("a",
           [](CCI_Controller& robot)
           {
             const auto& rolled =
                 robot.GetSensor<CCI_DifferentialSteeringSensor>("differential_steering")->GetReading();
             EXPECT_EQ(rolled.VelocityLeftWheel, 0);
             EXPECT_EQ(rolled.CoveredDistanceRightWheel, 0);
           });
  EXPECT_EQ(run.PlaceOf("a"), CVector3(1, 2, 0));
}

TEST(Argos3Runs, LedsOfAFootBotAreSeenByLoopFunctionsAndCameras)
{
  Argos3Run run(
      {.controllers = Coded("c", "<leds medium='leds'/>", "<colored_blob_omnidirectional_camera medium='leds'/>"),
       .arena = Placed("foot-bot", "a", "0,0,0", "c") + Placed("foot-bot", "b", "0.5,0,0", "c", "90,0,0")});
  auto& leds = run.Get("b").GetLEDEquippedEntity();
  run.Step("b",
           [](CCI_Controller& robot)
           {
             auto* actuator = robot.GetActuator<CCI_LEDsActuator>("leds");
             EXPECT_EQ(actuator->GetNumLEDs(), 13U);
             actuator->SetSingleColor(3, CColor(200, 100, 50));
             actuator->SetSingleIntensity(3, 51);
             actuator->SetSingleColor(12, CColor::BLUE);
           });
  EXPECT_EQ(leds.GetLED(3).GetColor(), CColor(40, 20, 10)) << "a fifth of its intensity";
  EXPECT_EQ(leds.GetLED(12).GetColor(), CColor::BLUE) << "the beacon";
  for (const UInt32 led : {0U, 2U, 4U, 11U}) EXPECT_EQ(leds.GetLED(led).GetColor(), CColor::BLACK) << led;
  leds.SetLEDColor(0, CColor(1, 2, 3));
  EXPECT_EQ(leds.GetLED(0).GetColor(), CColor(1, 2, 3));
  leds.SetAllLEDsColors(CColor::BLACK);
  EXPECT_EQ(leds.GetLED(3).GetColor(), CColor::BLACK);
  EXPECT_EQ(leds.GetLED(12).GetColor(), CColor::BLACK);
  std::vector<CColor> colours(13, CColor::BLACK);
  colours[12] = CColor::GREEN;
  leds.SetAllLEDsColors(colours);
  EXPECT_EQ(leds.GetLED(12).GetColor(), CColor::GREEN);
  EXPECT_EQ(leds.GetLED(11).GetColor(), CColor::BLACK);
  EXPECT_THROW(leds.SetAllLEDsColors(std::vector<CColor>(12)), CARGoSException);
  // The actuator has the last word.
  run.Step("b",
           [](CCI_Controller& robot)
           {
             auto* actuator = robot.GetActuator<CCI_LEDsActuator>("leds");
             actuator->SetAllColors(CColor::BLACK);
             actuator->SetSingleColor(12, CColor::GREEN);
           });
  // The camera is off until it is enabled, and counts its pictures.
  using Camera = CCI_ColoredBlobOmnidirectionalCameraSensor;
  const char* const tag = "colored_blob_omnidirectional_camera";
  run.Step("a",
           [&](CCI_Controller& robot)
           {
             EXPECT_TRUE(robot.GetSensor<Camera>(tag)->GetReadings().BlobList.empty());
             robot.GetSensor<Camera>(tag)->Enable();
           });
  for (const unsigned picture : {1U, 2U})
    run.Step("a",
             [&](CCI_Controller& robot)
             {
               const auto& seen = robot.GetSensor<Camera>(tag)->GetReadings();
               EXPECT_EQ(seen.Counter, picture);
               ASSERT_EQ(seen.BlobList.size(), 1U);
               EXPECT_EQ(seen.BlobList[0]->Color, CColor::GREEN);
               EXPECT_NEAR(seen.BlobList[0]->Distance, 50, kClose);
               EXPECT_NEAR(seen.BlobList[0]->Angle.GetValue(), 0, kClose);
             });
  run.Step("a", [&](CCI_Controller& robot) { robot.GetSensor<Camera>(tag)->Disable(); });
  run.Step("a",
           [&](CCI_Controller& robot) { EXPECT_TRUE(robot.GetSensor<Camera>(tag)->GetReadings().BlobList.empty()); });
  // A reset makes the LEDs dark.
  run.Simulator().Reset();
  EXPECT_EQ(leds.GetLED(12).GetColor(), CColor::BLACK);
}

TEST(Argos3Runs, RobotsHearEachOther)
{
  Argos3Run run({.controllers = Coded("c", "<range_and_bearing/>", "<range_and_bearing medium='rab'/>"),
                 .arena = Placed("foot-bot", "a", "0,0,0", "c", "0,0,0", "rab_range='2'") +
                          Placed("foot-bot", "b", "0,1.5,0", "c", "180,0,0", "rab_range='2'") +
                          Placed("foot-bot", "far", "0,-2.1,0", "c", "0,0,0", "rab_range='2'") +
                          Placed("box", "wall", "-0.5,0,0", "", "0,0,0", "size='0.1,1,1' movable='false'") +
                          Placed("foot-bot", "hidden", "-1,0,0", "c", "0,0,0", "rab_range='2'")});
  const auto send = [](CCI_Controller& robot)
  {
    auto* sender = robot.GetActuator<CCI_RangeAndBearingActuator>("range_and_bearing");
    EXPECT_EQ(sender->GetSize(), 10U);
    for (size_t i = 0; i < 10; ++i) sender->SetData(i, static_cast<UInt8>(i + static_cast<size_t>(robot.GetId()[0])));
  };
  TheCode().steps["b"] = send;
  run.Step();
  run.Step("a",
           [](CCI_Controller& robot)
           {
             const auto& heard = robot.GetSensor<CCI_RangeAndBearingSensor>("range_and_bearing")->GetReadings();
             ASSERT_EQ(heard.size(), 1U);
             EXPECT_NEAR(heard[0].Range, 150, kClose);
             EXPECT_NEAR(heard[0].HorizontalBearing.GetValue(), std::numbers::pi / 2, kClose);
             EXPECT_NEAR(heard[0].VerticalBearing.GetValue(), 0, kClose);
             EXPECT_EQ(ToString(heard[0].Data), "98 99 100 101 102 103 104 105 106 107");
           });
  TheCode().steps.clear();
  auto& radio = run.Get("b").GetRABEquippedEntity();
  EXPECT_EQ(radio.GetMsgSize(), 10U);
  EXPECT_EQ(radio.GetRange(), 2);
  EXPECT_EQ(ToString(radio.GetData()), "98 99 100 101 102 103 104 105 106 107");
  radio.SetRange(2);
  EXPECT_THROW(radio.SetRange(2.5), CARGoSException);
  EXPECT_THROW(radio.SetData(CByteArray(9)), CARGoSException);
  EXPECT_THROW(radio.SetData(CByteArray(11)), CARGoSException);
  const auto first_byte = [&]
  {
    int byte = -1;
    run.Step("a",
             [&](CCI_Controller& robot)
             {
               const auto& heard = robot.GetSensor<CCI_RangeAndBearingSensor>("range_and_bearing")->GetReadings();
               if (heard.size() == 1) byte = heard[0].Data[0];
             });
    return byte;
  };
  CByteArray data(10);
  data[0] = 77;
  radio.SetData(data);
  EXPECT_EQ(ToString(radio.GetData()), "77 0 0 0 0 0 0 0 0 0");
  EXPECT_EQ(first_byte(), 77);
  // Written bytes are sent as well.
  radio.GetData()[0] = 33;
  EXPECT_EQ(first_byte(), 33);
  radio.ClearData();
  EXPECT_EQ(radio.GetData(), CByteArray(10));
  EXPECT_EQ(first_byte(), 0);
  const auto hears = [&](const std::string& id)
  {
    std::string heard;
    for (CRABEquippedEntity* other :
         run.Simulator().GetMedium<CRABMedium>("rab").GetRABsCommunicatingWith(run.Get(id).GetRABEquippedEntity()))
      heard += other->GetRootEntity().GetId() + " ";
    return heard;
  };
  EXPECT_EQ(hears("a"), "b ");
  EXPECT_EQ(hears("b"), "a hidden ");
  EXPECT_EQ(hears("hidden"), "b ");
  EXPECT_EQ(hears("far"), "");
  // A message is sent until a reset.
  data[0] = 44;
  radio.SetData(data);
  run.Space().Reset();
  EXPECT_EQ(radio.GetData(), CByteArray(10));
}

TEST(Argos3Runs, MessagesMayPassWallsAndHaveOtherSizes)
{
  Argos3Run run({.controllers = Coded("c", "<range_and_bearing/>", "<range_and_bearing medium='rab'/>"),
                 .arena = Placed("foot-bot", "a", "0,0,0", "c", "0,0,0", "rab_data_size='12'") +
                          Placed("box", "wall", "0.5,0,0", "", "0,0,0", "size='0.1,1,1' movable='false'") +
                          Placed("foot-bot", "b", "1,0,0", "c", "0,0,0", "rab_data_size='12'") +
                          Placed("foot-bot", "short", "0,1,0", "c", "0,0,0", "rab_data_size='4'"),
                 .media = "<range_and_bearing id='rab' check_occlusions='false'/>"});
  TheCode().steps["a"] = [](CCI_Controller& robot)
  {
    const UInt8 bytes[]{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 250};
    robot.GetActuator<CCI_RangeAndBearingActuator>("range_and_bearing")->SetData(bytes);
  };
  run.Step();
  run.Step("b",
           [](CCI_Controller& robot)
           {
             const auto& heard = robot.GetSensor<CCI_RangeAndBearingSensor>("range_and_bearing")->GetReadings();
             ASSERT_EQ(heard.size(), 1U);
             EXPECT_EQ(ToString(heard[0].Data), "1 2 3 4 5 6 7 8 9 10 11 250");
             EXPECT_NEAR(std::abs(heard[0].HorizontalBearing.GetValue()), std::numbers::pi, kClose);
           });
  run.Step("short",
           [](CCI_Controller& robot)
           {
             EXPECT_TRUE(robot.GetSensor<CCI_RangeAndBearingSensor>("range_and_bearing")->GetReadings().empty())
                 << "messages of another size";
           });
  EXPECT_EQ(run.Get("a").GetRABEquippedEntity().GetMsgSize(), 12U);
  EXPECT_EQ(run.Get("short").GetRABEquippedEntity().GetMsgSize(), 4U);
  EXPECT_EQ(ToString(run.Get("a").GetRABEquippedEntity().GetData()), "1 2 3 4 5 6 7 8 9 10 11 250");
  EXPECT_EQ(run.Get("a").GetRABEquippedEntity().GetRange(), 3) << "unless the file says another one";
  auto& medium = run.Simulator().GetMedium<CRABMedium>("rab");
  EXPECT_EQ(medium.GetRABsCommunicatingWith(run.Get("a").GetRABEquippedEntity()).size(), 1U);
  EXPECT_EQ(medium.GetRABsCommunicatingWith(run.Get("short").GetRABEquippedEntity()).size(), 0U);
}

TEST(Argos3Runs, GroundSensorsReadThePaintedFloor)
{
  Argos3Run run({.controllers = Coded("c", "", "<footbot_motor_ground/><footbot_base_ground/><positioning/>") +
                                Coded("e", "", "<ground/>"),
                 .arena = kFloor + Placed("foot-bot", "a", "0,0,0", "c") +
                          Placed("foot-bot", "turned", "1,0,0", "c", "90,0,0") + Placed("e-puck", "e", "-1,0,0", "e")},
                {.floor = BlackOnTheLeft});
  const auto black = [](const auto& readings)
  {
    std::string read;
    for (const auto& reading : readings) read += reading.Value == 0 ? "b" : reading.Value == 1 ? "w" : "?";
    return read;
  };
  run.Step("a",
           [&](CCI_Controller& robot)
           {
             const auto& motor = robot.GetSensor<CCI_FootBotMotorGroundSensor>("footbot_motor_ground")->GetReadings();
             EXPECT_EQ(black(motor), "bbww");
             EXPECT_LT(Distance(motor[1].Offset, CVector2(-6.3, 1.16)), kClose) << "cm";
             const auto& base = robot.GetSensor<CCI_FootBotBaseGroundSensor>("footbot_base_ground")->GetReadings();
             EXPECT_EQ(black(base).substr(1, 3), "bbb");
             EXPECT_EQ(black(base).substr(5, 3), "www");
             EXPECT_LT(Distance(base[1].Offset, CVector2(4.2, 6.5)), kClose);
             const auto& at = robot.GetSensor<CCI_PositioningSensor>("positioning")->GetReading();
             EXPECT_LT(Distance(at.Position, CVector3()), kClose);
             EXPECT_EQ(at.Orientation, CQuaternion());
           });
  run.Step(
      "turned",
      [&](CCI_Controller& robot)
      {
        EXPECT_EQ(black(robot.GetSensor<CCI_FootBotMotorGroundSensor>("footbot_motor_ground")->GetReadings()), "bwwb");
        EXPECT_LT(
            Distance(robot.GetSensor<CCI_PositioningSensor>("positioning")->GetReading().Position, CVector3(1, 0, 0)),
            kClose);
      });
  run.Step("e", [](CCI_Controller& robot)
           { EXPECT_THAT(robot.GetSensor<CCI_GroundSensor>("ground")->GetReadings(), ElementsAre(1, 1, 0)); });
  EXPECT_EQ(run.Space().GetFloorEntity().GetColorAtPoint(0, 1), CColor::BLACK);
  EXPECT_EQ(run.Space().GetFloorEntity().GetColorAtPoint(1, -1), CColor::WHITE);
  TheCode().floor = [](const CVector2&) { return CColor(100, 100, 100); };
  run.Step("a",
           [&](CCI_Controller& robot)
           {
             const auto& motor = robot.GetSensor<CCI_FootBotMotorGroundSensor>("footbot_motor_ground")->GetReadings();
             EXPECT_NEAR(motor[0].Value, 100 / 255.0, kClose) << "grey";
             const auto& base = robot.GetSensor<CCI_FootBotBaseGroundSensor>("footbot_base_ground")->GetReadings();
             EXPECT_EQ(black(base), "bbbbbbbb") << "black or white";
           });
}

TEST(Argos3Runs, NoiseOfGroundSensorsStaysBetweenBlackAndWhite)
{
  Argos3Run run(
      {.controllers = Coded("c", "", "<footbot_motor_ground noise_level='0.2'/><footbot_base_ground/>"),
       .arena = kFloor + Placed("foot-bot", "a", "0,0,0", "c")},
      {.floor = [](const CVector2& place) { return place.GetX() > 0 ? CColor::BLACK : CColor(127, 127, 127); }});
  double least = 1, most = 0, darkest = 1, lightest = 0;
  TheCode().steps["a"] = [&](CCI_Controller& robot)
  {
    const auto& motor = robot.GetSensor<CCI_FootBotMotorGroundSensor>("footbot_motor_ground")->GetReadings();
    darkest = std::min(darkest, motor[0].Value);
    lightest = std::max(lightest, motor[0].Value);
    least = std::min(least, motor[1].Value);
    most = std::max(most, motor[1].Value);
  };
  run.Step(100);
  EXPECT_EQ(darkest, 0);
  EXPECT_NEAR(lightest, 0.2, 0.02);
  EXPECT_LE(lightest, 0.2);
  EXPECT_NEAR(least, 127 / 255.0 - 0.2, 0.02);
  EXPECT_NEAR(most, 127 / 255.0 + 0.2, 0.02);
}

TEST(Argos3Runs, ATurretTurnsBySpeedAndToAnAngle)
{
  Argos3Run run({.controllers = Coded("c", "<footbot_turret/>", "<footbot_turret_encoder/>"),
                 .arena = Placed("foot-bot", "a", "0,0,0", "c")});
  double angle = -1;
  const auto read = [&](CCI_Controller& robot)
  { angle = robot.GetSensor<CCI_FootBotTurretEncoderSensor>("footbot_turret_encoder")->GetRotation().GetValue(); };
  run.Step("a",
           [&](CCI_Controller& robot)
           {
             read(robot);
             auto* turret = robot.GetActuator<CCI_FootBotTurretActuator>("footbot_turret");
             turret->SetRotationSpeed(6);
           });
  EXPECT_EQ(angle, 0);
  run.Step("a",
           [&](CCI_Controller& robot)
           {
             read(robot);
             robot.GetActuator<CCI_FootBotTurretActuator>("footbot_turret")->SetSpeedControlMode();
           });
  EXPECT_EQ(angle, 0) << "it was off";
  run.Step();
  run.Step("a", read);
  // Six turns a minute, for two ticks.
  EXPECT_NEAR(angle, 0.2 * 6 * 2 * std::numbers::pi / 60, kClose);
  run.Step("a", [](CCI_Controller& robot)
           { robot.GetActuator<CCI_FootBotTurretActuator>("footbot_turret")->SetPassiveMode(); });
  run.Step("a", read);
  const double still = angle;
  run.Step("a", read);
  EXPECT_EQ(angle, still);
  run.Simulator().Reset();
  run.Step("a", read);
  EXPECT_EQ(angle, 0);
  run.Step("a", read);
  EXPECT_EQ(angle, 0);
  // By the gains of ARGoS3: 0.4 of the rest of the angle, and 0.2 of its change.
  run.Step("a", [](CCI_Controller& robot)
           { robot.GetActuator<CCI_FootBotTurretActuator>("footbot_turret")->SetActiveWithRotation(CRadians(-0.5)); });
  double expected = 0, before = -0.5;
  for (int step = 0; step < 8; ++step)
  {
    const double rest = -0.5 - expected;
    expected += 0.1 * (0.4 * rest + 0.2 * (rest - before) / 0.1);
    before = rest;
    run.Step("a", read);
    EXPECT_NEAR(angle, expected, 1e-5) << step;
  }
}

TEST(Argos3Runs, ATurretLooksAheadAfterAResetInEachEngine)
{
  for (const char* engine : {"dummy_engine", "dynamics2d", "dynamics3d"})
  {
    Argos3Run run({.controllers = Coded("c", "<footbot_turret/>", "<footbot_turret_encoder/>"),
                   .arena = Placed("foot-bot", "a", "0,0,0", "c"),
                   .engines = "<" + std::string(engine) + " id='d'/>"});
    double angle = 0;
    const auto read = [&](CCI_Controller& robot)
    { angle = robot.GetSensor<CCI_FootBotTurretEncoderSensor>("footbot_turret_encoder")->GetRotation().GetValue(); };
    run.Step("a",
             [](CCI_Controller& robot)
             {
               auto* turret = robot.GetActuator<CCI_FootBotTurretActuator>("footbot_turret");
               turret->SetSpeedControlMode();
               turret->SetRotationSpeed(6);
             });
    run.Step(3);
    run.Step("a", read);
    EXPECT_GT(angle, 0.1) << engine;
    run.Simulator().Reset();
    for (int step = 0; step < 3; ++step)
    {
      run.Step("a", read);
      EXPECT_NEAR(angle, 0, 1e-9) << engine << " " << step;
    }
  }
}

TEST(Argos3Runs, TheDistanceScannerMeasuresAlongItsBeams)
{
  Argos3Run run({.controllers = Coded("c", "<footbot_distance_scanner/>", "<footbot_distance_scanner/>"),
                 .arena = Placed("foot-bot", "a", "0,0,0", "c") +
                          Placed("box", "ahead", "0.285036758,0,0", "", "0,0,0", "size='0.1,1,0.5' movable='false'") +
                          Placed("box", "left", "0,0.635036758,0", "", "0,0,0", "size='1,0.1,0.5' movable='false'")});
  using Head = CCI_FootBotDistanceScannerActuator;
  using Scanner = CCI_FootBotDistanceScannerSensor;
  const char* const tag = "footbot_distance_scanner";
  run.Step("a",
           [&](CCI_Controller& robot)
           {
             EXPECT_TRUE(robot.GetSensor<Scanner>(tag)->GetReadingsMap().empty()) << "it is off";
             robot.GetActuator<Head>(tag)->SetAngle(CRadians(0));
           });
  run.Step();
  run.Step("a",
           [&](CCI_Controller& robot)
           {
             const auto* scanner = robot.GetSensor<Scanner>(tag);
             EXPECT_EQ(scanner->GetReadingsMap().size(), 4U);
             ASSERT_EQ(scanner->GetShortReadingsMap().size(), 2U);
             ASSERT_EQ(scanner->GetLongReadingsMap().size(), 2U);
             double nearest = 0;
             for (const auto& [angle, distance] : scanner->GetShortReadingsMap())
               if (std::abs(angle.GetValue()) < 1e-6)
                 nearest = distance;
               else
                 EXPECT_EQ(distance, -2) << "nothing behind";
             EXPECT_NEAR(nearest, 15, 1e-4);
             EXPECT_NEAR(scanner->GetLongReadingsMap().rbegin()->second, 50, 1e-4) << "to the left";
             EXPECT_EQ(scanner->GetLongReadingsMap().begin()->second, -2) << "to the right";
             robot.GetActuator<Head>(tag)->SetRPM(15);
           });
  run.Step();
  run.Step("a",
           [&](CCI_Controller& robot)
           {
             // A quarter turn a second.
             const auto& readings = robot.GetSensor<Scanner>(tag)->GetReadingsMap();
             ASSERT_GT(readings.size(), 4U);
             robot.GetActuator<Head>(tag)->Disable();
           });
  run.Step();
  run.Step("a", [&](CCI_Controller& robot) { EXPECT_TRUE(robot.GetSensor<Scanner>(tag)->GetReadingsMap().empty()); });
  run.Step("a", [&](CCI_Controller& robot) { robot.GetActuator<Head>(tag)->SetAngle(CRadians::PI_OVER_TWO); });
  run.Step("a", [&](CCI_Controller& robot) { robot.GetActuator<Head>(tag)->Disable(); });
  run.Step("a", [&](CCI_Controller& robot) { robot.GetActuator<Head>(tag)->Enable(); });
  run.Step();
  run.Step("a",
           [&](CCI_Controller& robot)
           {
             // The last angle: the long beams look ahead and back.
             bool is_ahead = false;
             for (const auto& [angle, distance] : robot.GetSensor<Scanner>(tag)->GetLongReadingsMap())
               if (std::abs(angle.GetValue()) < 1e-6) is_ahead = std::abs(distance - 15) < 1e-4;
             EXPECT_TRUE(is_ahead);
           });
}

TEST(Argos3Runs, RingsOfAFootBotHaveTheirAngles)
{
  Argos3Run run({.controllers = Coded("c", "", "<footbot_proximity/><footbot_light/>"),
                 .arena = Placed("foot-bot", "a", "0,0,0", "c") +
                          Placed("box", "left", "0,0.19,0", "", "0,0,0", "size='1,0.1,0.5' movable='false'")});
  run.Step("a",
           [](CCI_Controller& robot)
           {
             const auto& near = robot.GetSensor<argos::CCI_FootBotProximitySensor>("footbot_proximity")->GetReadings();
             const auto& light = robot.GetSensor<CCI_FootBotLightSensor>("footbot_light")->GetReadings();
             ASSERT_EQ(near.size(), 24U);
             ASSERT_EQ(light.size(), 24U);
             for (std::size_t i = 0; i < 24; ++i)
             {
               const double degrees = 7.5 + 15 * static_cast<double>(i) - (i < 12 ? 0 : 360);
               EXPECT_NEAR(ToDegrees(near[i].Angle).GetValue(), degrees, 1e-9);
               EXPECT_NEAR(ToDegrees(light[i].Angle).GetValue(), degrees, 1e-9);
               EXPECT_EQ(light[i].Value, 0) << "there is no light";
               EXPECT_EQ(near[i].Value > 0, i >= 3 && i <= 8) << i << " " << near[i].Value;
             }
             EXPECT_DOUBLE_EQ(near[5].Value, near[6].Value) << "both beside the left";
             EXPECT_GT(near[5].Value, near[4].Value);
           });
}

TEST(Argos3Runs, EPucksSenseAsThoseOfArgos3)
{
  Argos3Run run({.controllers = Coded("c", "<differential_steering/><leds medium='leds'/>",
                                      "<proximity/><epuck_proximity/><differential_steering/><light/>"),
                 .arena = Placed("box", "wall", "0.115,0,0", "", "0,0,0", "size='0.1,1,0.5' movable='false'") +
                          Placed("e-puck", "e", "0,0,0", "c") +
                          "<light id='lamp' position='0,1,0.5' orientation='0,0,0' color='yellow' intensity='0.5'/>"});
  const auto distance = [](double degrees)
  {
    const double cosine = std::cos(degrees * std::numbers::pi / 180);
    return (0.065 - 0.035 * cosine) / cosine;
  };
  run.Step("e",
           [&](CCI_Controller& robot)
           {
             const auto& near = robot.GetSensor<CCI_ProximitySensor>("proximity")->GetReadings();
             const auto& own = robot.GetSensor<CCI_EPuckProximitySensor>("epuck_proximity")->GetReadings();
             ASSERT_EQ(near.size(), 8U);
             ASSERT_EQ(own.size(), 8U);
             const double angles[] = {17, 50, 90, 150, -150, -90, -50, -17};
             for (std::size_t i = 0; i < 8; ++i)
             {
               const double away = std::abs(angles[i]) < 60 ? distance(angles[i]) : 1;
               EXPECT_NEAR(near[i], away < 1 ? std::exp(-away) : 0, 1e-5) << i;
               const double response = 298.701 * away * away - 36.8961 * away + 1.08212;
               EXPECT_NEAR(own[i].Value, away < 0.05 ? response : 0, 1e-5) << i;
               EXPECT_NEAR(ToDegrees(own[i].Angle).GetValue(), angles[i], 1e-9);
             }
             const auto& light = robot.GetSensor<CCI_LightSensor>("light")->GetReadings();
             ASSERT_EQ(light.size(), 8U);
             for (std::size_t i = 0; i < 8; ++i)
             {
               const double at = (22.5 + 45 * static_cast<double>(i)) * std::numbers::pi / 180;
               const CVector3 to_lamp(-0.035 * std::cos(at), 1 - 0.035 * std::sin(at), 0.44);
               const bool faces = to_lamp.GetX() * std::cos(at) + to_lamp.GetY() * std::sin(at) > 0;
               EXPECT_NEAR(light[i], faces ? 0.25 / to_lamp.SquareLength() : 0, 1e-5) << i;
             }
             robot.GetActuator<CCI_DifferentialSteeringActuator>("differential_steering")->SetLinearVelocity(2, -3);
             auto* leds = robot.GetActuator<CCI_LEDsActuator>("leds");
             EXPECT_EQ(leds->GetNumLEDs(), 8U);
             leds->SetSingleColor(5, CColor::RED);
           });
  EXPECT_EQ(run.Get("e").GetLEDEquippedEntity().GetLED(5).GetColor(), CColor::RED);
  EXPECT_EQ(run.Get("e").GetLEDEquippedEntity().GetLED(4).GetColor(), CColor::BLACK);
  run.Step("e",
           [](CCI_Controller& robot)
           {
             const auto& rolled =
                 robot.GetSensor<CCI_DifferentialSteeringSensor>("differential_steering")->GetReading();
             EXPECT_NEAR(rolled.VelocityLeftWheel, 2, kClose);
             EXPECT_NEAR(rolled.VelocityRightWheel, -3, kClose);
             EXPECT_NEAR(rolled.CoveredDistanceLeftWheel, 0.2, kClose);
             EXPECT_NEAR(rolled.CoveredDistanceRightWheel, -0.3, kClose);
             EXPECT_NEAR(rolled.WheelAxisLength, 5.3, kClose);
           });
  EXPECT_NEAR(HeadingOf(run, "e"), -0.005 / 0.053, 1e-4);
  run.Simulator().Reset();
  EXPECT_EQ(run.Get<CEPuckEntity>("e").GetWheeledEntity().GetWheelVelocity(1), 0);
  EXPECT_EQ(run.Get("e").GetLEDEquippedEntity().GetLED(5).GetColor(), CColor::BLACK);
}

TEST(Argos3Runs, WheelsOfAnEPuckHaveBiasAndFactor)
{
  Argos3Run run(
      {.controllers = Coded("c", "<differential_steering bias_avg='0.01' factor_avg_left='1.1' factor_avg_right='2'/>",
                            "<differential_steering/>"),
       .arena = Placed("e-puck", "e", "0,0,0", "c")});
  const auto& wheels = run.Get<CEPuckEntity>("e").GetWheeledEntity();
  run.Step("e", [](CCI_Controller& robot)
           { robot.GetActuator<CCI_DifferentialSteeringActuator>("differential_steering")->SetLinearVelocity(5, 0); });
  // (5 + 1) 1.1 cm/s, and (0 + 1) 2 cm/s.
  EXPECT_NEAR(wheels.GetWheelVelocity(0), 0.066, kClose);
  EXPECT_NEAR(wheels.GetWheelVelocity(1), 0.02, kClose);
  run.Step("e", [](CCI_Controller& robot)
           { robot.GetActuator<CCI_DifferentialSteeringActuator>("differential_steering")->SetLinearVelocity(0, 0); });
  EXPECT_EQ(wheels.GetWheelVelocity(0), 0) << "wheels that shall stand have no noise";
  EXPECT_EQ(wheels.GetWheelVelocity(1), 0);
}

TEST(Argos3Runs, EyeBotsFlyToPlacesAndAtSpeeds)
{
  Argos3Run run({.controllers = Coded("p", "<quadrotor_position/><leds medium='leds'/>",
                                      "<positioning/><eyebot_proximity/><eyebot_light/>") +
                                Coded("s", "<quadrotor_speed/>", "<positioning/>"),
                 .arena = Placed("eye-bot", "p", "0,0,1", "p", "90,0,0") +
                          Placed("eye-bot", "s", "0,-3,1", "s", "90,0,0") +
                          Placed("eye-bot", "r", "3,0,1", "p", "90,0,0"),
                 .engines = kSpace});
  const auto at = [&](const std::string& id, const CVector3& place, double heading)
  {
    EXPECT_LT(Distance(run.PlaceOf(id), place), 0.02) << id << " " << run.PlaceOf(id);
    EXPECT_NEAR(std::remainder(HeadingOf(run, id) - heading, 2 * std::numbers::pi), 0, 0.05) << id;
  };
  const double quarter = std::numbers::pi / 2;
  run.Step(3);
  at("p", CVector3(0, 0, 1), quarter);
  run.Step("p",
           [](CCI_Controller& robot)
           {
             robot.GetActuator<CCI_QuadRotorPositionActuator>("quadrotor_position")
                 ->SetAbsolutePosition(CVector3(0.5, 0, 1.5));
             auto* leds = robot.GetActuator<CCI_LEDsActuator>("leds");
             EXPECT_EQ(leds->GetNumLEDs(), 16U);
             leds->SetSingleColor(15, CColor::RED);
             EXPECT_EQ(robot.GetSensor<CCI_EyeBotProximitySensor>("eyebot_proximity")->GetReadings().size(), 24U);
             EXPECT_NEAR(
                 ToDegrees(robot.GetSensor<CCI_EyeBotLightSensor>("eyebot_light")->GetReadings()[23].Angle).GetValue(),
                 -7.5, 1e-9);
           });
  EXPECT_EQ(run.Get("p").GetLEDEquippedEntity().GetLED(15).GetColor(), CColor::RED);
  TheCode().steps["s"] = [](CCI_Controller& robot)
  {
    auto* speed = robot.GetActuator<CCI_QuadRotorSpeedActuator>("quadrotor_speed");
    speed->SetLinearVelocity(CVector3(0.1, 0, 0.05));
  };
  run.Step("r",
           [](CCI_Controller& robot)
           {
             robot.GetActuator<CCI_QuadRotorPositionActuator>("quadrotor_position")
                 ->SetRelativePosition(CVector3(0.4, 0.2, 0.1));
           });
  run.Step(100);
  at("p", CVector3(0.5, 0, 1.5), quarter);
  at("r", CVector3(2.8, 0.4, 1.1), quarter);
  const CVector3 before = run.PlaceOf("s");
  run.Step(10);
  EXPECT_LT(Distance(run.PlaceOf("s") - before, CVector3(0, 0.1, 0.05)), 0.01) << "ahead is along y";
  TheCode().steps.erase("s");
  run.Step("p", [](CCI_Controller& robot)
           { robot.GetActuator<CCI_QuadRotorPositionActuator>("quadrotor_position")->SetAbsoluteYaw(CRadians(0)); });
  run.Step("r", [](CCI_Controller& robot)
           { robot.GetActuator<CCI_QuadRotorPositionActuator>("quadrotor_position")->SetRelativeYaw(CRadians(0.5)); });
  run.Step("s",
           [](CCI_Controller& robot)
           {
             auto* speed = robot.GetActuator<CCI_QuadRotorSpeedActuator>("quadrotor_speed");
             speed->SetLinearVelocity(CVector3());
             speed->SetRotationalSpeed(CRadians(0.2));
           });
  run.Step(60);
  at("p", CVector3(0.5, 0, 1.5), 0);
  at("r", CVector3(2.8, 0.4, 1.1), quarter + 0.5);
  const double heading = HeadingOf(run, "s");
  run.Step(10);
  EXPECT_NEAR(HeadingOf(run, "s") - heading, 0.2, 0.02);
  run.Simulator().Reset();
  run.Step(20);
  at("p", CVector3(0, 0, 1), quarter);
  at("s", CVector3(0, -3, 1), quarter);
}

TEST(Argos3Runs, AYawAloneKeepsThePlace)
{
  Argos3Run run({.controllers = Coded("p", "<quadrotor_position/>", "<positioning/>"),
                 .arena = Placed("eye-bot", "a", "1,1,1", "p") + Placed("eye-bot", "b", "-1,1,1", "p"),
                 .engines = kSpace});
  run.Step("a", [](CCI_Controller& robot)
           { robot.GetActuator<CCI_QuadRotorPositionActuator>("quadrotor_position")->SetAbsoluteYaw(CRadians(1)); });
  run.Step("b", [](CCI_Controller& robot)
           { robot.GetActuator<CCI_QuadRotorPositionActuator>("quadrotor_position")->SetRelativeYaw(CRadians(-1)); });
  run.Step(80);
  EXPECT_LT(Distance(run.PlaceOf("a"), CVector3(1, 1, 1)), 0.02);
  EXPECT_LT(Distance(run.PlaceOf("b"), CVector3(-1, 1, 1)), 0.02);
  EXPECT_NEAR(HeadingOf(run, "a"), 1, 0.05);
  EXPECT_NEAR(HeadingOf(run, "b"), -1, 0.05);
}

TEST(Argos3Runs, EyeBotsSeeWallsByTheirResponse)
{
  Argos3Run run({.controllers = Coded("p", "", "<eyebot_proximity/>"),
                 .arena = Placed("eye-bot", "e", "0,0,1", "p") +
                          Placed("box", "wall", "1,0,0", "", "0,0,0", "size='1,4,2' movable='false'"),
                 .engines = kSpace});
  run.Step("e",
           [&](CCI_Controller& robot)
           {
             const auto& near = robot.GetSensor<CCI_EyeBotProximitySensor>("eyebot_proximity")->GetReadings();
             auto& sensors = run.Get<CEyeBotEntity>("e").GetProximitySensorEquippedEntity();
             ASSERT_EQ(near.size(), 24U);
             int seen = 0;
             for (std::size_t i = 0; i < 24; ++i)
             {
               const auto& sensor = sensors.GetSensor(i);
               const double cosine = sensor.Direction.GetX() / sensor.Direction.Length();
               const double distance = (0.5 - sensor.Offset.GetX()) / cosine;
               const bool sees = cosine > 0 && distance < sensor.Direction.Length();
               seen += sees ? 1 : 0;
               EXPECT_NEAR(near[i].Value, sees ? 0.0100527 / (distance + 0.000163144) : 0, 1e-5) << i;
             }
             EXPECT_GT(seen, 2);
           });
}

TEST(Argos3Runs, PerspectiveCamerasTellPixels)
{
  Argos3Run run({.controllers = Coded("f", "", "<colored_blob_perspective_camera medium='leds'/>") +
                                Coded("e", "", "<colored_blob_perspective_camera medium='leds'/>"),
                 .arena = Placed("foot-bot", "fb", "0,0,0", "f", "90,0,0") + Placed("eye-bot", "eb", "2,0,1.5", "e") +
                          "<light id='ahead' position='-0.1,1.085036758,0.374' orientation='0,0,0' color='red' "
                          "intensity='1' medium='leds'/><light id='far' position='0,2.5,0.174' orientation='0,0,0' "
                          "color='blue' intensity='1' medium='leds'/><light id='below' position='2.2,0.1,0.5' "
                          "orientation='0,0,0' color='green' intensity='1' medium='leds'/>",
                 .size = "6,6,4",
                 .engines = "<dummy_engine id='d'/><pointmass3d id='p'/>"});
  using Camera = CCI_ColoredBlobPerspectiveCameraSensor;
  const char* const tag = "colored_blob_perspective_camera";
  for (const char* id : {"fb", "eb"})
    run.Step(id,
             [&](CCI_Controller& robot)
             {
               EXPECT_TRUE(robot.GetSensor<Camera>(tag)->GetReadings().BlobList.empty());
               EXPECT_EQ(robot.GetSensor<Camera>(tag)->GetReadings().Counter, 0U);
               robot.GetSensor<Camera>(tag)->Enable();
             });
  // 480 pixels are as high as the image, which is 2 tan(30 degrees) / sqrt(1 + (4 / 3)^2) at a distance of 1 m.
  const double pixels = 480 / (2 * std::tan(std::numbers::pi / 6) / std::hypot(1, 4. / 3));
  for (const auto& [id, colour] : {std::pair("fb", CColor::RED), std::pair("eb", CColor::GREEN)})
    run.Step(id,
             [&, colour = colour](CCI_Controller& robot)
             {
               const auto& seen = robot.GetSensor<Camera>(tag)->GetReadings();
               EXPECT_GE(seen.Counter, 1U);
               ASSERT_EQ(seen.BlobList.size(), 1U);
               EXPECT_EQ(seen.BlobList[0]->Color, colour);
               EXPECT_EQ(seen.BlobList[0]->X, static_cast<int>(320 - 0.1 * pixels));
               EXPECT_EQ(seen.BlobList[0]->Y, static_cast<int>(240 - 0.2 * pixels));
             });
}

TEST(Argos3Runs, BatteriesDischargeAndAreCharged)
{
  Argos3Run run({.controllers = Coded("c", "", "<battery/>") + Coded("n", "", ""),
                 .arena = Placed("foot-bot", "a", "0,0,0", "c", "0,0,0", "",
                                 "<battery discharge_model='time' delta='0.01' start_charge='1.5' full_charge='2'/>") +
                          Placed("foot-bot", "none", "0,1,0", "n")});
  auto& battery = run.Get("a").GetBatterySensorEquippedEntity();
  EXPECT_EQ(battery.GetFullCharge(), 2);
  double charge = 0, left = 0;
  const auto read = [&](CCI_Controller& robot)
  {
    charge = robot.GetSensor<CCI_BatterySensor>("battery")->GetReading().AvailableCharge;
    left = robot.GetSensor<CCI_BatterySensor>("battery")->GetReading().TimeLeft;
  };
  TheCode().steps["a"] = read;
  run.Step(10);
  const double start = charge;
  EXPECT_NEAR(start, 0.75 - 10 * 0.01 / 2, 0.0051);
  run.Step(10);
  EXPECT_NEAR(charge, start - 10 * 0.01 / 2, 1e-4) << "parts of the full charge";
  EXPECT_NEAR(left, 0.1 * (charge + 0.005) / 0.005, 0.01) << "s";
  EXPECT_NEAR(battery.GetAvailableCharge(), 2 * charge, 1e-9);
  battery.SetAvailableCharge(2);
  run.Step();
  EXPECT_NEAR(charge, 1 - 0.005, 1e-4);
  run.Simulator().Reset();
  EXPECT_EQ(battery.GetAvailableCharge(), 1.5);
  run.Step();
  EXPECT_NEAR(charge, 0.75, 0.0051);
  EXPECT_THROW(run.Get("none").GetBatterySensorEquippedEntity().GetFullCharge(), CARGoSException);
  EXPECT_THROW(run.Get("none").GetBatterySensorEquippedEntity().SetAvailableCharge(1), CARGoSException);
}

TEST(Argos3Runs, LoopFunctionsMoveBodiesWhereThereIsRoom)
{
  Argos3Run run(
      {.controllers = Coded("c", "", ""),
       .arena =
           Placed("foot-bot", "a", "0,0,0", "c") +
           Placed("box", "wall", "1,0,0", "", "90,0,0", "size='0.4,0.2,0.3' movable='false'") +
           Placed("box", "crate", "-1,0,0", "", "0,0,0", "size='0.2,0.2,0.6' movable='true' mass='1'") +
           Placed("cylinder", "can", "0,2,0", "", "0,0,0", "radius='0.1' height='0.2' movable='true' mass='3'") +
           "<light id='lamp' position='0,-1,0.5' orientation='0,0,0' color='yellow' intensity='0.5' medium='leds'/>"});
  auto& robot = run.Get("a").GetEmbodiedEntity();
  auto& wall = run.Get<CBoxEntity>("wall");
  auto& crate = run.Get<CBoxEntity>("crate");
  auto& can = run.Get<CCylinderEntity>("can");
  EXPECT_EQ(wall.GetSize(), CVector3(0.4, 0.2, 0.3));
  EXPECT_FALSE(wall.GetEmbodiedEntity().IsMovable());
  EXPECT_EQ(crate.GetMass(), 1);
  EXPECT_TRUE(crate.GetEmbodiedEntity().IsMovable());
  EXPECT_EQ(can.GetRadius() * 100 + can.GetHeight() * 10 + can.GetMass(), 15);
  // The position of a box is the middle of its base.
  EXPECT_LT(Distance(crate.GetEmbodiedEntity().GetPosition(), CVector3(-1, 0, 0)), kClose);
  EXPECT_LT(Distance(wall.GetEmbodiedEntity().GetPosition(), CVector3(1, 0, 0)), kClose);
  const auto expect_box = [](const CEmbodiedEntity& body, const CVector3& low, const CVector3& high)
  {
    EXPECT_LT(Distance(body.GetBoundingBox().MinCorner, low), 1e-4) << body.GetBoundingBox().MinCorner;
    EXPECT_LT(Distance(body.GetBoundingBox().MaxCorner, high), 1e-4) << body.GetBoundingBox().MaxCorner;
  };
  expect_box(wall.GetEmbodiedEntity(), CVector3(0.9, -0.2, 0), CVector3(1.1, 0.2, 0.3));
  expect_box(crate.GetEmbodiedEntity(), CVector3(-1.1, -0.1, 0), CVector3(-0.9, 0.1, 0.6));
  expect_box(can.GetEmbodiedEntity(), CVector3(-0.1, 1.9, 0), CVector3(0.1, 2.1, 0.2));
  expect_box(robot, CVector3(-kFootBotRadius, -kFootBotRadius, 0),
             CVector3(kFootBotRadius, kFootBotRadius, 0.146899733));
  EXPECT_EQ(&robot.GetPhysicsModel(0).GetBoundingBox(), &robot.GetBoundingBox());

  CLoopFunctions& functions = run.Functions();
  EXPECT_FALSE(robot.IsCollidingWithSomething());
  EXPECT_FALSE(functions.MoveEntity(robot, CVector3(1, 0, 0), CQuaternion())) << "the wall is there";
  EXPECT_EQ(robot.GetPosition(), CVector3());
  EXPECT_TRUE(functions.MoveEntity(robot, CVector3(0.5, 0, 0), CQuaternion(), true)) << "there is room";
  EXPECT_EQ(robot.GetPosition(), CVector3()) << "it was asked alone";
  EXPECT_FALSE(functions.MoveEntity(robot, CVector3(1, 0, 0), CQuaternion(), true));
  EXPECT_TRUE(functions.MoveEntity(robot, CVector3(0.5, 0, 0), CQuaternion(CRadians(1), CVector3::Z)));
  EXPECT_EQ(robot.GetPosition(), CVector3(0.5, 0, 0));
  EXPECT_TRUE(functions.MoveEntity(robot, CVector3(1, 0, 0), CQuaternion(), false, true)) << "whatever is there";
  EXPECT_TRUE(robot.IsCollidingWithSomething());
  EXPECT_TRUE(robot.GetPhysicsModel(0).IsCollidingWithSomething());
  EXPECT_TRUE(robot.MoveTo(CVector3(0, 0.5, 0), CQuaternion()));
  run.Step();
  EXPECT_LT(Distance(run.PlaceOf("a"), CVector3(0, 0.5, 0)), kClose);
  EXPECT_THROW(functions.MoveEntity(wall.GetEmbodiedEntity(), CVector3(2, 2, 0), CQuaternion()), CARGoSException);
  // A box that is moved has its base there.
  EXPECT_TRUE(functions.MoveEntity(crate.GetEmbodiedEntity(), CVector3(-2, 1, 0), CQuaternion()));
  expect_box(crate.GetEmbodiedEntity(), CVector3(-2.1, 0.9, 0), CVector3(-1.9, 1.1, 0.6));
  run.Step();
  EXPECT_LT(Distance(run.PlaceOf("crate"), CVector3(-2, 1, 0)), kClose);
  auto& lamp = run.Get<CLightEntity>("lamp");
  EXPECT_EQ(lamp.GetColor(), CColor::YELLOW);
  EXPECT_EQ(lamp.GetIntensity(), 0.5);
  EXPECT_LT(Distance(lamp.GetPosition(), CVector3(0, -1, 0.5)), kClose);
  lamp.SetColor(CColor::RED);
  lamp.SetIntensity(2);
  EXPECT_EQ(lamp.GetColor(), CColor::RED);
  EXPECT_EQ(lamp.GetIntensity(), 2);
  EXPECT_ANY_THROW(functions.MoveEntity(lamp, CVector3(1, -1, 0.5), CQuaternion())) << "lights stand still";
  // All is as it was after a reset.
  run.Simulator().Reset();
  EXPECT_LT(Distance(run.PlaceOf("a"), CVector3()), kClose);
  EXPECT_LT(Distance(run.PlaceOf("crate"), CVector3(-1, 0, 0)), kClose);
  EXPECT_LT(Distance(lamp.GetPosition(), CVector3(0, -1, 0.5)), kClose);
  EXPECT_EQ(lamp.GetColor(), CColor::YELLOW);
}

TEST(Argos3Runs, RaysMeetBodiesInTheirOrder)
{
  Argos3Run run(
      {.controllers = Coded("c", "", ""),
       .arena = Placed("foot-bot", "a", "0,0,0", "c") +
                Placed("box", "wall", "1,0,0", "", "0,0,0", "size='0.2,1,0.5' movable='false'") +
                Placed("cylinder", "can", "-1,0,0", "", "0,0,0", "radius='0.1' height='0.2' movable='true' mass='3'")});
  run.Step();
  TEmbodiedEntityIntersectionData met(3);
  const CRay3 ray(CVector3(-2, 0, 0.05), CVector3(2, 0, 0.05));
  ASSERT_TRUE(GetEmbodiedEntitiesIntersectedByRay(met, ray));
  ASSERT_EQ(met.size(), 3U);
  const std::pair<std::string, double> expected[] = {{"can", -1.1}, {"a", -kFootBotRadius}, {"wall", 0.9}};
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_EQ(met[i].IntersectedEntity->GetRootEntity().GetId(), expected[i].first);
    EXPECT_NEAR(-2 + 4 * met[i].TOnRay, expected[i].second, 1e-4);
  }
  SEmbodiedEntityIntersectionItem nearest;
  EXPECT_TRUE(GetClosestEmbodiedEntityIntersectedByRay(nearest, ray));
  EXPECT_EQ(nearest.IntersectedEntity->GetRootEntity().GetId(), "can");
  EXPECT_TRUE(GetClosestEmbodiedEntityIntersectedByRay(nearest, ray, *nearest.IntersectedEntity));
  EXPECT_EQ(nearest.IntersectedEntity->GetRootEntity().GetId(), "a");
  const CRay3 above(CVector3(-2, 0, 0.9), CVector3(2, 0, 0.9));
  EXPECT_FALSE(GetClosestEmbodiedEntityIntersectedByRay(nearest, above));
  EXPECT_EQ(nearest.IntersectedEntity, nullptr);
  EXPECT_EQ(nearest.TOnRay, 1);
  EXPECT_FALSE(GetEmbodiedEntitiesIntersectedByRay(met, above));
  EXPECT_TRUE(met.empty());
}

TEST(Argos3Runs, EntitiesLeaveAndComeBack)
{
  Argos3Run run(
      {.controllers = Coded("c", "<differential_steering/>", ""),
       .arena = Placed("foot-bot", "a", "0,0,0", "c") + Placed("foot-bot", "b", "1,0,0", "c") +
                Placed("cylinder", "can", "-1,0,0", "", "0,0,0", "radius='0.1' height='0.2' movable='true' mass='3'")});
  CLoopFunctions& functions = run.Functions();
  EXPECT_EQ(run.Space().GetNumberEntities(), 3U);
  functions.RemoveEntity(run.Get("b"));
  functions.RemoveEntity("can");
  run.Step();
  EXPECT_EQ(run.Space().GetNumberEntities(), 1U);
  EXPECT_THROW(run.Space().GetEntity("b"), CARGoSException);
  EXPECT_THROW(functions.RemoveEntity("can"), CARGoSException) << "it is not there";
  EXPECT_THROW(functions.RemoveEntity("none"), CARGoSException);
  auto* back = new CCylinderEntity("can", CVector3(2, 1, 0), CQuaternion(), true, 0.1, 0.2, 3);
  functions.AddEntity(*back);
  EXPECT_EQ(&run.Space().GetEntity("can"), back);
  run.Step();
  EXPECT_EQ(&run.Space().GetEntity("can"), back);
  EXPECT_LT(Distance(run.PlaceOf("can"), CVector3(2, 1, 0)), kClose);
  EXPECT_EQ(run.Space().GetNumberEntities(), 2U);
  // A body that is added where another one stands is pushed away.
  auto* robot = new CFootBotEntity("b", "c", CVector3(0.05, 0, 0));
  functions.AddEntity(*robot);
  EXPECT_TRUE(robot->GetEmbodiedEntity().IsCollidingWithSomething());
  EXPECT_THROW(functions.AddEntity(*new CBoxEntity("new", CVector3(), CQuaternion(), true, CVector3(1, 1, 1))),
               CARGoSException)
      << "no box of this size is kept";
  EXPECT_THROW(functions.AddEntity(*new CLightEntity("new", CVector3(), CColor::RED, 1)), CARGoSException);
  EXPECT_THROW(functions.AddEntity(*new CFootBotEntity("new", "c")), CARGoSException);
  EXPECT_THROW(functions.AddEntity(*new CEntity(nullptr, "new")), CARGoSException);
}

TEST(Argos3Runs, DisabledRobotsMakeNoControlSteps)
{
  Argos3Run run({.controllers = Coded("c", "<differential_steering/>", ""),
                 .arena = Placed("foot-bot", "a", "0,0,0", "c") + Placed("foot-bot", "b", "0,1,0", "c")});
  int steps = 0;
  TheCode().steps["a"] = [&](CCI_Controller& robot)
  {
    ++steps;
    robot.GetActuator<CCI_DifferentialSteeringActuator>("differential_steering")->SetLinearVelocity(10, 10);
  };
  run.Step(2);
  run.Get("a").Disable();
  EXPECT_FALSE(run.Get("a").GetControllableEntity().IsEnabled());
  run.Step(3);
  EXPECT_EQ(steps, 2);
  EXPECT_NEAR(run.PlaceOf("a").GetX(), 0.04, kClose) << "its wheels keep their speed";
  run.Get("a").Enable();
  run.Step();
  EXPECT_EQ(steps, 3);
  CCI_Controller& controller = run.Get("a").GetControllableEntity().GetController();
  EXPECT_EQ(controller.GetId(), "a");
  EXPECT_EQ(&controller, &run.Get("a").GetControllableEntity().GetController());
  EXPECT_NE(&controller, &run.Get("b").GetControllableEntity().GetController());
}

TEST(Argos3Runs, LedsOfBoxesHaveOneColour)
{
  const std::string leds = "<leds medium='leds'><led offset='0,0,0.2' anchor='origin' color='red'/></leds>";
  Argos3Run run(
      {.controllers = Coded("c", "", "<colored_blob_omnidirectional_camera medium='leds'/>"),
       .arena = Placed("foot-bot", "a", "0,0,0", "c") +
                Placed("box", "lit", "0.4,0,0", "", "0,0,0", "size='0.1,0.1,0.1' movable='true' mass='1'", leds)});
  auto& box = run.Get<CBoxEntity>("lit");
  ASSERT_EQ(box.GetLEDEquippedEntity().GetNumLEDs(), 1U);
  EXPECT_EQ(box.GetLEDEquippedEntity().GetLED(0).GetColor(), CColor::RED);
  box.GetLEDEquippedEntity().SetAllLEDsColors(CColor::BLUE);
  EXPECT_EQ(box.GetLEDEquippedEntity().GetLED(0).GetColor(), CColor::BLUE);
  box.DisableLEDs();
  EXPECT_EQ(box.GetLEDEquippedEntity().GetLED(0).GetColor(), CColor::BLACK);
  box.AddLED(CVector3(), CColor::GREEN);
  EXPECT_EQ(box.GetLEDEquippedEntity().GetNumLEDs(), 2U);
  run.Simulator().Reset();
  EXPECT_EQ(box.GetLEDEquippedEntity().GetLED(0).GetColor(), CColor::RED) << "as it was added";
}

TEST(Argos3Runs, AGripperHoldsWhatIsAhead)
{
  Argos3Run run(
      {.controllers = Coded("c", "<differential_steering/><footbot_gripper/><footbot_turret/>", ""),
       .arena = Placed("foot-bot", "a", "0,0,0", "c") + Placed("cylinder", "can", "0.2,0,0", "", "0,0,0",
                                                               "radius='0.1' height='0.2' movable='true' mass='0.1'"),
       .engines = "<dynamics2d id='d'/>"});
  auto& gripper = run.Get("a").GetGripperEquippedEntity();
  EXPECT_FALSE(gripper.IsGripping());
  EXPECT_THROW(gripper.GetGrippedEntity(), CARGoSException);
  TheCode().steps["a"] = [](CCI_Controller& robot)
  {
    robot.GetActuator<CCI_DifferentialSteeringActuator>("differential_steering")->SetLinearVelocity(5, 5);
    robot.GetActuator<CCI_FootBotGripperActuator>("footbot_gripper")->LockNegative();
  };
  run.Step(20);
  ASSERT_TRUE(gripper.IsGripping());
  EXPECT_EQ(&gripper.GetGrippedEntity(), &run.Get<CCylinderEntity>("can").GetEmbodiedEntity());
  TheCode().steps["a"] = [](CCI_Controller& robot)
  { robot.GetActuator<CCI_FootBotGripperActuator>("footbot_gripper")->Unlock(); };
  run.Step(3);
  EXPECT_FALSE(gripper.IsGripping());
}

TEST(Argos3Runs, TrialsOfOneSeedAreTheSame)
{
  Argos3Run run({.controllers = Coded("c", "",
                                      "<differential_steering vel_noise_range='-2:4' dist_noise_range='-0.1:0.3'/>"
                                      "<footbot_proximity/>"),
                 .arena = Placed("foot-bot", "a", "0,0,0", "c")});
  CRandom::CRNG* const generator = CRandom::CreateRNG("argos");
  const auto trial = [&]
  {
    std::vector<double> drawn;
    for (int step = 0; step < 40; ++step)
      run.Step("a",
               [&](CCI_Controller& robot)
               {
                 const auto& rolled =
                     robot.GetSensor<CCI_DifferentialSteeringSensor>("differential_steering")->GetReading();
                 drawn.push_back(rolled.VelocityLeftWheel);
                 drawn.push_back(rolled.CoveredDistanceRightWheel);
               });
    drawn.push_back(generator->Gaussian(1));
    drawn.push_back(run.Simulator().GetRNG()->Gaussian(1));
    return drawn;
  };
  const std::vector<double> first = trial();
  for (std::size_t i = 0; i < 80; ++i)
  {
    EXPECT_GE(first[i], i % 2 == 0 ? -2 : -0.1);
    EXPECT_LE(first[i], i % 2 == 0 ? 4 : 0.3);
  }
  EXPECT_GT(*std::max_element(first.begin(), first.begin() + 80), 3);
  run.Simulator().Reset();
  EXPECT_EQ(trial(), first);
  run.Simulator().Reset(9);
  const std::vector<double> other = trial();
  EXPECT_NE(other, first);
  run.Simulator().Reset(1);
  EXPECT_EQ(trial(), first) << "the first seed";
  // The space alone puts entities back, and the noise goes on.
  run.Space().Reset();
  EXPECT_EQ(run.Space().GetSimulationClock(), 0U);
  EXPECT_NE(trial(), first);
}

TEST(Argos3Runs, MistakesOfAProgramAreExceptions)
{
  CSimulator& simulator = CSimulator::GetInstance();
  simulator.SetExperimentFileName("/nowhere/x.argos");
  EXPECT_EQ(simulator.GetExperimentFileName(), "/nowhere/x.argos");
  EXPECT_THROW(simulator.LoadExperiment(), CARGoSException);
  const swarmanoid::test::TemporaryFolder folder;
  simulator.SetExperimentFileName(folder.Write(
      "x.argos",
      "<argos-configuration><framework><experiment length='1' ticks_per_second='10' random_seed='1'/></framework>"
      "<controllers/><arena size='2,2,1' center='0,0,0.5'/><physics_engines><dummy_engine id='d'/></physics_engines>"
      "<media/></argos-configuration>"));
  EXPECT_THAT(MessageOf<CARGoSException>([&] { simulator.LoadExperiment(); }),
              testing::HasSubstr("has no <loop_functions>; add them"));
  EXPECT_THROW(
      Argos3Run({.controllers = Coded("c", "", "<no_such_sensor/>"), .arena = Placed("foot-bot", "a", "0,0,0", "c")}),
      CARGoSException);
  Argos3Run run({.controllers = Coded("c", "", ""), .arena = Placed("foot-bot", "a", "0,0,0", "c")});
  TheCode().steps["a"] = [](CCI_Controller& robot) { robot.GetSensor<CCI_GroundSensor>("ground"); };
  EXPECT_THAT(MessageOf<CARGoSException>([&] { run.Step(); }), testing::HasSubstr("has no sensor 'ground'"));
}

}  // namespace
