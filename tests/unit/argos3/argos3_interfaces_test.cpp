// The classes that controllers of ARGoS3 hold, without a run: devices, keys, and constants of OpenGL and Kilobots.
#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_base_leds_actuator.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_ground_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_light_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_omnidirectional_camera_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_proximity_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_range_and_bearing_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_rgb_leds_actuator.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_wheels_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_base_ground_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_distance_scanner_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_gripper_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_motor_ground_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_turret_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_turret_encoder_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_battery_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_colored_blob_omnidirectional_camera_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_colored_blob_perspective_camera_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_ground_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_leds_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_light_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_positioning_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_proximity_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_ground_sensor.h>
#include <argos3/plugins/robots/kilobot/control_interface/ci_kilobot_led_actuator.h>
#include <argos3/plugins/robots/kilobot/control_interface/kilolib.h>
#include <argos3/plugins/robots/kilobot/simulator/kilobot_measures.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_leds_actuator.h>
#include <argos3/plugins/simulator/visualizations/qt-opengl/gl_names.h>
#include <argos3/plugins/simulator/visualizations/qt-opengl/qt_names.h>
#undef main
#include <gmock/gmock.h>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/world/message_of.h"

namespace
{

using namespace argos;
using swarmanoid::test::MessageOf;

TEST(Argos3Interfaces, ControllersFindTheirDevicesByTag)
{
  struct Controller : public CCI_Controller
  {
  } controller;
  controller.SetId("fb7");
  EXPECT_EQ(controller.GetId(), "fb7");
  EXPECT_EQ(MessageOf<CARGoSException>([&] { controller.GetSensor<CCI_BatterySensor>("battery"); }),
            "robot 'fb7' has no sensor 'battery'; its controller lists none. Add <battery> to <sensors> of the "
            "controller in the experiment file");
  CCI_BatterySensor battery;
  CCI_GroundSensor ground;
  CCI_EPuckRGBLEDsActuator leds;
  controller.AddSensor("battery", &battery);
  controller.AddSensor("ground", &ground);
  controller.AddActuator("leds", &leds);
  EXPECT_EQ(controller.GetSensor<CCI_BatterySensor>("battery"), &battery);
  EXPECT_EQ(controller.GetActuator<CCI_EPuckRGBLEDsActuator>("leds"), &leds);
  EXPECT_TRUE(controller.HasSensor("ground") && controller.HasActuator("leds"));
  EXPECT_FALSE(controller.HasSensor("leds") || controller.HasActuator("ground"));
  EXPECT_EQ(controller.GetAllSensors().size(), 2U);
  EXPECT_EQ(controller.GetAllActuators().size(), 1U);
  EXPECT_THAT(MessageOf<CARGoSException>([&] { controller.GetSensor<CCI_BatterySensor>("ground"); }),
              testing::HasSubstr("the sensor 'ground' of robot 'fb7' is not of the type"));
  EXPECT_THAT(MessageOf<CARGoSException>([&] { controller.GetActuator<CCI_EPuckRGBLEDsActuator>("wheels"); }),
              testing::HasSubstr("has no actuator 'wheels'; its controller lists leds. Add <wheels> to <actuators>"));
  EXPECT_THAT(MessageOf<CARGoSException>([&] { controller.GetSensor<CCI_BatterySensor>("light"); }),
              testing::HasSubstr("lists battery, ground."));
}

struct CountingReader : public CSensorReader
{
  void Read() override { ++reads; }
  int reads = 0;
};

// Readings are taken once when they are asked for the first time.
template <class Sensor, class Get>
void ExpectReadsOnce(const Get& get)
{
  Sensor sensor;
  CountingReader reader;
  get(sensor);
  EXPECT_EQ(reader.reads, 0) << "no reader is there";
  for (int step = 1; step <= 2; ++step)
  {
    sensor.ReadOnDemand(reader);
    EXPECT_EQ(reader.reads, step - 1);
    get(sensor);
    get(sensor);
    EXPECT_EQ(reader.reads, step);
  }
}

TEST(Argos3Interfaces, SensorsReadWhenTheyAreAsked)
{
  const auto readings = [](const auto& sensor) { static_cast<void>(sensor.GetReadings()); };
  ExpectReadsOnce<CCI_FootBotBaseGroundSensor>(readings);
  ExpectReadsOnce<CCI_FootBotMotorGroundSensor>(readings);
  ExpectReadsOnce<CCI_ColoredBlobOmnidirectionalCameraSensor>(readings);
  ExpectReadsOnce<CCI_ColoredBlobPerspectiveCameraSensor>(readings);
  ExpectReadsOnce<CCI_GroundSensor>(readings);
  ExpectReadsOnce<CCI_LightSensor>(readings);
  ExpectReadsOnce<CCI_ProximitySensor>(readings);
  ExpectReadsOnce<CCI_RangeAndBearingSensor>(readings);
  ExpectReadsOnce<CRingSensor>(readings);
  ExpectReadsOnce<CCI_PositioningSensor>([](const auto& sensor) { static_cast<void>(sensor.GetReading()); });
  ExpectReadsOnce<CCI_FootBotDistanceScannerSensor>([](const auto& sensor)
                                                    { static_cast<void>(sensor.GetReadingsMap()); });
  ExpectReadsOnce<CCI_FootBotDistanceScannerSensor>([](const auto& sensor)
                                                    { static_cast<void>(sensor.GetShortReadingsMap()); });
  ExpectReadsOnce<CCI_FootBotDistanceScannerSensor>([](const auto& sensor)
                                                    { static_cast<void>(sensor.GetLongReadingsMap()); });
  CCI_EPuckOmnidirectionalCameraSensor camera;
  EXPECT_TRUE(camera.IsEnabled() && !camera.IsDisabled() && camera.Enabled());
  camera.Disable();
  EXPECT_TRUE(!camera.IsEnabled() && camera.IsDisabled() && !camera.Enabled());
  camera.Enable();
  EXPECT_TRUE(camera.IsEnabled());
}

TEST(Argos3Interfaces, ReadingsAreZeroAtFirst)
{
  EXPECT_EQ(CCI_BatterySensor().GetReading().AvailableCharge, 1) << "full";
  EXPECT_EQ(CCI_BatterySensor().GetReading().TimeLeft, 0);
  const CCI_DifferentialSteeringSensor steering;
  const auto& rolled = steering.GetReading();
  EXPECT_EQ(rolled.VelocityLeftWheel, 0);
  EXPECT_EQ(rolled.VelocityRightWheel, 0);
  EXPECT_EQ(rolled.CoveredDistanceLeftWheel, 0);
  EXPECT_EQ(rolled.CoveredDistanceRightWheel, 0);
  EXPECT_EQ(rolled.WheelAxisLength, 0);
  EXPECT_EQ(CCI_FootBotTurretEncoderSensor().GetRotation().GetValue(), 0);
  EXPECT_EQ(CCI_RangeAndBearingSensor::SPacket().Range, 0);
  EXPECT_EQ(CCI_EPuckRangeAndBearingSensor::SReceivedPacket().Range, 0);
  EXPECT_EQ(CCI_ColoredBlobOmnidirectionalCameraSensor().GetReadings().Counter, 0U);
  EXPECT_EQ(CCI_ColoredBlobPerspectiveCameraSensor().GetReadings().Counter, 0U);
  EXPECT_EQ(CCI_EPuckOmnidirectionalCameraSensor().GetReadings().Counter, 0U);
  EXPECT_EQ(CCI_EPuckOmnidirectionalCameraSensor::SBlob().Area, 0U);
  EXPECT_EQ(CCI_EPuckOmnidirectionalCameraSensor::SBlob().Distance, 0);
  EXPECT_EQ(CRingSensor::SReading().Value, 0);
  const CRingSensor::SReading ring(0.5, CRadians(2));
  EXPECT_EQ(ring.Value * 10 + ring.Angle.GetValue(), 7);
  const CCI_FootBotBaseGroundSensor::SReading base(0.5, CVector2(1, 2));
  EXPECT_EQ(base.Value, 0.5);
  EXPECT_EQ(base.Offset, CVector2(1, 2));
  const CCI_FootBotMotorGroundSensor::SReading motor(0.25, CVector2(3, 4));
  EXPECT_EQ(motor.Value, 0.25);
  EXPECT_EQ(motor.Offset, CVector2(3, 4));
  const CCI_KheperaIVGroundSensor::SReading khepera(0.75, CVector2(5, 6));
  EXPECT_EQ(khepera.Value, 0.75);
  EXPECT_EQ(khepera.Offset, CVector2(5, 6));
  EXPECT_THROW(CCI_EPuckLightSensor().GetReading(0), std::out_of_range);
  EXPECT_THROW(CCI_EPuckProximitySensor().GetReading(0), std::out_of_range);
}

TEST(Argos3Interfaces, BlobsAndPacketsAreTexts)
{
  CCI_ColoredBlobPerspectiveCameraSensor::SBlob pixel(CColor::RED, 5, 7);
  EXPECT_EQ(ToString(pixel), "red at 5,7");
  EXPECT_EQ(CCI_ColoredBlobPerspectiveCameraSensor::SBlob().X + CCI_ColoredBlobPerspectiveCameraSensor::SBlob().Y, 0);
  CCI_EPuckOmnidirectionalCameraSensor::SBlob blob;
  EXPECT_EQ(blob.Color, CColor::BLACK);
  blob.Color = CColor::BLUE;
  blob.Distance = 12;
  blob.Area = 3;
  EXPECT_EQ(ToString(blob), "(Color = blue,Angle = CDegrees(0),Distance = 12, Area = 3)");
  CCI_EPuckRangeAndBearingSensor::SReceivedPacket packet;
  packet.Range = 5;
  for (UInt8 i = 0; i < 4; ++i) packet.Data[i] = static_cast<UInt8>(200 + i);
  EXPECT_EQ(ToString(packet), "Received range < 5 > Bearing < CRadians(0 -> 0 degrees) > Data < 200 201 202 203 >");
}

TEST(Argos3Interfaces, GroundSensorsOfAnEPuckAreLeftCenterAndRight)
{
  struct Ground : public CCI_EPuckGroundSensor
  {
    Ground()
    {
      m_sReadings.Left = 0.1;
      m_sReadings.Center = 0.2;
      m_sReadings.Right = 0.3;
    }
    void Clear() { m_sReadings.Reset(); }
  } ground;
  Real copied[3]{};
  ground.GetReadings(copied);
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_DOUBLE_EQ(copied[i], 0.1 * static_cast<double>(i + 1));
    EXPECT_EQ(ground.GetReading(i), copied[i]);
  }
  EXPECT_THROW(ground.GetReading(3), CARGoSException);
  ground.Clear();
  EXPECT_EQ(ground.GetReadings().Left + ground.GetReadings().Center + ground.GetReadings().Right, 0);
}

