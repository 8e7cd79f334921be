// Robots of ARGoS3's plug-ins in a run of this process: readings by the formulas of the plug-ins, and commands.
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_base_leds_actuator.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_ground_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_light_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_omnidirectional_camera_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_proximity_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_range_and_bearing_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_rgb_leds_actuator.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_wheels_actuator.h>
#include <argos3/plugins/robots/e-puck/simulator/epuck_entity.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_leds_actuator.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_ground_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_lidar_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_light_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_proximity_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_ultrasound_sensor.h>
#include <argos3/plugins/robots/kheperaiv/simulator/kheperaiv_entity.h>
#include <argos3/plugins/robots/kilobot/control_interface/ci_kilobot_communication_actuator.h>
#include <argos3/plugins/robots/kilobot/control_interface/ci_kilobot_communication_sensor.h>
#include <argos3/plugins/robots/kilobot/control_interface/ci_kilobot_led_actuator.h>
#include <argos3/plugins/robots/kilobot/control_interface/ci_kilobot_light_sensor.h>
#include <argos3/plugins/robots/kilobot/simulator/kilobot_communication_medium.h>
#include <argos3/plugins/robots/kilobot/simulator/kilobot_entity.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_differential_drive_actuator.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_differential_drive_sensor.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_ground_sensor.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_leds_actuator.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_rangefinders_sensor.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_system_sensor.h>
#include <argos3/plugins/robots/pi-puck/simulator/pipuck_entity.h>
#undef main
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "argos3/plugin/device_noise.h"
#include "argos3/plugin/qt_keys.h"
#include "common/configuration/xml_reader.h"
#include "tests/unit/argos3/argos3_run.h"

