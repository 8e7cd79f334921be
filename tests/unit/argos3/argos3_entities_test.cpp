// Entities of ARGoS3 and the space, as loop functions make and hold them, without a run.
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/robots/e-puck/simulator/epuck_entity.h>
#include <argos3/plugins/robots/eye-bot/simulator/eyebot_entity.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/robots/kilobot/simulator/kilobot_entity.h>
#include <argos3/plugins/robots/pi-puck/simulator/pipuck_entity.h>
#include <argos3/plugins/robots/spiri/simulator/spiri_entity.h>
#include <argos3/plugins/simulator/entities/box_entity.h>
#include <argos3/plugins/simulator/entities/cylinder_entity.h>
#include <argos3/plugins/simulator/entities/light_entity.h>
#include <argos3/plugins/simulator/media/rab_medium.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "argos3/library/made_bodies.h"
#include "argos3/library/running.h"
#include "common/configuration/xml_reader.h"
#include "tests/world/message_of.h"

namespace
{

using namespace argos;
using swarmanoid::argos3::TheRunning;
using testing::ElementsAre;

constexpr double kSmall = 1e-9;

CVector3 PolarPlace(double radius, double degrees, double height)
{
  const double angle = degrees * std::numbers::pi / 180;
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

// Expects a sensor at this angle, which looks outwards.
template <class Sensor>
void ExpectLooksOutwards(const Sensor& sensor, const CVector3& place, double degrees, double range, double radius,
                         double height)
{
  EXPECT_LT(Distance(place, PolarPlace(radius, degrees, height)), kSmall) << degrees;
  EXPECT_LT(Distance(sensor.Direction, PolarPlace(range, degrees, 0)), kSmall) << degrees;
}

TEST(Argos3Entities, FootBotsHaveTheirWheelsAndSensors)
{
  CFootBotEntity robot("fb0", "controller", CVector3(1, 2, 3), CQuaternion(CRadians(0.5), CVector3::Z));
  EXPECT_EQ(robot.GetTypeDescription(), "foot-bot");
  EXPECT_EQ(robot.ControllerOfMade(), "controller");
  EXPECT_EQ(robot.GetEmbodiedEntity().GetOriginAnchor().Position, CVector3(1, 2, 3));
  EXPECT_EQ(robot.GetEmbodiedEntity().GetOrientation(), CQuaternion(CRadians(0.5), CVector3::Z));
  EXPECT_TRUE(robot.GetEmbodiedEntity().IsMovable());
  EXPECT_EQ(CFootBotEntity("fb1", "c").GetEmbodiedEntity().GetPosition(), CVector3());
  EXPECT_EQ(CFootBotEntity("fb1", "c").GetEmbodiedEntity().GetOrientation(), CQuaternion());
  const CWheeledEntity& wheels = robot.GetWheeledEntity();
  EXPECT_EQ(wheels.GetNumWheels(), 2U);
  EXPECT_EQ(wheels.GetWheelPosition(0), CVector3(0, 0.07, 0));
  EXPECT_EQ(wheels.GetWheelPosition(1), CVector3(0, -0.07, 0));
  EXPECT_EQ(wheels.GetWheelRadius(1), 0.029112741);
  EXPECT_THROW(wheels.GetWheelPosition(2), CARGoSException);
  EXPECT_THROW(wheels.GetWheelRadius(2), CARGoSException);
  EXPECT_THROW(wheels.GetWheelVelocity(0), CARGoSException);
  EXPECT_EQ(robot.GetLEDEquippedEntity().GetNumLEDs(), 13U);

  auto& proximity = robot.GetProximitySensorEquippedEntity();
  auto& light = robot.GetLightSensorEquippedEntity();
  ASSERT_EQ(proximity.GetNumSensors(), 24U);
  ASSERT_EQ(light.GetNumSensors(), 24U);
  for (std::size_t i = 0; i < 24; ++i)
  {
    const double degrees = 7.5 + 15 * static_cast<double>(i);
    ExpectLooksOutwards(proximity.GetSensor(i), proximity.GetSensor(i).Offset, degrees, 0.1, 0.085, 0.06);
    ExpectLooksOutwards(light.GetSensor(i), light.GetSensor(i).Position, degrees, 0.1, 0.085, 0.06);
    EXPECT_EQ(&std::as_const(proximity).GetSensor(i), proximity.GetSensors()[i]);
    EXPECT_EQ(&std::as_const(light).GetSensor(i), light.GetSensors()[i]);
    EXPECT_EQ(&proximity.GetSensor(i).Anchor, &robot.GetEmbodiedEntity().GetOriginAnchor());
  }
  EXPECT_THROW(proximity.GetSensor(24), CARGoSException);
  EXPECT_THROW(light.GetSensor(24), CARGoSException);
  auto& ground = robot.GetGroundSensorEquippedEntity();
  ASSERT_EQ(ground.GetNumSensors(), 12U);
  const double places[][2] = {{0.063, 0.0116}, {-0.063, 0.0116}, {-0.063, -0.0116}, {0.063, -0.0116},
                              {0.08, 0},       {0.042, 0.065},   {0, 0.08},         {-0.042, 0.065},
                              {-0.08, 0},      {-0.042, -0.065}, {0, -0.08},        {0.042, -0.065}};
  for (std::size_t i = 0; i < 12; ++i)
  {
    EXPECT_EQ(ground.GetSensor(i).Offset, CVector2(places[i][0], places[i][1])) << i;
    EXPECT_EQ(ground.GetSensor(i).Type,
              i < 4 ? CGroundSensorEquippedEntity::TYPE_GRAYSCALE : CGroundSensorEquippedEntity::TYPE_BLACK_WHITE);
    EXPECT_EQ(&std::as_const(ground).GetSensor(i), ground.GetSensors()[i]);
  }
  EXPECT_THROW(ground.GetSensor(12), CARGoSException);
}

TEST(Argos3Entities, EPucksHaveTheirWheelsAndSensors)
{
  CEPuckEntity robot("ep", "controller", CVector3(1, 0, 0));
  EXPECT_EQ(robot.GetTypeDescription(), "e-puck");
  EXPECT_EQ(robot.GetEmbodiedEntity().GetPosition(), CVector3(1, 0, 0));
  EXPECT_EQ(robot.GetWheeledEntity().GetWheelPosition(0), CVector3(0, 0.0265, 0));
  EXPECT_EQ(robot.GetWheeledEntity().GetWheelRadius(0), 0.0205);
  EXPECT_EQ(robot.GetLEDEquippedEntity().GetNumLEDs(), 8U);
  EXPECT_EQ(CEPuckEntity("ep", 11U).GetLEDEquippedEntity().GetNumLEDs(), 11U);
  EXPECT_EQ(CEPuckEntity("ep").GetLEDEquippedEntity().GetNumLEDs(), 8U);
  auto& proximity = robot.GetProximitySensorEquippedEntity();
  ASSERT_EQ(proximity.GetNumSensors(), 8U);
  const double degrees[] = {17, 50, 90, 150, -150, -90, -50, -17};
  for (std::size_t i = 0; i < 8; ++i)
    ExpectLooksOutwards(proximity.GetSensor(i), proximity.GetSensor(i).Offset, degrees[i], 0.1, 0.035, 0.06);
  auto& light = robot.GetLightSensorEquippedEntity();
  ASSERT_EQ(light.GetNumSensors(), 8U);
  for (std::size_t i = 0; i < 8; ++i)
    ExpectLooksOutwards(light.GetSensor(i), light.GetSensor(i).Position, 22.5 + 45 * static_cast<double>(i), 0.1, 0.035,
                        0.06);
  auto& ground = robot.GetGroundSensorEquippedEntity();
  ASSERT_EQ(ground.GetNumSensors(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_LT(Distance(ground.GetSensor(i).Offset, CVector2(0.03, 0.009 * (static_cast<double>(i) - 1))), kSmall);
    EXPECT_EQ(ground.GetSensor(i).Type, CGroundSensorEquippedEntity::TYPE_GRAYSCALE);
  }
}

TEST(Argos3Entities, OtherRobotsHaveTheirParts)
{
  CEyeBotEntity eye_bot("eb", "controller");
  EXPECT_EQ(eye_bot.GetTypeDescription(), "eye-bot");
  EXPECT_EQ(eye_bot.GetLEDEquippedEntity().GetNumLEDs(), 16U);
  EXPECT_EQ(eye_bot.GetProximitySensorEquippedEntity().GetNumSensors(), 24U);
  auto& light = eye_bot.GetLightSensorEquippedEntity();
  ASSERT_EQ(light.GetNumSensors(), 24U);
  for (std::size_t i = 0; i < 24; ++i)
    ExpectLooksOutwards(light.GetSensor(i), light.GetSensor(i).Position, 7.5 + 15 * static_cast<double>(i), 0.1, 0.255,
                        0.1635);
  EXPECT_FALSE(eye_bot.HasComponent("wheels"));
  CKilobotEntity kilobot("kb", "controller", CVector3(0, 1, 0));
  EXPECT_EQ(kilobot.GetTypeDescription(), "kilobot");
  EXPECT_EQ(kilobot.GetEmbodiedEntity().GetPosition(), CVector3(0, 1, 0));
  EXPECT_EQ(kilobot.GetLEDEquippedEntity().GetNumLEDs(), 1U);
  EXPECT_EQ(kilobot.GetWheeledEntity().GetWheelPosition(0), CVector3(0, 0.0125, 0));
  EXPECT_EQ(kilobot.GetWheeledEntity().GetWheelRadius(0), 0.001);
  EXPECT_TRUE(kilobot.HasComponent("wheels") && CKilobotEntity("kb").HasComponent("wheels"));
  EXPECT_EQ(CPiPuckEntity("pp").GetLEDEquippedEntity().GetNumLEDs(), 10U);
  EXPECT_EQ(CPiPuckEntity("pp").GetTypeDescription(), "pipuck");
  EXPECT_EQ(CSpiriEntity("sp").GetLEDEquippedEntity().GetNumLEDs(), 0U);
  EXPECT_EQ(CSpiriEntity("sp").GetTypeDescription(), "spiri");
}

TEST(Argos3Entities, BoxesCylindersAndLightsHaveTheirSizes)
{
  const CQuaternion turned(CRadians(0.5), CVector3::Z);
  CBoxEntity box("box", CVector3(1, 2, 3), turned, true, CVector3(4, 5, 6));
  EXPECT_EQ(box.GetTypeDescription(), "box");
  EXPECT_EQ(box.GetSize(), CVector3(4, 5, 6));
  EXPECT_EQ(box.GetMass(), 1) << "unless another one is given";
  EXPECT_EQ(box.GetEmbodiedEntity().GetPosition(), CVector3(1, 2, 3));
  EXPECT_EQ(box.GetEmbodiedEntity().GetOrientation(), turned);
  EXPECT_TRUE(box.GetEmbodiedEntity().IsMovable());
  EXPECT_FALSE(CBoxEntity("box", CVector3(), turned, false, CVector3(1, 1, 1)).GetEmbodiedEntity().IsMovable());
  EXPECT_EQ(box.GetLEDEquippedEntity().GetNumLEDs(), 0U);
  box.Resize(CVector3(7, 8, 9));
  box.SetMass(2);
  EXPECT_EQ(box.GetSize(), CVector3(7, 8, 9));
  EXPECT_EQ(box.GetMass(), 2);
  CCylinderEntity cylinder("cylinder", CVector3(1, 2, 3), turned, true, 4, 5);
  EXPECT_EQ(cylinder.GetTypeDescription(), "cylinder");
  EXPECT_EQ(cylinder.GetRadius(), 4);
  EXPECT_EQ(cylinder.GetHeight(), 5);
  EXPECT_EQ(cylinder.GetMass(), 1);
  EXPECT_EQ(cylinder.GetEmbodiedEntity().GetPosition(), CVector3(1, 2, 3));
  EXPECT_EQ(cylinder.GetEmbodiedEntity().GetOrientation(), turned);
  cylinder.Resize(6, 7);
  cylinder.SetMass(3);
  EXPECT_EQ(cylinder.GetRadius() * 100 + cylinder.GetHeight() * 10 + cylinder.GetMass(), 673);
  // Their sizes are fixed in the arena, where the same values are accepted.
  box.SetIndex(0);
  cylinder.SetIndex(0);
  box.Resize(CVector3(7, 8, 9));
  box.SetMass(2);
  cylinder.Resize(6, 7);
  cylinder.SetMass(3);
  EXPECT_THROW(box.Resize(CVector3(7, 8, 1)), CARGoSException);
  EXPECT_THROW(box.SetMass(1), CARGoSException);
  EXPECT_THROW(cylinder.Resize(6, 1), CARGoSException);
  EXPECT_THROW(cylinder.Resize(1, 7), CARGoSException);
  EXPECT_THROW(cylinder.SetMass(1), CARGoSException);
  EXPECT_EQ(box.GetSize(), CVector3(7, 8, 9));

  const CLightEntity light("light", CVector3(1, 2, 3), CColor::RED, 0.5);
  EXPECT_EQ(light.GetTypeDescription(), "light");
  EXPECT_EQ(light.GetPosition(), CVector3(1, 2, 3));
  EXPECT_EQ(light.GetOrientation(), CQuaternion());
  EXPECT_EQ(light.GetColor(), CColor::RED);
  EXPECT_EQ(light.GetIntensity(), 0.5);
}

TEST(Argos3Entities, BodiesThatAreMadeHaveAShape)
{
  CBoxEntity box("box", CVector3(), CQuaternion(), true, CVector3(1, 2, 3), 4);
  const auto shape = swarmanoid::argos3::ShapeOf(box);
  ASSERT_TRUE(shape);
  EXPECT_EQ(shape->tag, "argos3_box");
  EXPECT_TRUE(shape->movable);
  EXPECT_EQ(shape->mass_kg, 4);
  EXPECT_EQ(shape->size, swarmanoid::Vector3(1, 2, 3));
  CCylinderEntity cylinder("cylinder", CVector3(), CQuaternion(), false, 0.5, 3, 1e12);
  const auto round = swarmanoid::argos3::ShapeOf(cylinder);
  ASSERT_TRUE(round);
  EXPECT_EQ(round->tag, "cylindric_prey");
  EXPECT_FALSE(round->movable);
  EXPECT_EQ(round->mass_kg, 1e9) << "the heaviest one";
  EXPECT_EQ(round->size, swarmanoid::Vector3(0.5, 0.5, 3));
  EXPECT_FALSE(swarmanoid::argos3::ShapeOf(CFootBotEntity("fb")));
  swarmanoid::argos3::DryRun run;
  CBoxEntity same("same", CVector3(), CQuaternion(), true, CVector3(1, 2, 3), 4);
  for (CEntity* made : {static_cast<CEntity*>(&box), static_cast<CEntity*>(&same), static_cast<CEntity*>(&cylinder),
                        static_cast<CEntity*>(&box)})
    run.Add(*made);
  EXPECT_TRUE(run.Has("same"));
  EXPECT_FALSE(run.Has("other"));
  const swarmanoid::argos3::MadeBodies shapes = run.Shapes();
  EXPECT_EQ(shapes.size(), 2U);
  EXPECT_EQ(shapes.at(*shape), 2) << "each id once";
  EXPECT_EQ(shapes.at(*round), 1);
}

TEST(Argos3Entities, ComponentsAreFoundByTypeAndId)
{
  CFootBotEntity robot("fb");
  EXPECT_EQ(robot.GetContext(), "");
  EXPECT_FALSE(robot.HasParent());
  EXPECT_THROW(robot.GetParent(), CARGoSException);
  EXPECT_EQ(&robot.GetRootEntity(), &robot);
  auto& led = robot.GetComponent<CLEDEntity>("leds.led[led_12]");
  EXPECT_EQ(led.GetId(), "led_12");
  EXPECT_EQ(led.GetContext(), "fb.leds_0.");
  EXPECT_TRUE(led.HasParent());
  EXPECT_EQ(&led.GetParent(), &robot.GetLEDEquippedEntity());
  EXPECT_EQ(&std::as_const(led).GetRootEntity(), &robot);
  EXPECT_EQ(&robot.GetComponent("leds.led"), &robot.GetLEDEquippedEntity().GetLED(0)) << "the first one";
  EXPECT_EQ(&robot.GetComponent("leds[leds_0].led[led_3]"), &robot.GetLEDEquippedEntity().GetLED(3));
  const std::pair<const char*, CEntity*> parts[] = {{"body", &robot.GetEmbodiedEntity()},
                                                    {"controller", &robot.GetControllableEntity()},
                                                    {"leds", &robot.GetLEDEquippedEntity()},
                                                    {"rab", &robot.GetRABEquippedEntity()},
                                                    {"gripper", &robot.GetGripperEquippedEntity()},
                                                    {"battery", &robot.GetBatterySensorEquippedEntity()},
                                                    {"wheels", &robot.GetWheeledEntity()},
                                                    {"proximity_sensors", &robot.GetProximitySensorEquippedEntity()},
                                                    {"light_sensors", &robot.GetLightSensorEquippedEntity()},
                                                    {"ground_sensors", &robot.GetGroundSensorEquippedEntity()}};
  for (const auto& [type, part] : parts)
  {
    EXPECT_EQ(&robot.GetComponent(type), part) << type;
    EXPECT_EQ(part->GetTypeDescription(), type);
    EXPECT_EQ(robot.GetComponentMap().count(type), 1U);
    EXPECT_EQ(part->GetIndex(), -1) << "it is in no arena";
  }
  EXPECT_EQ(robot.GetComponentVector().size(), std::size(parts));
  for (const char* none : {"led", "leds.led[led_13]", "body.led", "leds[leds_1]", "body[body_1]", ""})
    EXPECT_FALSE(robot.HasComponent(none)) << none;
  EXPECT_THROW(robot.GetComponent<CLEDEntity>("body"), CARGoSException);
  EXPECT_EQ(
      swarmanoid::test::MessageOf<CARGoSException>([&] { CBoxEntity("b", false, 0, CVector3(), 1).GetComponent("x"); }),
      "entity 'b' has no component 'x'; it has: body, leds");
  EXPECT_EQ(&robot.GetRABEquippedEntity().GetEntityBody(), &robot.GetEmbodiedEntity());
  robot.SetId("other");
  EXPECT_EQ(led.GetContext(), "other.leds_0.");
}

TEST(Argos3Entities, TheAntennaIsAboveTheBaseAndTurnsWithTheBody)
{
  CFootBotEntity robot("fb", "c", CVector3(1, 2, 3), CQuaternion(CRadians::PI_OVER_TWO, CVector3::Y));
  EXPECT_LT(Distance(robot.GetRABEquippedEntity().GetPosition(), CVector3(1.1, 2, 3)), kSmall);
  EXPECT_EQ(robot.GetRABEquippedEntity().GetOrientation(), robot.GetEmbodiedEntity().GetOrientation());
}

TEST(Argos3Entities, AnEntityIsEnabledWithItsParts)
{
  CFootBotEntity robot("fb");
  EXPECT_TRUE(robot.IsEnabled() && robot.GetWheeledEntity().IsEnabled());
  robot.GetLEDEquippedEntity().Disable();
  EXPECT_FALSE(robot.GetLEDEquippedEntity().GetLED(5).IsEnabled());
  EXPECT_TRUE(robot.GetWheeledEntity().IsEnabled());
  robot.GetLEDEquippedEntity().Enable();
  EXPECT_TRUE(robot.GetLEDEquippedEntity().GetLED(5).IsEnabled());
}

TEST(Argos3Entities, AnchorsMoveWithTheBody)
{
  CFootBotEntity robot("fb", "c", CVector3(1, 2, 0), CQuaternion(CRadians::PI_OVER_TWO, CVector3::Z));
  CEmbodiedEntity& body = robot.GetEmbodiedEntity();
  EXPECT_EQ(body.GetOriginAnchor().Id, "origin");
  EXPECT_EQ(body.GetOriginAnchor().Index, 0U);
  const CQuaternion tilt(CRadians(0.25), CVector3::X);
  SAnchor& mast = body.AddAnchor("mast", CVector3(0.1, 0, 0.2), tilt);
  SAnchor& plain = body.AddAnchor("plain");
  EXPECT_EQ(mast.Id, "mast");
  EXPECT_EQ(mast.Index, 1U);
  EXPECT_EQ(plain.Index, 2U);
  EXPECT_EQ(plain.OffsetPosition, CVector3());
  EXPECT_EQ(plain.OffsetOrientation, CQuaternion());
  EXPECT_EQ(mast.OffsetPosition, CVector3(0.1, 0, 0.2));
  EXPECT_LT(Distance(mast.Position, CVector3(1, 2.1, 0.2)), kSmall);
  EXPECT_EQ(mast.Orientation, body.GetOrientation() * tilt);
  EXPECT_EQ(&body.GetAnchor("mast"), &mast);
  EXPECT_EQ(&std::as_const(body).GetAnchor("origin"), &body.GetOriginAnchor());
  EXPECT_EQ(swarmanoid::test::MessageOf<CARGoSException>([&] { body.GetAnchor("mist"); }),
            "the body of 'fb' has no anchor 'mist'; it has: origin, mast, plain. AddAnchor makes others");
  EXPECT_THROW(body.AddAnchor("mast"), CARGoSException);
  EXPECT_THROW(body.AddAnchor("origin"), CARGoSException);
  EXPECT_FALSE(body.IsAnchorEnabled("mast"));
  body.EnableAnchor("mast");
  body.EnableAnchor("mast");
  body.DisableAnchor("mast");
  EXPECT_TRUE(body.IsAnchorEnabled("mast")) << "it was enabled twice";
  body.DisableAnchor("mast");
  body.DisableAnchor("mast");
  EXPECT_FALSE(body.IsAnchorEnabled("mast"));
  EXPECT_EQ(mast.InUseCount, 0U);
  body.GetOriginAnchor().Position.Set(0, 0, 5);
  body.UpdateAnchors();
  EXPECT_LT(Distance(mast.Position, CVector3(0, 0.1, 5.2)), kSmall);
}

TEST(Argos3Entities, LedsHaveTheirFirstColourOutsideARun)
{
  CBoxEntity box("box", CVector3(), CQuaternion(), true, CVector3(1, 1, 1));
  CLEDEquippedEntity& leds = box.GetLEDEquippedEntity();
  box.AddLED(CVector3(0, 0, 1));
  box.AddLED(CVector3(0, 0, 1), CColor::RED);
  leds.AddLED(CVector3(), box.GetEmbodiedEntity().GetOriginAnchor());
  leds.AddLEDRing(CVector3(), 1, CRadians(0), 3, box.GetEmbodiedEntity().GetOriginAnchor(), CColor::GREEN);
  leds.AddLEDRing(CVector3(), 1, CRadians(0), 1, box.GetEmbodiedEntity().GetOriginAnchor());
  std::vector<CColor> colours;
  for (UInt32 led = 0; led < leds.GetNumLEDs(); ++led) colours.push_back(leds.GetLED(led).GetColor());
  EXPECT_THAT(colours, ElementsAre(CColor::BLACK, CColor::RED, CColor::BLACK, CColor::GREEN, CColor::GREEN,
                                   CColor::GREEN, CColor::BLACK));
  EXPECT_EQ(leds.GetLED(1).GetInitColor(), CColor::RED);
  EXPECT_EQ(leds.GetLED(6).GetId(), "led_6");
  leds.GetLED(1).SetInitColor(CColor::BLUE);
  EXPECT_EQ(leds.GetLED(1).GetColor(), CColor::BLUE);
  EXPECT_THROW(leds.GetLED(7), CARGoSException);
  EXPECT_THROW(leds.SetLEDColor(0, CColor::RED), CARGoSException) << "no loop functions run";
  EXPECT_THROW(leds.SetAllLEDsColors(std::vector<CColor>(6)), CARGoSException);
  EXPECT_THROW(leds.SetAllLEDsColors(CColor::RED), CARGoSException);
  CFootBotEntity robot("fb");
  EXPECT_THROW(robot.GetLEDEquippedEntity().AddLED(CVector3(), robot.GetEmbodiedEntity().GetOriginAnchor()),
               CARGoSException)
      << "a robot has the LEDs of its kind";
  EXPECT_EQ(robot.GetLEDEquippedEntity().GetLED(12).GetColor(), CColor::BLACK);
}

TEST(Argos3Entities, WhatNeedsARunIsRefusedWithoutOne)
{
  CFootBotEntity robot("fb");
  CLightEntity light("light", CVector3(), CColor::RED, 1);
  CBoxEntity box("box", CVector3(), CQuaternion(), true, CVector3(1, 1, 1));
  CLoopFunctions functions;
  EXPECT_FALSE(robot.GetGripperEquippedEntity().IsGripping());
  EXPECT_THROW(robot.GetGripperEquippedEntity().GetGrippedEntity(), CARGoSException);
  EXPECT_THROW(robot.GetBatterySensorEquippedEntity().GetAvailableCharge(), CARGoSException);
  EXPECT_THROW(robot.GetBatterySensorEquippedEntity().GetFullCharge(), CARGoSException);
  EXPECT_THROW(robot.GetBatterySensorEquippedEntity().SetAvailableCharge(1), CARGoSException);
  robot.GetBatterySensorEquippedEntity().Reset();
  EXPECT_THROW(robot.GetControllableEntity().GetController(), CARGoSException);
  EXPECT_THROW(robot.GetRABEquippedEntity().GetData(), CARGoSException);
  EXPECT_THROW(robot.GetRABEquippedEntity().GetMsgSize(), CARGoSException);
  EXPECT_THROW(robot.GetRABEquippedEntity().GetRange(), CARGoSException);
  EXPECT_THROW(robot.GetEmbodiedEntity().GetBoundingBox(), CARGoSException);
  EXPECT_THROW(robot.GetEmbodiedEntity().IsCollidingWithSomething(), CARGoSException);
  EXPECT_THROW(robot.GetEmbodiedEntity().MoveTo(CVector3(), CQuaternion()), CARGoSException);
  EXPECT_THROW(light.MoveTo(CVector3(), CQuaternion()), CARGoSException);
  EXPECT_THROW(light.SetColor(CColor::BLUE), CARGoSException);
  EXPECT_THROW(light.SetIntensity(2), CARGoSException);
  EXPECT_EQ(light.GetColor(), CColor::RED);
  EXPECT_EQ(light.GetIntensity(), 1);
  EXPECT_THROW(functions.RemoveEntity("fb"), CARGoSException);
  EXPECT_THROW(functions.RemoveEntity(robot), CARGoSException);
  CSimulator& simulator = CSimulator::GetInstance();
  EXPECT_THROW(simulator.GetLoopFunctions(), CARGoSException);
  EXPECT_THROW(simulator.GetConfigurationRoot(), CARGoSException);
  EXPECT_THROW(simulator.GetRNG(), CARGoSException);
  EXPECT_THROW(simulator.Execute(), CARGoSException);
  EXPECT_THROW(simulator.UpdateSpace(), CARGoSException);
  EXPECT_THROW(simulator.IsExperimentFinished(), CARGoSException);
  EXPECT_THROW(simulator.Reset(), CARGoSException);
  simulator.Destroy();
  EXPECT_FALSE(simulator.IsTerminated());
  simulator.Terminate();
  EXPECT_TRUE(simulator.IsTerminated());
  EXPECT_FALSE(simulator.IsRealTimeClock() || simulator.IsProfiling());
  EXPECT_EQ(simulator.GetNumThreads(), 0U);
  EXPECT_EQ(functions.GetFloorColor(CVector2()), CColor::WHITE);
  EXPECT_FALSE(functions.IsExperimentFinished());
  TEmbodiedEntityIntersectionData met;
  EXPECT_THROW(GetEmbodiedEntitiesIntersectedByRay(met, CRay3()), CARGoSException);
}

TEST(Argos3Entities, PhysicsModelsAreOfTheOnlyEngine)
{
  CFootBotEntity robot("fb");
  CEmbodiedEntity& body = robot.GetEmbodiedEntity();
  EXPECT_EQ(body.GetPhysicsModelsNum(), 1U);
  CPhysicsModel& model = body.GetPhysicsModel("mine");
  EXPECT_EQ(model.GetEngine().GetId(), "mine");
  EXPECT_EQ(&model.GetEmbodiedEntity(), &body);
  EXPECT_EQ(&std::as_const(body).GetPhysicsModel(0), &model);
  EXPECT_THROW(body.GetPhysicsModel(1), CARGoSException);
  EXPECT_EQ(CSimulator::GetInstance().GetPhysicsEngines().size(), 1U);
  EXPECT_EQ(CSimulator::GetInstance().GetMedium<CRABMedium>("rab").GetId(), "rab");
  EXPECT_EQ(CPhysicsEngine::GetSimulationClockTick(), 0.1) << "s, unless the experiment says otherwise";
}

TEST(Argos3Entities, IntersectionsAreInTheOrderOfTheRay)
{
  CFootBotEntity robot("fb");
  const SEmbodiedEntityIntersectionItem none;
  EXPECT_EQ(none.IntersectedEntity, nullptr);
  EXPECT_EQ(none.TOnRay, 1);
  const SEmbodiedEntityIntersectionItem near(&robot.GetEmbodiedEntity(), 0.25);
  EXPECT_EQ(near.IntersectedEntity, &robot.GetEmbodiedEntity());
  EXPECT_TRUE(near < none);
  EXPECT_FALSE(none < near);
  EXPECT_FALSE(near < near);
}

TEST(Argos3Entities, ASpaceListsItsEntities)
{
  CSpace space;
  CFootBotEntity robot("fb_1"), other("fb_2");
  CBoxEntity box("wall", false, 0, CVector3(1, 1, 1), 1);
  CCylinderEntity cylinder("can", false, 0, 1, 1, 1);
  CLightEntity light("lamp", CVector3(), CColor::RED, 1);
  CKilobotEntity kilobot("kb");
  CEPuckEntity e_puck("ep");
  CEyeBotEntity eye_bot("eb");
  CPiPuckEntity pi_puck("pp");
  CSpiriEntity spiri("sp");
  CFloorEntity floor(nullptr, "floor");
  CEntity* const all[] = {&robot, &other, &box, &cylinder, &light, &kilobot, &e_puck, &eye_bot, &pi_puck, &spiri};
  for (CEntity* entity : all) space.InsertAny(*entity);
  space.InsertAny(floor);
  EXPECT_EQ(space.GetNumberEntities(), 10U) << "other types are left out";
  EXPECT_EQ(space.GetEntityVector(), std::vector<CEntity*>(std::begin(all), std::end(all)));
  EXPECT_EQ(space.GetRootEntityVector(), space.GetEntityVector());
  EXPECT_EQ(space.GetEntityMapPerId().size(), 10U);
  for (ssize_t i = 0; i < 10; ++i)
  {
    EXPECT_EQ(all[i]->GetIndex(), i);
    EXPECT_EQ(&space.GetEntity(all[i]->GetId()), all[i]);
    EXPECT_EQ(space.GetEntitiesByType(all[i]->GetTypeDescription()).count(all[i]->GetId()), 1U);
  }
  EXPECT_TRUE(SEntityComparator()(&robot, &other) && SEntityComparator()(robot, other));
  EXPECT_FALSE(SEntityComparator()(&other, &robot) || SEntityComparator()(robot, robot));
  EXPECT_EQ(robot.GetWheeledEntity().GetIndex(), 0) << "that of its root";
  EXPECT_THROW(space.GetEntity("none"), CARGoSException);
  EXPECT_THROW(space.GetEntitiesByType("none"), CARGoSException);
  EXPECT_EQ(any_cast<CFootBotEntity*>(space.GetEntitiesByType("foot-bot")["fb_2"]), &other);
  EXPECT_EQ(any_cast<CEmbodiedEntity*>(space.GetEntitiesByType("body")["wall.body_0"]), &box.GetEmbodiedEntity());
  const std::pair<const char*, std::size_t> parts[] = {
      {"body", 9}, {"controller", 7}, {"rab", 7}, {"battery", 7}, {"wheels", 4}};
  for (const auto& [type, count] : parts) EXPECT_EQ(space.GetEntitiesByType(type).size(), count) << type;
  EXPECT_EQ(space.GetEntityMapPerTypePerId().count("foot-bot"), 1U);
  CEntity::TVector found;
  space.GetEntitiesMatching(found, "^fb_[0-9]$");
  EXPECT_THAT(found, ElementsAre(&robot, &other));
  std::vector<CControllableEntity*> robots;
  space.IterateOverControllableEntities([&](CControllableEntity* one) { robots.push_back(one); });
  EXPECT_EQ(robots.size(), 7U);
  EXPECT_EQ(robots.front(), &robot.GetControllableEntity());

  space.SetArena(CVector3(4, 6, 2), CVector3(1, 0, 1));
  EXPECT_EQ(space.GetArenaSize(), CVector3(4, 6, 2));
  EXPECT_EQ(space.GetArenaCenter(), CVector3(1, 0, 1));
  EXPECT_EQ(space.GetArenaLimits().GetMin(), CVector3(-1, -3, 0));
  EXPECT_EQ(space.GetArenaLimits().GetMax(), CVector3(3, 3, 2));
  EXPECT_EQ(space.GetSimulationClock(), 0U);
  space.SetSimulationClock(7);
  EXPECT_EQ(space.GetSimulationClock(), 7U);
  EXPECT_THROW(space.GetFloorEntity(), CARGoSException);
  space.SetFloor(&floor);
  EXPECT_EQ(&space.GetFloorEntity(), &floor);
  EXPECT_EQ(floor.GetTypeDescription(), "floor");
  EXPECT_FALSE(floor.HasChanged());
  space.Clear();
  EXPECT_EQ(space.GetNumberEntities(), 0U);
  EXPECT_TRUE(space.GetEntityMapPerId().empty());
  EXPECT_TRUE(space.GetEntitiesByType("foot-bot").empty()) << "the type stays";
}

TEST(Argos3Entities, TranslationsAreReadFromTheConvertedFile)
{
  using swarmanoid::argos3::Translation;
  const auto read = [](const std::string& attributes)
  {
    return Translation::From(
        swarmanoid::TConfigurationTree(swarmanoid::ReadXml("<a origin='1,2,3' " + attributes + "/>", "f.xml")));
  };
  const Translation translation = read("distributed='fb:10:fb eb:0:eb my%20wall::my_wall a:b:5:c'");
  EXPECT_EQ(translation.origin, swarmanoid::Vector3(1, 2, 3));
  EXPECT_EQ(translation.OurPosition(CVector3(1, 1, 1)), swarmanoid::Vector3(2, 3, 4));
  EXPECT_EQ(translation.Argos3Position({2, 3, 4}), CVector3(1, 1, 1));
  const std::pair<const char*, const char*> ids[] = {{"fb10", "fb_0"},       {"fb12", "fb_2"}, {"eb0", "eb_0"},
                                                     {"my wall", "my_wall"}, {"a:b5", "c_0"},  {"wall", "wall"}};
  for (const auto& [theirs, ours] : ids)
  {
    EXPECT_EQ(translation.OurId(theirs), ours);
    EXPECT_EQ(translation.Argos3Id(ours), theirs);
  }
  EXPECT_EQ(read("").OurId("fb10"), "fb10");
  for (const char* wrong : {"fb", "fb:1", ":1"})
    EXPECT_THROW(read(std::string("distributed='") + wrong + "'"), swarmanoid::ConfigurationError) << wrong;
  // A quaternion of zeros turns nothing.
  EXPECT_EQ(swarmanoid::argos3::OurOrientation(CQuaternion(0, 0, 0, 0)).w(), 1);
  const swarmanoid::Quaternion ours = swarmanoid::argos3::OurOrientation(CQuaternion(2, 0, 0, 2));
  EXPECT_NEAR(ours.z(), std::sqrt(0.5), kSmall);
  EXPECT_EQ(swarmanoid::argos3::Argos3Orientation({0.1, 0.2, 0.3, 0.4}), CQuaternion(0.1, 0.2, 0.3, 0.4));
  // Colours are 0xRRGGBB here.
  TheRunning().taken["made"] = "added_c_3";
  EXPECT_EQ(TheRunning().OurId("made"), "added_c_3");
  TheRunning().taken.clear();
  EXPECT_EQ(TheRunning().OurId("made"), "made");
}

TEST(Argos3Entities, PositionsOfLightsAreViews)
{
  CLightEntity light("light", CVector3(1, 2, 3), CColor::RED, 1);
  light.SetPosition(CVector3(4, 5, 6));
  light.SetOrientation(CQuaternion(0, 1, 0, 0));
  EXPECT_EQ(light.GetPosition(), CVector3(4, 5, 6));
  EXPECT_EQ(light.GetOrientation(), CQuaternion(0, 1, 0, 0));
  EXPECT_EQ(CPositionalEntity(nullptr, "x").GetTypeDescription(), "position");
  EXPECT_EQ(CComposableEntity("x").GetTypeDescription(), "composite");
  EXPECT_EQ(CEntity().GetTypeDescription(), "entity");
}

}  // namespace