TEST(Argos3Interfaces, LedsHaveColoursAndIntensities)
{
  struct Leds : public CCI_LEDsActuator
  {
    Leds() { m_tSettings.resize(3); }
    const TSettings& Settings() const { return m_tSettings; }
  } leds;
  EXPECT_EQ(leds.GetNumLEDs(), 3U);
  leds.SetAllColors(CColor::RED);
  leds.SetSingleColor(2, CColor::BLUE);
  EXPECT_EQ(leds.Settings(), (std::vector<CColor>{CColor::RED, CColor::RED, CColor::BLUE}));
  EXPECT_THROW(leds.SetSingleColor(3, CColor::RED), CARGoSException);
  EXPECT_THROW(leds.SetSingleIntensity(3, 1), CARGoSException);
  EXPECT_THROW(leds.SetAllColors(std::vector<CColor>(2)), CARGoSException);
  EXPECT_THROW(leds.SetAllColors(std::vector<CColor>(4)), CARGoSException);
  leds.SetAllColors(std::vector<CColor>{CColor::GREEN, CColor::WHITE, CColor::CYAN});
  leds.SetAllIntensities(7);
  leds.SetSingleIntensity(0, 9);
  EXPECT_EQ(leds.Settings(),
            (std::vector<CColor>{CColor(0, 255, 0, 9), CColor(255, 255, 255, 7), CColor(0, 255, 255, 7)}));
}