namespace
{

using namespace argos;
using swarmanoid::test::Argos3Run;
using swarmanoid::test::Argos3Text;
using swarmanoid::test::Coded;
using swarmanoid::test::Placed;
using swarmanoid::test::TheCode;
using testing::ElementsAre;

constexpr double kByHand = 1e-5;

double RadiansOf(double degrees) { return degrees * std::numbers::pi / 180; }

const std::string kPaintedFloor = "<floor id='floor' source='loop_functions' pixels_per_meter='10'/>";

std::string Wall(const std::string& id, const std::string& place, const std::string& size)
{
  return Placed("box", id, place, "", "0,0,0", "size='" + size + "' movable='false'");
}

std::string Lamp(const std::string& place, const std::string& intensity)
{
  return "<light id='lamp' position='" + place + "' orientation='0,0,0' color='yellow' intensity='" + intensity +
         "' medium='leds'/>";
}

TEST(Argos3Robots, KheperasSenseAsThoseOfArgos3)
{
  constexpr double kRadius = 0.0704;
  Argos3Run run({.controllers = Coded("k", "<differential_steering/><leds medium='leds'/>",
                                      "<differential_steering/><kheperaiv_proximity/><kheperaiv_ultrasound/>"
                                      "<kheperaiv_light/><kheperaiv_ground/><kheperaiv_lidar num_readings='15'/>"),
                 .arena = kPaintedFloor + Wall("ahead", "0.2304,0,0", "0.2,0.6,0.12") +
                          Wall("left", "0,1.1704,0", "0.6,0.2,0.1") + Wall("right", "0,-1.6754,0", "0.6,0.2,0.5") +
                          Lamp("1,0.2,1", "1") + Placed("kheperaiv", "k", "0,0,0", "k")},
                {.floor = [](const CVector2& place) { return place.GetY() > 0 ? CColor::BLACK : CColor::WHITE; }});
  const auto infrared = [](double distance) {
    return distance < 0.04 ? 1 : distance > 0.12 ? 0 : 4.14 * std::exp(-33 * distance) - 0.085;
  };
  run.Step(
      "k",
      [&](CCI_Controller& robot)
      {
        const auto& near = robot.GetSensor<CCI_KheperaIVProximitySensor>("kheperaiv_proximity")->GetReadings();
        ASSERT_EQ(near.size(), 8U);
        const double half = std::sqrt(0.5);
        const double slanted = (kRadius + 0.06 - kRadius * half) / half;
        const double seen[] = {infrared(0.06), infrared(slanted), 0, 0, 0, 0, 0, infrared(slanted)};
        const double angles[] = {0, 45, 90, 135, 180, -135, -90, -45};
        for (std::size_t i = 0; i < 8; ++i)
        {
          EXPECT_NEAR(near[i].Value, seen[i], kByHand) << i;
          EXPECT_NEAR(ToDegrees(near[i].Angle).GetValue(), angles[i], 1e-9) << i;
        }
        const auto& far = robot.GetSensor<CCI_KheperaIVUltrasoundSensor>("kheperaiv_ultrasound")->GetReadings();
        ASSERT_EQ(far.size(), 5U);
        const double echoes[] = {0, 0, (1 - 0.5) / 1.75, (1.505 - 0.5) / 1.75, 0};
        const double beams[] = {0, 45, 90, -90, -45};
        for (std::size_t i = 0; i < 5; ++i)
        {
          EXPECT_NEAR(far[i].Value, echoes[i], kByHand) << i;
          EXPECT_NEAR(ToDegrees(far[i].Angle).GetValue(), beams[i], 1e-9) << i;
        }
        const auto& light = robot.GetSensor<CCI_KheperaIVLightSensor>("kheperaiv_light")->GetReadings();
        ASSERT_EQ(light.size(), 8U);
        // kheperaiv_light_rotzonly_sensor.cpp
        const double bearing = std::atan2(0.2, 1);
        const int index = static_cast<int>(bearing / (std::numbers::pi / 12) + 0.5);
        for (int i = 0; i < 8; ++i)
        {
          const int away = (i - index + 12) % 8 - 4;
          const double off = std::abs(std::remainder(bearing - i * std::numbers::pi / 4, 2 * std::numbers::pi));
          const double value = std::exp(-2 * std::hypot(1, 0.2, 1)) * std::max(1 - 2 * off / std::numbers::pi, 0.0);
          EXPECT_NEAR(light[static_cast<std::size_t>(i)].Value, std::abs(away) <= 2 ? value : 0, kByHand) << i;
          EXPECT_NEAR(ToDegrees(light[static_cast<std::size_t>(i)].Angle).GetValue(), angles[i], 1e-9);
        }
        const auto& ground = robot.GetSensor<CCI_KheperaIVGroundSensor>("kheperaiv_ground")->GetReadings();
        ASSERT_EQ(ground.size(), 4U);
        const double places[][3] = {{0.0614, 0.01, 0}, {0.0206, 0.059, 0}, {0.0206, -0.059, 1}, {0.0614, -0.01, 1}};
        for (std::size_t i = 0; i < 4; ++i)
        {
          EXPECT_LT(Distance(ground[i].Offset, CVector2(places[i][0], places[i][1])), 1e-9) << i;
          EXPECT_EQ(ground[i].Value, places[i][2]) << i;
        }
        // The scanner looks over boxes that are less than 0.14 m high. Its second beam of 15 looks to the right.
        auto* lidar = robot.GetSensor<CCI_KheperaIVLIDARSensor>("kheperaiv_lidar");
        ASSERT_EQ(lidar->GetNumReadings(), 15U);
        EXPECT_EQ(lidar->GetReading(1), 148);
        for (UInt32 beam = 4; beam < 15; ++beam) EXPECT_EQ(lidar->GetReading(beam), 0) << beam;
        EXPECT_THROW(lidar->GetReading(15), CARGoSException);
        lidar->LaserOff();
        robot.GetActuator<CCI_DifferentialSteeringActuator>("differential_steering")->SetLinearVelocity(-5, 0);
        auto* leds = robot.GetActuator<CCI_LEDsActuator>("leds");
        EXPECT_EQ(leds->GetNumLEDs(), 3U);
        leds->SetSingleColor(2, CColor::RED);
      });
  EXPECT_EQ(run.Get("k").GetLEDEquippedEntity().GetLED(2).GetColor(), CColor::RED);
  EXPECT_EQ(run.Get("k").GetLEDEquippedEntity().GetLED(0).GetColor(), CColor::BLACK);
  run.Functions().RemoveEntity("k");
}

TEST(Argos3Robots, TheLidarOfAKheperaKeepsItsReadingsWhileItIsOff)
{
  Argos3Run run({.controllers = Coded("k", "<differential_steering/>",
                                      "<kheperaiv_lidar num_readings='15'/><differential_steering/>"),
                 .arena = Wall("ahead", "1.5,0,0", "0.1,6,0.5") + Placed("kheperaiv", "k", "0,0,0", "k")});
  long middle = -1;
  const auto step = [&](const std::function<void(CCI_KheperaIVLIDARSensor&)>& change)
  {
    run.Step("k",
             [&](CCI_Controller& robot)
             {
               auto* lidar = robot.GetSensor<CCI_KheperaIVLIDARSensor>("kheperaiv_lidar");
               middle = lidar->GetReading(7);
               change(*lidar);
             });
  };
  const auto nothing = [](CCI_KheperaIVLIDARSensor&) {};
  step(nothing);
  const long at_first = middle;
  EXPECT_EQ(at_first, static_cast<long>(145 - 9.04));
  // It drives away from the wall with its laser off, then with its power off.
  run.Step("k",
           [](CCI_Controller& robot)
           {
             robot.GetActuator<CCI_DifferentialSteeringActuator>("differential_steering")->SetLinearVelocity(-50, -50);
             robot.GetSensor<CCI_KheperaIVLIDARSensor>("kheperaiv_lidar")->LaserOff();
           });
  run.Step(5);
  step([](CCI_KheperaIVLIDARSensor& lidar) { lidar.LaserOn(); });
  EXPECT_EQ(middle, at_first);
  step([](CCI_KheperaIVLIDARSensor& lidar) { lidar.PowerOff(); });
  const long moved = middle;
  EXPECT_GT(moved, at_first);
  run.Step(3);
  step([](CCI_KheperaIVLIDARSensor& lidar) { lidar.PowerOn(); });
  EXPECT_EQ(middle, moved);
  step(nothing);
  EXPECT_GT(middle, moved);
  const auto& wheels = run.Get<CKheperaIVEntity>("k").GetWheeledEntity();
  EXPECT_EQ(wheels.GetWheelVelocity(0), -0.5);
  EXPECT_NEAR(wheels.GetWheelPosition(0).GetY(), 0.0527, 1e-9);
  EXPECT_EQ(wheels.GetWheelRadius(0), 0.021);
  run.Step("k",
           [](CCI_Controller& robot)
           {
             const auto& rolled =
                 robot.GetSensor<CCI_DifferentialSteeringSensor>("differential_steering")->GetReading();
             EXPECT_NEAR(rolled.VelocityLeftWheel, -50, 1e-9);
             EXPECT_NEAR(rolled.CoveredDistanceRightWheel, -5, 1e-9);
             EXPECT_NEAR(rolled.WheelAxisLength, 10.54, 1e-9);
           });
}

TEST(Argos3Robots, KheperasHaveTheirParts)
{
  Argos3Run run({.controllers = Coded("k", "<range_and_bearing/>", "<range_and_bearing medium='rab'/>"),
                 .arena = Placed("kheperaiv", "k", "0,0,0", "k")});
  auto& robot = run.Get<CKheperaIVEntity>("k");
  EXPECT_EQ(robot.GetTypeDescription(), "kheperaiv");
  EXPECT_EQ(robot.GetLEDEquippedEntity().GetNumLEDs(), 3U);
  EXPECT_EQ(robot.GetRABEquippedEntity().GetMsgSize(), 10U);
  auto& ultrasound = robot.GetUltrasoundSensorEquippedEntity();
  ASSERT_EQ(ultrasound.GetNumSensors(), 5U);
  const double beams[] = {0, 45, 90, -90, -45};
  for (std::size_t i = 0; i < 5; ++i)
  {
    const CVector3 ahead(std::cos(RadiansOf(beams[i])), std::sin(RadiansOf(beams[i])), 0);
    EXPECT_LT(Distance(ultrasound.GetSensor(i).Offset, 0.3204 * ahead), 1e-9) << i;
    EXPECT_LT(Distance(ultrasound.GetSensor(i).Direction, 2 * ahead), 1e-9) << i;
  }
  auto& proximity = robot.GetProximitySensorEquippedEntity();
  ASSERT_EQ(proximity.GetNumSensors(), 8U);
  EXPECT_LT(Distance(proximity.GetSensor(2).Offset, CVector3(0, 0.0704, 0.0145)), 1e-9);
  EXPECT_LT(Distance(proximity.GetSensor(2).Direction, CVector3(0, 0.12, 0)), 1e-9);
  auto& light = robot.GetLightSensorEquippedEntity();
  ASSERT_EQ(light.GetNumSensors(), 8U);
  EXPECT_LT(Distance(light.GetSensor(2).Position, CVector3(0, 0.0704, 0.0145)), 1e-9);
  EXPECT_LT(Distance(light.GetSensor(4).Direction, CVector3(-0.12, 0, 0)), 1e-9);
  auto& ground = robot.GetGroundSensorEquippedEntity();
  ASSERT_EQ(ground.GetNumSensors(), 4U);
  EXPECT_EQ(ground.GetSensor(3).Offset, CVector2(0.0614, -0.01));
  EXPECT_EQ(ground.GetSensor(0).Type, CGroundSensorEquippedEntity::TYPE_GRAYSCALE);
  for (const char* part :
       {"wheels", "proximity_sensors[proximity]", "proximity_sensors[ultrasound]", "light_sensors", "ground_sensors"})
    EXPECT_TRUE(robot.HasComponent(part)) << part;
  const CKheperaIVEntity made("made", "k", CVector3(1, 2, 3));
  EXPECT_EQ(made.GetEmbodiedEntity().GetPosition(), CVector3(1, 2, 3));
}

TEST(Argos3Robots, PiPucksSenseAsThoseOfArgos3)
{
  constexpr double kRange = 0.1;
  Argos3Run run(
      {.controllers = Coded("p", "<pipuck_differential_drive/><pipuck_leds/>",
                            "<pipuck_differential_drive/><pipuck_rangefinders/><pipuck_ground/><pipuck_system/>"),
       .arena = kPaintedFloor + Wall("right", "0,-0.195,0", "0.2,0.2,0.04") + Wall("low", "0,0.195,0", "0.2,0.2,0.03") +
                Placed("pipuck", "k", "0,0,0", "p"),
       .media = "<led id='leds'/>"},
      {.floor = [](const CVector2& place) { return place.GetY() > 0.005 ? CColor::BLACK : CColor::WHITE; }});
  const double places[][2] = {{0.0333, -0.0096}, {0.0234, -0.0264}, {0, -0.035}, {-0.028, -0.0212}};
  const double directions[][2] = {{0.976, -0.218}, {0.683, -0.730}, {0, -1}, {-0.776, -0.630}};
  // The wall on the right is 0.095 m away. That on the left is too low.
  const double slanted = (0.095 - 0.0264) / (0.730 / std::hypot(0.683, 0.730));
  const double seen[] = {kRange, slanted, 0.06, kRange, kRange, kRange, kRange, kRange};
  run.Step(
      "k",
      [&](CCI_Controller& robot)
      {
        int visited = 0;
        robot.GetSensor<CCI_PiPuckRangefindersSensor>("pipuck_rangefinders")
            ->Visit(
                [&](const CCI_PiPuckRangefindersSensor::SInterface& sensor)
                {
                  const int number = visited++;
                  const int mirrored = std::min(number, 7 - number);
                  const double side = number < 4 ? 1 : -1;
                  EXPECT_EQ(sensor.Label, number);
                  EXPECT_NEAR(sensor.Proximity, seen[number], kByHand) << number;
                  EXPECT_EQ(sensor.Illuminance, 0);
                  EXPECT_STREQ(std::get<const char*>(sensor.Configuration), "origin");
                  EXPECT_EQ(std::get<Real>(sensor.Configuration), kRange);
                  EXPECT_LT(Distance(std::get<CVector3>(sensor.Configuration),
                                     CVector3(places[mirrored][0], side * places[mirrored][1], 0.0333)),
                            1e-9);
                  CVector3 direction(CVector3::Z);
                  direction.Rotate(std::get<CQuaternion>(sensor.Configuration));
                  EXPECT_LT(Distance(direction, CVector3(directions[mirrored][0], side * directions[mirrored][1], 0)),
                            2e-3)
                      << number;
                });
        EXPECT_EQ(visited, 8);
        visited = 0;
        robot.GetSensor<CCI_PiPuckGroundSensor>("pipuck_ground")
            ->Visit(
                [&](const CCI_PiPuckGroundSensor::SInterface& sensor)
                {
                  EXPECT_EQ(sensor.Label, visited);
                  EXPECT_EQ(sensor.Reflected, visited == 0 ? 0 : 1) << visited;
                  EXPECT_EQ(sensor.Background, 0);
                  EXPECT_EQ(std::get<std::string>(sensor.Configuration), "origin");
                  EXPECT_EQ(std::get<Real>(sensor.Configuration), 0.005);
                  EXPECT_LT(
                      Distance(std::get<CVector3>(sensor.Configuration), CVector3(0.03, 0.01 * (1 - visited), 0.002)),
                      1e-9);
                  CVector3 direction(CVector3::Z);
                  direction.Rotate(std::get<CQuaternion>(sensor.Configuration));
                  EXPECT_LT(Distance(direction, -CVector3::Z), 1e-9);
                  ++visited;
                });
        EXPECT_EQ(visited, 3);
        const auto* system = robot.GetSensor<CCI_PiPuckSystemSensor>("pipuck_system");
        EXPECT_NEAR(system->GetTime(), 0.1, 1e-9);
        EXPECT_EQ(system->GetTemperature(), 0);
        auto* leds = robot.GetActuator<CCI_PiPuckLEDsActuator>("pipuck_leds");
        leds->SetRingLEDs(true);
        leds->SetRingLEDIndex(3, false);
        leds->SetRingLEDIndex(8, true);
        leds->SetFrontLED(true);
      });
  const auto lit = [&]
  {
    std::string lit;
    auto& leds = run.Get("k").GetLEDEquippedEntity();
    for (UInt32 led = 0; led < 10; ++led)
      lit += leds.GetLED(led).GetColor() == CColor::WHITE   ? '1'
             : leds.GetLED(led).GetColor() == CColor::BLACK ? '0'
                                                            : '?';
    return lit;
  };
  EXPECT_EQ(lit(), "1110111110");
  run.Step("k",
           [](CCI_Controller& robot)
           {
             auto* leds = robot.GetActuator<CCI_PiPuckLEDsActuator>("pipuck_leds");
             leds->SetRingLEDs(false);
             leds->SetRingLEDIndex(7, true);
             leds->SetFrontLED(false);
             leds->SetBodyLED(true);
             robot.GetActuator<CCI_PiPuckDifferentialDriveActuator>("pipuck_differential_drive")
                 ->SetLinearVelocity(0.02, -0.01);
           });
  EXPECT_EQ(lit(), "0000000101");
  run.Step("k",
           [](CCI_Controller& robot)
           {
             auto* speeds = robot.GetSensor<CCI_PiPuckDifferentialDriveSensor>("pipuck_differential_drive");
             EXPECT_NEAR(speeds->GetLeftVelocity(), 0.02, 1e-9);
             EXPECT_NEAR(speeds->GetRightVelocity(), -0.01, 1e-9);
             EXPECT_NEAR(robot.GetSensor<CCI_PiPuckSystemSensor>("pipuck_system")->GetTime(), 0.3, 1e-9);
           });
  EXPECT_NEAR(run.PlaceOf("k").GetX(), 0.0005, 1e-5);
  run.Simulator().Reset();
  EXPECT_EQ(lit(), "0000000000");
  run.Step("k",
           [](CCI_Controller& robot)
           {
             EXPECT_EQ(
                 robot.GetSensor<CCI_PiPuckDifferentialDriveSensor>("pipuck_differential_drive")->GetLeftVelocity(), 0);
             EXPECT_NEAR(robot.GetSensor<CCI_PiPuckSystemSensor>("pipuck_system")->GetTime(), 0.1, 1e-9);
           });
}

TEST(Argos3Robots, EPucksOfThePlugInSenseByItsFormulas)
{
  const double divisors[] = {10.5884, 3.5999, 2, 1.2, 0.8571, 0.6667, 0.5806, 0.5247};
  Argos3Run run(
      {.controllers = Coded("e",
                            "<epuck_wheels/><epuck_rgb_leds medium='leds'/><epuck_base_leds medium='leds'/>"
                            "<epuck_range_and_bearing range='0.7'/>",
                            "<epuck_range_and_bearing medium='rab' data_size='3'/><epuck_proximity/><epuck_light/>"
                            "<epuck_ground/><epuck_omnidirectional_camera medium='leds'/>"),
       .arena = kPaintedFloor + Wall("left", "0,0.11,0", "0.5,0.1,0.05") + Lamp("0.2,-1,0.5", "2") +
                Placed("e-puck", "a", "0,0,0", "e") + Placed("e-puck", "b", "0.28,0,0", "e", "90,0,0") +
                Placed("e-puck", "d", "-1.5,1,0", "e"),
       .size = "4,4,1"},
      {.floor = [](const CVector2& place) { return place.GetY() > 0 ? CColor::BLACK : CColor::WHITE; }});
  const auto code = [](CCI_Controller& robot)
  {
    const UInt8 all[] = {1, 2, 3, 4}, left[] = {9, 8, 7, 6};
    auto* sender = robot.GetActuator<CCI_EPuckRangeAndBearingActuator>("epuck_range_and_bearing");
    if (robot.GetId() == "b")
      sender->SetDataForEmitter(3, left);
    else
      sender->SetData(all);
    robot.GetSensor<CCI_EPuckOmnidirectionalCameraSensor>("epuck_omnidirectional_camera")->Enable();
    if (robot.GetId() == "b")
    {
      auto* coloured = robot.GetActuator<CCI_EPuckRGBLEDsActuator>("epuck_rgb_leds");
      coloured->SetColors(std::vector<CColor>{CColor::RED, CColor::GREEN, CColor::BLUE});
    }
    robot.GetActuator<CCI_EPuckBaseLEDsActuator>("epuck_base_leds")
        ->SwitchLED(robot.GetId() == "d" ? 0 : 7, robot.GetId() == "d");
    const double speed = robot.GetId() == "d" ? 40 : 0;
    robot.GetActuator<CCI_EPuckWheelsActuator>("epuck_wheels")->SetLinearVelocity(speed, speed);
  };
  for (const char* id : {"a", "b", "d"}) TheCode().steps[id] = code;
  run.Step(2);
  EXPECT_EQ(run.Get("d").GetLEDEquippedEntity().GetNumLEDs(), 11U);
  EXPECT_EQ(run.Get("d").GetLEDEquippedEntity().GetLED(7).GetColor(), CColor::RED) << "the first one clockwise";
  EXPECT_EQ(run.Get("d").GetLEDEquippedEntity().GetLED(0).GetColor(), CColor::BLACK);
  EXPECT_EQ(run.Get("b").GetLEDEquippedEntity().GetLED(8).GetColor(), CColor::RED);
  EXPECT_EQ(run.Get("b").GetLEDEquippedEntity().GetLED(10).GetColor(), CColor::BLUE);
  EXPECT_EQ(run.Get<CEPuckEntity>("d").GetWheeledEntity().GetWheelVelocity(0), 0.4);
  const auto infrared = [](double distance)
  { return distance <= 0.05 ? std::clamp(298.701 * distance * distance - 36.8961 * distance + 1.08212, 0.0, 1.0) : 0; };
  run.Step("a",
           [&](CCI_Controller& robot)
           {
             const auto* near = robot.GetSensor<CCI_EPuckProximitySensor>("epuck_proximity");
             const auto* light = robot.GetSensor<CCI_EPuckLightSensor>("epuck_light");
             const double away = std::hypot(0.2, 1, 0.5) / 2;
             const double lamp = std::atan2(-1, 0.2);
             for (UInt16 i = 0; i < 8; ++i)
             {
               const double up = std::sin(RadiansOf(11.25 + 45 * i));
               EXPECT_NEAR(near->GetReading(i).Value, infrared(up > 0 ? (0.06 - 0.036 * up) / up : 1), 1e-4) << i;
               EXPECT_NEAR(near->GetReading(i).Angle.GetValue(), std::numbers::pi / divisors[i], 1e-9);
               const double angle = std::numbers::pi / divisors[i];
               EXPECT_NEAR(light->GetReading(i).Angle.GetValue(), angle, 1e-9);
               const double off = std::abs(std::remainder(angle - lamp, 2 * std::numbers::pi));
               EXPECT_NEAR(light->GetReading(i).Value,
                           std::exp(-2 * away) * std::max(1 - 2 * off / std::numbers::pi, 0.0), 1e-4)
                   << i;
             }
             auto* ground = robot.GetSensor<CCI_EPuckGroundSensor>("epuck_ground");
             EXPECT_EQ(ground->GetReadings().Left, 0);
             EXPECT_EQ(ground->GetReading(1), 1);
             EXPECT_EQ(ground->GetReadings().Right, 1);
             const auto& packets =
                 robot.GetSensor<CCI_EPuckRangeAndBearingSensor>("epuck_range_and_bearing")->GetPackets();
             ASSERT_EQ(packets.size(), 1U);
             EXPECT_NEAR(packets[0]->Range, 28 - 7, 1e-4);
             EXPECT_NEAR(packets[0]->Bearing.GetValue(), 0, 1e-6);
             EXPECT_THAT(packets[0]->Data, ElementsAre(9, 8, 7, 0)) << "three bytes";
             const auto& seen =
                 robot.GetSensor<CCI_EPuckOmnidirectionalCameraSensor>("epuck_omnidirectional_camera")->GetReadings();
             EXPECT_EQ(seen.Counter, 2U);
             ASSERT_EQ(seen.BlobList.size(), 3U);
             const std::tuple<CColor, double, double> leds[] = {{CColor::RED, 0.28 - 0.0311769, 0.018},
                                                                {CColor::GREEN, 0.28 + 0.0311769, 0.018},
                                                                {CColor::BLUE, 0.28, -0.036}};
             for (const auto& [colour, x, y] : leds)
               for (const auto* blob : seen.BlobList)
               {
                 if (blob->Color != colour) continue;
                 const double distance = 100 * std::hypot(x, y);
                 EXPECT_NEAR(blob->Distance, distance, 1e-3);
                 EXPECT_NEAR(blob->Angle.GetValue(), std::atan2(y, x), 1e-4);
                 EXPECT_EQ(blob->Area, static_cast<UInt32>(95.644 * std::exp(-0.11 * distance)));
               }
           });
  run.Step(
      "d",
      [](CCI_Controller& robot)
      {
        EXPECT_TRUE(robot.GetSensor<CCI_EPuckRangeAndBearingSensor>("epuck_range_and_bearing")->GetPackets().empty())
            << "too far away";
      });
  run.Simulator().Reset();
  EXPECT_EQ(run.Get<CEPuckEntity>("d").GetWheeledEntity().GetWheelVelocity(0), 0);
  EXPECT_EQ(run.Get("b").GetLEDEquippedEntity().GetLED(8).GetColor(), CColor::BLACK);
}

TEST(Argos3Robots, EachEmitterCoversATwelfthOfATurn)
{
  // Robot b turns in its place; each of its emitters sends its own number to robot a.
  for (int degrees = -180; degrees < 180; degrees += 40)
  {
    Argos3Run run(
        {.controllers = Coded("e", "<epuck_range_and_bearing range='0.7'/>", "<epuck_range_and_bearing medium='rab'/>"),
         .arena = Placed("e-puck", "a", "0,0,0", "e", "70,0,0") +
                  Placed("e-puck", "b", "0.3,0,0", "e", std::to_string(degrees) + ",0,0"),
         .size = "4,4,1"});
    run.Step("b",
             [](CCI_Controller& robot)
             {
               for (UInt8 emitter = 0; emitter < 12; ++emitter)
               {
                 const UInt8 data[] = {emitter, 0, 0, 77};
                 robot.GetActuator<CCI_EPuckRangeAndBearingActuator>("epuck_range_and_bearing")
                     ->SetDataForEmitter(emitter, data);
               }
             });
    run.Step();
    run.Step("a",
             [&](CCI_Controller& robot)
             {
               const auto& packets =
                   robot.GetSensor<CCI_EPuckRangeAndBearingSensor>("epuck_range_and_bearing")->GetPackets();
               ASSERT_EQ(packets.size(), 1U);
               const double towards = std::remainder(180.0 - degrees, 360);
               const int emitter = (static_cast<int>(std::floor((towards + 15) / 30)) + 12) % 12;
               EXPECT_EQ(packets[0]->Data[0], emitter) << degrees;
               EXPECT_EQ(packets[0]->Data[3], 77);
               EXPECT_NEAR(packets[0]->Bearing.GetValue(), RadiansOf(-70), 1e-6);
             });
  }
}

TEST(Argos3Robots, KilobotsSeeLightAndShineAndDrive)
{
  Argos3Run run({.controllers = Coded("k", "<differential_steering/><kilobot_led/>", "<kilobot_light/>"),
                 .arena = Lamp("0.5,0.1,0.3", "1") + Placed("kilobot", "kb0", "0,0,0", "k") +
                          Placed("kilobot", "kb3", "0.2415,0,0", "k", "90,0,0"),
                 .size = "2,2,1",
                 .media = "<led id='leds'/>",
                 .experiment = "length='0' ticks_per_second='31' random_seed='5'"});
  const double eye[] = {0.0092 + 0.0145 * std::cos(RadiansOf(100)), 0.0145 * std::sin(RadiansOf(100)), 0.0344};
  for (const auto& [id, x, heading] : {std::tuple("kb0", 0.0, 0.0), std::tuple("kb3", 0.2415, RadiansOf(90))})
    run.Step(id,
             [&, x = x, heading = heading](CCI_Controller& robot)
             {
               const double way[] = {0.5 - x - eye[0] * std::cos(heading) + eye[1] * std::sin(heading),
                                     0.1 - eye[0] * std::sin(heading) - eye[1] * std::cos(heading), 0.3 - eye[2]};
               const double off = std::abs(
                   std::remainder(std::atan2(way[1], way[0]) - heading - RadiansOf(100), 2 * std::numbers::pi));
               EXPECT_EQ(
                   robot.GetSensor<CCI_KilobotLightSensor>("kilobot_light")->GetReading(),
                   std::floor(1024 * std::exp(-2 * std::hypot(way[0], way[1], way[2])) * (1 - off / std::numbers::pi)));
               robot.GetActuator<CCI_KilobotLEDActuator>("kilobot_led")->SetColor(CColor(85, 0, 255));
               robot.GetActuator<CCI_DifferentialSteeringActuator>("differential_steering")->SetLinearVelocity(3, 3);
             });
  EXPECT_EQ(run.Get("kb0").GetLEDEquippedEntity().GetLED(0).GetColor(), CColor(85, 0, 255));
  EXPECT_EQ(run.Get<CKilobotEntity>("kb0").GetWheeledEntity().GetWheelVelocity(0), 0.03);
  const double before = run.PlaceOf("kb0").GetX();
  run.Step();
  EXPECT_NEAR(run.PlaceOf("kb0").GetX() - before, 0.03 / 31, 1e-6);
  run.Simulator().Reset();
  EXPECT_EQ(run.Get("kb0").GetLEDEquippedEntity().GetLED(0).GetColor(), CColor::BLACK);
}

TEST(Argos3Robots, KilobotsSendOneAfterTheOther)
{
  Argos3Run run({.controllers = Coded("k", "<kilobot_communication/>", "<kilobot_communication medium='air'/>"),
                 .arena = Placed("kilobot", "kb0", "0,0,0", "k") + Placed("kilobot", "kb1", "0.05,0,0", "k") +
                          Placed("kilobot", "far", "0.5,0,0", "k"),
                 .size = "2,2,1",
                 .media = "<kilobot_communication id='air'/>",
                 .experiment = "length='0' ticks_per_second='31' random_seed='5'"});
  message_t message{};
  for (uint8_t i = 0; i < 9; ++i) message.data[i] = static_cast<uint8_t>(i + 1);
  message.type = 5;
  int sent = 0, heard = 0;
  TheCode().steps["kb0"] = [&](CCI_Controller& robot)
  {
    sent += robot.GetSensor<CCI_KilobotCommunicationSensor>("kilobot_communication")->MessageSent() ? 1 : 0;
    robot.GetActuator<CCI_KilobotCommunicationActuator>("kilobot_communication")->SetMessage(&message);
  };
  TheCode().steps["kb1"] = [&](CCI_Controller& robot)
  {
    for (const auto& packet : robot.GetSensor<CCI_KilobotCommunicationSensor>("kilobot_communication")->GetPackets())
    {
      ++heard;
      EXPECT_EQ(packet.Message->data[0] * 10 + packet.Message->data[8], 19);
      EXPECT_EQ(packet.Message->type, 5);
      EXPECT_EQ(packet.Distance.high_gain, 50) << "mm";
      EXPECT_EQ(packet.Distance.low_gain, 0);
    }
  };
  TheCode().steps["far"] = [](CCI_Controller& robot)
  { EXPECT_TRUE(robot.GetSensor<CCI_KilobotCommunicationSensor>("kilobot_communication")->GetPackets().empty()); };
  run.Step(20);
  EXPECT_EQ(sent, 19) << "no other robot is in the way";
  EXPECT_EQ(heard, 18);
  // Messages of the overhead controller come in each step, as the first one.
  TheCode().steps.clear();
  run.Step(3);
  auto& medium = run.Simulator().GetMedium<CKilobotCommunicationMedium>("air");
  auto& robot = run.Get<CKilobotEntity>("kb1");
  EXPECT_EQ(medium.GetOHCMessageFor(robot), nullptr);
  std::vector<CKilobotEntity*> both{&run.Get<CKilobotEntity>("kb0"), &robot};
  message.data[0] = 42;
  medium.SendOHCMessageTo(both, &message);
  ASSERT_NE(medium.GetOHCMessageFor(robot), nullptr);
  EXPECT_EQ(medium.GetOHCMessageFor(robot)->data[0], 42);
  for (int step = 0; step < 2; ++step)
    run.Step("kb1",
             [](CCI_Controller& told)
             {
               const auto& packets =
                   told.GetSensor<CCI_KilobotCommunicationSensor>("kilobot_communication")->GetPackets();
               ASSERT_EQ(packets.size(), 1U);
               EXPECT_EQ(packets[0].Message->data[0], 42);
               EXPECT_EQ(packets[0].Distance.high_gain, 0);
             });
  medium.SendOHCMessageTo(robot, nullptr);
  EXPECT_EQ(medium.GetOHCMessageFor(robot), nullptr);
  EXPECT_NE(medium.GetOHCMessageFor(*both[0]), nullptr);
  medium.SendOHCMessageTo(*both[0], nullptr);
  run.Step(
      "kb1", [](CCI_Controller& told)
      { EXPECT_TRUE(told.GetSensor<CCI_KilobotCommunicationSensor>("kilobot_communication")->GetPackets().empty()); });
}

TEST(Argos3Robots, KilobotsInRangeShareTheAir)
{
  const auto shares = [](const std::string& medium)
  {
    Argos3Run run({.controllers = Coded("k", "<kilobot_communication/>", "<kilobot_communication medium='air'/>"),
                   .arena = Placed("kilobot", "a", "0,0,0", "k") + Placed("kilobot", "b", "0.05,0,0", "k") +
                            Placed("kilobot", "c", "0.025,0.045,0", "k"),
                   .size = "2,2,1",
                   .media = medium,
                   .experiment = "length='0' ticks_per_second='31' random_seed='5'"});
    message_t message{};
    int sent = 0, heard = 0;
    for (const char* id : {"a", "b", "c"})
      TheCode().steps[id] = [&](CCI_Controller& robot)
      {
        const auto* receiver = robot.GetSensor<CCI_KilobotCommunicationSensor>("kilobot_communication");
        sent += receiver->MessageSent() ? 1 : 0;
        heard += static_cast<int>(receiver->GetPackets().size());
        robot.GetActuator<CCI_KilobotCommunicationActuator>("kilobot_communication")->SetMessage(&message);
      };
    run.Step(301);
    return std::pair(sent, heard);
  };
  // Each may send with a probability of a third; the standard deviation of the sum is 14.
  const auto [sent, heard] = shares("<kilobot_communication id='air'/>");
  EXPECT_NEAR(sent, 300, 60);
  EXPECT_NEAR(heard, 2 * sent, 6);
  EXPECT_EQ(shares("<kilobot_communication id='air' ignore_conflicts='true'/>"), std::pair(3 * 300, 6 * 300));
  const auto [all, kept] = shares("<kilobot_communication id='air' ignore_conflicts='true' message_drop_prob='0.25'/>");
  EXPECT_EQ(all, 900);
  EXPECT_NEAR(kept, 1800 * 0.75, 80);
}

TEST(Argos3Robots, NoiseOfDirectionsHasItsDeviation)
{
  using namespace swarmanoid;
  RandomStream random(1, 2, 3, 0);
  constexpr int kMany = 20000;
  Vector3 sum = Vector3::Zero(), squares = Vector3::Zero();
  double blobs = 0, blob_squares = 0, angles = 0;
  for (int i = 0; i < kMany; ++i)
  {
    Vector3 way(1, 2, 3);
    argos3::DisturbDirection(random, 0.2, way);
    const Vector3 off = way - Vector3(1, 2, 3);
    sum += off;
    squares += off.cwiseProduct(off);
    double distance = 2, angle = 0.5;
    argos3::DisturbBlob(random, 0.01, distance, angle);
    blobs += distance - 2;
    blob_squares += (distance - 2) * (distance - 2);
    angles += (angle - 0.5) * (angle - 0.5);
  }
  // The inclination is uniform: its cosine has the mean square 1/2, and its sine shares the rest with the azimuth.
  const double expected[] = {0.01, 0.01, 0.02};
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(sum[i] / kMany, 0, 4 * std::sqrt(expected[i] / kMany)) << i;
    EXPECT_NEAR(squares[i] / kMany, expected[i], 0.001) << i;
  }
  EXPECT_NEAR(blobs / kMany, 0, 0.001);
  EXPECT_NEAR(blob_squares / kMany, 0.5 * 0.02 * 0.02, 1e-5) << "a part of the distance, in any direction";
  EXPECT_NEAR(angles / kMany, 0.5 * 0.01 * 0.01, 3e-6);
  // Without a deviation nothing is drawn.
  RandomStream same(1, 2, 3, 0);
  Vector3 way(1, 2, 3);
  double distance = 2, angle = 0.5;
  argos3::DisturbDirection(same, 0, way);
  argos3::DisturbBlob(same, 0, distance, angle);
  EXPECT_EQ(way, Vector3(1, 2, 3));
  EXPECT_EQ(distance, 2);
  EXPECT_EQ(angle, 0.5);
  EXPECT_EQ(same.Bits(), RandomStream(1, 2, 3, 0).Bits());
  // The wheels have uniform noise of speed and of distance.
  const argos3::WheelNoise wheels(TConfigurationTree(ReadXml(
      "<a speed_noise_low='-2' speed_noise_high='4' distance_noise_low='0.1' distance_noise_high='0.3'/>", "f.xml")));
  double low[4]{9, 9, 9, 9}, high[4]{-9, -9, -9, -9};
  for (int i = 0; i < 2000; ++i)
  {
    CCI_DifferentialSteeringSensor::SReading reading;
    wheels.Add(random, reading);
    const double values[] = {reading.VelocityLeftWheel, reading.VelocityRightWheel, reading.CoveredDistanceLeftWheel,
                             reading.CoveredDistanceRightWheel};
    for (int k = 0; k < 4; ++k)
    {
      low[k] = std::min(low[k], values[k]);
      high[k] = std::max(high[k], values[k]);
    }
  }
  for (int k = 0; k < 4; ++k)
  {
    EXPECT_NEAR(low[k], k < 2 ? -2 : 0.1, k < 2 ? 0.05 : 0.002) << k;
    EXPECT_NEAR(high[k], k < 2 ? 4 : 0.3, k < 2 ? 0.05 : 0.002) << k;
  }
  CCI_DifferentialSteeringSensor::SReading reading;
  argos3::WheelNoise(TConfigurationTree(ReadXml("<a/>", "f.xml"))).Add(random, reading);
  EXPECT_EQ(reading.VelocityLeftWheel + reading.CoveredDistanceLeftWheel, 0);
}