TEST(Argos3Interfaces, LedsOfAnEPuck)
{
  struct Coloured : public CCI_EPuckRGBLEDsActuator
  {
    const TLEDSettings& Settings() const { return m_tLEDSettings; }
  } coloured;
  EXPECT_EQ(coloured.Settings(), (std::vector<CColor>(3, CColor::BLACK)));
  coloured.SetColors(CColor::RED);
  coloured.SetColor(1, CColor::BLUE);
  EXPECT_EQ(coloured.Settings(), (std::vector<CColor>{CColor::RED, CColor::BLUE, CColor::RED}));
  EXPECT_THROW(coloured.SetColor(3, CColor::BLUE), std::out_of_range);
  coloured.SetColors(std::vector<CColor>{CColor::WHITE, CColor::CYAN, CColor::GREEN, CColor::RED});
  EXPECT_EQ(coloured.Settings(), (std::vector<CColor>{CColor::WHITE, CColor::CYAN, CColor::GREEN}));
  EXPECT_THROW(coloured.SetColors(std::vector<CColor>(2)), std::out_of_range);

  struct Red : public CCI_EPuckBaseLEDsActuator
  {
    unsigned Settings() const { return m_unLEDSettings; }
  } red;
  EXPECT_EQ(red.Settings(), 0U);
  red.SwitchLED(0, true);
  red.SwitchLED(5, true);
  EXPECT_EQ(red.Settings(), 33U);
  red.SwitchLED(0, false);
  red.SwitchLED(1, false);
  EXPECT_EQ(red.Settings(), 32U);
  red.SwitchLEDs(true);
  EXPECT_EQ(red.Settings(), 255U);
  red.SwitchLED(7, false);
  EXPECT_EQ(red.Settings(), 127U);
  red.SwitchLEDs(false);
  EXPECT_EQ(red.Settings(), 0U);

  EXPECT_EQ(CCI_EPuckWheelsActuator::MAX_VELOCITY_CM_SEC, 30);
  EXPECT_EQ(CCI_EPuckWheelsActuator::MIN_VELOCITY_CM_SEC, -30);
}

TEST(Argos3Interfaces, EmittersOfAnEPuckSendTheSameOrDifferentData)
{
  struct Sender : public CCI_EPuckRangeAndBearingActuator
  {
    const SDataToSend& Desired() const { return m_sDesiredData; }
    int Enabled() const
    {
      int enabled = 0;
      for (const SEmitter& emitter : m_sDesiredData.Emitter) enabled += emitter.Enabled ? 1 : 0;
      return enabled;
    }
  } sender;
  EXPECT_EQ(sender.Desired().State, CCI_EPuckRangeAndBearingActuator::STATE_ALL_EMITTERS_DISABLED);
  EXPECT_EQ(sender.Enabled(), 0);
  const UInt8 data[]{1, 2, 3, 4}, other[]{5, 6, 7, 8};
  sender.SetData(data);
  EXPECT_EQ(sender.Desired().State, CCI_EPuckRangeAndBearingActuator::STATE_ALL_EMITTERS_SAME_DATA);
  EXPECT_EQ(sender.Enabled(), 12);
  sender.SetDataForEmitter(11, other);
  EXPECT_EQ(sender.Desired().State, CCI_EPuckRangeAndBearingActuator::STATE_EMITTERS_DIFFERENT);
  EXPECT_TRUE(std::equal(data, data + 4, sender.Desired().Emitter[0].Data));
  EXPECT_TRUE(std::equal(data, data + 4, sender.Desired().Emitter[10].Data));
  EXPECT_TRUE(std::equal(other, other + 4, sender.Desired().Emitter[11].Data));
  sender.DisableEmitter(3);
  EXPECT_EQ(sender.Enabled(), 11);
  EXPECT_FALSE(sender.Desired().Emitter[3].Enabled);
  EXPECT_THROW(sender.SetDataForEmitter(12, data), CARGoSException);
  EXPECT_THROW(sender.DisableEmitter(12), CARGoSException);
  sender.Reset();
  EXPECT_EQ(sender.Desired().State, CCI_EPuckRangeAndBearingActuator::STATE_ALL_EMITTERS_DISABLED);
  EXPECT_EQ(sender.Enabled(), 0);
}