TEST(Argos3Robots, KeysBecomeEventsOfQt)
{
  using swarmanoid::argos3::Keyboard;
  using swarmanoid::argos3::QtKeyOf;
  const std::pair<const char*, int> keys[] = {{"A", Qt::Key_A},           {"5", Qt::Key_5},
                                              {"+", Qt::Key_Plus},        {"Space", Qt::Key_Space},
                                              {"Return", Qt::Key_Return}, {"Escape", Qt::Key_Escape},
                                              {"Tab", Qt::Key_Tab},       {"Backspace", Qt::Key_Backspace},
                                              {"Delete", Qt::Key_Delete}, {"Insert", Qt::Key_Insert},
                                              {"Home", Qt::Key_Home},     {"End", Qt::Key_End},
                                              {"PageUp", Qt::Key_PageUp}, {"PageDown", Qt::Key_PageDown},
                                              {"Up", Qt::Key_Up},         {"Down", Qt::Key_Down},
                                              {"Left", Qt::Key_Left},     {"Right", Qt::Key_Right},
                                              {"Shift", Qt::Key_Shift},   {"Control", Qt::Key_Control},
                                              {"Alt", Qt::Key_Alt},       {"F", Qt::Key_F},
                                              {"F1", Qt::Key_F1},         {"F8", Qt::Key_F8},
                                              {"F12", Qt::Key_F12},       {"Fx", Qt::Key_unknown},
                                              {"F123", Qt::Key_unknown},  {"Menu", Qt::Key_unknown}};
  for (const auto& [name, number] : keys) EXPECT_EQ(QtKeyOf(name), number) << name;
  Keyboard keyboard;
  const auto expect = [&](const char* key, bool pressed, int modifiers, const std::string& text)
  {
    const QKeyEvent event = keyboard.EventOf(key, pressed);
    EXPECT_EQ(event.modifiers(), modifiers) << key;
    EXPECT_EQ(event.text().toStdString(), text) << key;
  };
  expect("A", true, Qt::NoModifier, "a");
  expect("Z", true, Qt::NoModifier, "z");
  expect("5", true, Qt::NoModifier, "5");
  expect("Space", true, Qt::NoModifier, " ");
  expect("Return", true, Qt::NoModifier, "");
  expect("Shift", true, Qt::ShiftModifier, "");
  expect("A", true, Qt::ShiftModifier, "A");
  expect("Control", true, Qt::ShiftModifier | Qt::ControlModifier, "");
  expect("Shift", false, Qt::ControlModifier, "");
  expect("A", true, Qt::ControlModifier, "a");
  expect("Alt", true, Qt::ControlModifier | Qt::AltModifier, "");
  expect("Control", false, Qt::AltModifier, "");
  expect("Alt", false, Qt::NoModifier, "");
}

}  // namespace