TEST(Argos3Interfaces, MessagesOfRangeAndBearingHaveTheirSize)
{
  struct Sender : public CCI_RangeAndBearingActuator
  {
    Sender() { m_cData.Resize(3); }
    const CByteArray& Data() const { return m_cData; }
  } sender;
  EXPECT_EQ(sender.GetSize(), 3U);
  const UInt8 bytes[]{1, 2, 3};
  sender.SetData(bytes);
  EXPECT_EQ(sender.Data(), CByteArray(bytes, 3));
  sender.SetData(1, 9);
  EXPECT_EQ(ToString(sender.Data()), "1 9 3");
  EXPECT_THROW(sender.SetData(3, 9), CARGoSException);
  EXPECT_THROW(sender.SetData(CByteArray(2)), CARGoSException);
  EXPECT_THROW(sender.SetData(CByteArray(4)), CARGoSException);
  sender.SetData(CByteArray(3, 5));
  EXPECT_EQ(ToString(sender.Data()), "5 5 5");
  sender.ClearData();
  EXPECT_EQ(ToString(sender.Data()), "0 0 0");

  struct Receiver : public CCI_EPuckRangeAndBearingSensor
  {
    Receiver() { m_tPackets.push_back(&packet); }
    SReceivedPacket packet;
  } receiver;
  EXPECT_EQ(receiver.GetPackets().size(), 1U);
  receiver.ClearPackets();
  EXPECT_TRUE(receiver.GetPackets().empty());
}

TEST(Argos3Interfaces, GrippersAndTurretsOfAFootBot)
{
  struct Gripper : public CCI_FootBotGripperActuator
  {
    void SetAperture(const CRadians& aperture) override { at = aperture.GetValue(); }
    double at = 9;
  } gripper;
  gripper.LockPositive();
  EXPECT_DOUBLE_EQ(gripper.at, std::acos(0.0));
  gripper.LockNegative();
  EXPECT_DOUBLE_EQ(gripper.at, -std::acos(0.0));
  gripper.Unlock();
  EXPECT_EQ(gripper.at, 0);

  struct Turret : public CCI_FootBotTurretActuator
  {
    void SetRotation(const CRadians& to) override { told += "to " + ToString(to.GetValue()) + " "; }
    void SetRotationSpeed(SInt32) override {}
    void SetMode(ETurretModes mode) override { told += std::to_string(mode) + " "; }
    std::string told;
  } turret;
  turret.SetOffMode();
  turret.SetPassiveMode();
  turret.SetSpeedControlMode();
  turret.SetPositionControlMode();
  turret.SetActiveWithRotation(CRadians(0.5));
  EXPECT_EQ(turret.told, "0 1 2 3 3 to 0.5 ");
  EXPECT_TRUE(turret.IsTurretAvailableForCommands());

  struct PiPuckLeds : public CCI_PiPuckLEDsActuator
  {
    static std::vector<UInt32> Numbers() { return {+NUM_LEDS, +NUM_RING_LEDS, +INDEX_FRONT_LED, +INDEX_BODY_LED}; }
  };
  EXPECT_THAT(PiPuckLeds::Numbers(), testing::ElementsAre(10, 8, 8, 9));
}

TEST(Argos3Interfaces, ConstantsOfKilobotsAreThoseOfTheirLibraries)
{
  EXPECT_EQ(RGB(3, 2, 1), 27);
  EXPECT_EQ(RGB(4, 5, 7), 52) << "two bits for each";
  EXPECT_EQ(RED(27) * 100 + GREEN(27) * 10 + BLUE(27), 321);
  EXPECT_EQ(RED(63), 3);
  EXPECT_EQ(GREEN(12), 3);
  EXPECT_EQ(BLUE(48), 3);
  EXPECT_EQ(TICKS_PER_SEC, 31);
  EXPECT_EQ(KILOBOT_MAX_RX, 4);
  // These are the measures of kilobot_measures.cpp, m.
  EXPECT_EQ(KILOBOT_RADIUS, 0.0165);
  EXPECT_EQ(KILOBOT_ECCENTRICITY, 0.0092);
  EXPECT_DOUBLE_EQ(KILOBOT_HEIGHT, 0.0344);
  EXPECT_DOUBLE_EQ(KILOBOT_HALF_INTERPIN_DISTANCE, 0.0125);
  EXPECT_EQ(KILOBOT_INTERPIN_DISTANCE, 0.025);
  EXPECT_EQ(KILOBOT_FRONT_PIN_DISTANCE, 0.025);
  EXPECT_EQ(KILOBOT_PIN_RADIUS, 0.0007);
  EXPECT_EQ(KILOBOT_MASS, 0.01);
  struct Led : public CCI_KilobotLEDActuator
  {
    const CColor& Colour() const { return m_cColor; }
  } led;
  EXPECT_EQ(led.Colour(), CColor::BLACK);
  led.SetColor(CColor::RED);
  EXPECT_EQ(led.Colour(), CColor::RED);
}

TEST(Argos3Interfaces, KeysHaveTheNumbersOfQt)
{
  const std::string signs = " !\"#$%&'()*+,-./0123456789:;<=>?@ABCDEFGHIJKLMNOPQRSTUVWXYZ[\\]^_`";
  const Qt::Key keys[] = {Qt::Key_Space,       Qt::Key_Exclam,
                          Qt::Key_QuoteDbl,    Qt::Key_NumberSign,
                          Qt::Key_Dollar,      Qt::Key_Percent,
                          Qt::Key_Ampersand,   Qt::Key_Apostrophe,
                          Qt::Key_ParenLeft,   Qt::Key_ParenRight,
                          Qt::Key_Asterisk,    Qt::Key_Plus,
                          Qt::Key_Comma,       Qt::Key_Minus,
                          Qt::Key_Period,      Qt::Key_Slash,
                          Qt::Key_0,           Qt::Key_1,
                          Qt::Key_2,           Qt::Key_3,
                          Qt::Key_4,           Qt::Key_5,
                          Qt::Key_6,           Qt::Key_7,
                          Qt::Key_8,           Qt::Key_9,
                          Qt::Key_Colon,       Qt::Key_Semicolon,
                          Qt::Key_Less,        Qt::Key_Equal,
                          Qt::Key_Greater,     Qt::Key_Question,
                          Qt::Key_At,          Qt::Key_A,
                          Qt::Key_B,           Qt::Key_C,
                          Qt::Key_D,           Qt::Key_E,
                          Qt::Key_F,           Qt::Key_G,
                          Qt::Key_H,           Qt::Key_I,
                          Qt::Key_J,           Qt::Key_K,
                          Qt::Key_L,           Qt::Key_M,
                          Qt::Key_N,           Qt::Key_O,
                          Qt::Key_P,           Qt::Key_Q,
                          Qt::Key_R,           Qt::Key_S,
                          Qt::Key_T,           Qt::Key_U,
                          Qt::Key_V,           Qt::Key_W,
                          Qt::Key_X,           Qt::Key_Y,
                          Qt::Key_Z,           Qt::Key_BracketLeft,
                          Qt::Key_Backslash,   Qt::Key_BracketRight,
                          Qt::Key_AsciiCircum, Qt::Key_Underscore,
                          Qt::Key_QuoteLeft};
  ASSERT_EQ(std::size(keys), signs.size());
  for (std::size_t i = 0; i < signs.size(); ++i) EXPECT_EQ(static_cast<int>(keys[i]), signs[i]);
  const std::pair<int, int> others[] = {{Qt::Key_BraceLeft, '{'},
                                        {Qt::Key_Bar, '|'},
                                        {Qt::Key_BraceRight, '}'},
                                        {Qt::Key_AsciiTilde, '~'},
                                        {Qt::Key_Escape, 0x01000000},
                                        {Qt::Key_Tab, 0x01000001},
                                        {Qt::Key_Backtab, 0x01000002},
                                        {Qt::Key_Backspace, 0x01000003},
                                        {Qt::Key_Return, 0x01000004},
                                        {Qt::Key_Enter, 0x01000005},
                                        {Qt::Key_Insert, 0x01000006},
                                        {Qt::Key_Delete, 0x01000007},
                                        {Qt::Key_Pause, 0x01000008},
                                        {Qt::Key_Print, 0x01000009},
                                        {Qt::Key_Home, 0x01000010},
                                        {Qt::Key_End, 0x01000011},
                                        {Qt::Key_Left, 0x01000012},
                                        {Qt::Key_Up, 0x01000013},
                                        {Qt::Key_Right, 0x01000014},
                                        {Qt::Key_Down, 0x01000015},
                                        {Qt::Key_PageUp, 0x01000016},
                                        {Qt::Key_PageDown, 0x01000017},
                                        {Qt::Key_Shift, 0x01000020},
                                        {Qt::Key_Control, 0x01000021},
                                        {Qt::Key_Meta, 0x01000022},
                                        {Qt::Key_Alt, 0x01000023},
                                        {Qt::Key_F1, 0x01000030},
                                        {Qt::Key_F12, 0x0100003b},
                                        {Qt::Key_unknown, 0x01ffffff},
                                        {Qt::NoModifier, 0},
                                        {Qt::ShiftModifier, 0x02000000},
                                        {Qt::ControlModifier, 0x04000000},
                                        {Qt::AltModifier, 0x08000000},
                                        {Qt::LeftButton, 1},
                                        {Qt::RightButton, 2},
                                        {Qt::MiddleButton, 4}};
  for (const auto& [key, number] : others) EXPECT_EQ(key, number);
  const QKeyEvent event(Qt::Key_A, Qt::ShiftModifier, "A");
  EXPECT_EQ(event.key(), 'A');
  EXPECT_EQ(event.modifiers(), Qt::ShiftModifier);
  EXPECT_EQ(event.text().toStdString(), "A");
  EXPECT_FALSE(event.isAutoRepeat());
  EXPECT_EQ(QString::number(-12).toStdString(), "-12");
  EXPECT_EQ(QString::fromStdString("x").toStdString(), "x");
  EXPECT_EQ(QString().toStdString(), "");
  EXPECT_THAT((std::vector<int>{QFont::Light, QFont::Normal, QFont::DemiBold, QFont::Bold, QFont::Black}),
              testing::ElementsAre(25, 50, 63, 75, 87));
}

TEST(Argos3Interfaces, ConstantsOfOpenGlHaveItsValues)
{
  const std::pair<GLenum, GLenum> constants[] = {{GL_POINTS, 0},
                                                 {GL_LINES, 1},
                                                 {GL_LINE_LOOP, 2},
                                                 {GL_LINE_STRIP, 3},
                                                 {GL_TRIANGLES, 4},
                                                 {GL_TRIANGLE_STRIP, 5},
                                                 {GL_TRIANGLE_FAN, 6},
                                                 {GL_QUADS, 7},
                                                 {GL_QUAD_STRIP, 8},
                                                 {GL_POLYGON, 9},
                                                 {GL_FRONT, 0x404},
                                                 {GL_BACK, 0x405},
                                                 {GL_FRONT_AND_BACK, 0x408},
                                                 {GL_POINT_SMOOTH, 0xb10},
                                                 {GL_LINE_SMOOTH, 0xb20},
                                                 {GL_POLYGON_SMOOTH, 0xb41},
                                                 {GL_CULL_FACE, 0xb44},
                                                 {GL_LIGHTING, 0xb50},
                                                 {GL_COLOR_MATERIAL, 0xb57},
                                                 {GL_DEPTH_TEST, 0xb71},
                                                 {GL_BLEND, 0xbe2},
                                                 {GL_AMBIENT, 0x1200},
                                                 {GL_DIFFUSE, 0x1201},
                                                 {GL_SPECULAR, 0x1202},
                                                 {GL_EMISSION, 0x1600},
                                                 {GL_SHININESS, 0x1601},
                                                 {GL_AMBIENT_AND_DIFFUSE, 0x1602},
                                                 {GL_POINT, 0x1b00},
                                                 {GL_LINE, 0x1b01},
                                                 {GL_FILL, 0x1b02},
                                                 {GL_CURRENT_BIT, 1},
                                                 {GL_POINT_BIT, 2},
                                                 {GL_LINE_BIT, 4},
                                                 {GL_POLYGON_BIT, 8},
                                                 {GL_LIGHTING_BIT, 0x40},
                                                 {GL_ENABLE_BIT, 0x2000}};
  for (const auto& [constant, value] : constants) EXPECT_EQ(constant, value);
}

}  // namespace
