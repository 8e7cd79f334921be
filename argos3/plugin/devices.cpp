#include "argos3/plugin/devices.h"

#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_proximity_sensor.h>
#include <argos3/plugins/robots/eye-bot/control_interface/ci_eyebot_light_sensor.h>
#include <argos3/plugins/robots/eye-bot/control_interface/ci_eyebot_proximity_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_base_ground_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_distance_scanner_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_distance_scanner_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_gripper_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_light_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_motor_ground_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_proximity_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_turret_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_turret_encoder_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_battery_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_colored_blob_omnidirectional_camera_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_ground_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_leds_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_positioning_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_proximity_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_quadrotor_position_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_quadrotor_speed_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_sensor.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "argos3/kinds/epuck_ground.h"
#include "common/control_interface/ci_battery_sensor.h"
#include "common/control_interface/ci_ground_sensor.h"
#include "common/control_interface/ci_led_ring_actuator.h"
#include "common/control_interface/ci_positioning_sensor.h"
#include "common/control_interface/ci_proximity_sensor.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/control_interface/ci_wheels_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_light_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_propellers_actuator.h"
#include "common/control_interface/footbot/ci_footbot_base_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_beacon_actuator.h"
#include "common/control_interface/footbot/ci_footbot_encoders_sensor.h"
#include "common/control_interface/footbot/ci_footbot_gripper_actuator.h"
#include "common/control_interface/footbot/ci_footbot_leds_actuator.h"
#include "common/control_interface/footbot/ci_footbot_light_sensor.h"
#include "common/control_interface/footbot/ci_footbot_motor_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_omnidirectional_camera_sensor.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turning_scanner_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turret_actuator.h"
#include "common/control_interface/footbot/ci_footbot_turret_encoder_sensor.h"
#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"

namespace swarmanoid::argos3
{
namespace
{

constexpr double kCentimetres = 100;  // of a metre

// The intensity of an LED is the alpha of its colour.
std::uint32_t Lit(const argos::CColor& colour)
{
  const auto shine = [&](std::uint32_t channel) { return channel * colour.GetAlpha() / 255; };
  return shine(colour.GetRed()) << 16U | shine(colour.GetGreen()) << 8U | shine(colour.GetBlue());
}

class Wheels : public ActuatorBridge, public argos::CCI_DifferentialSteeringActuator
{
public:
  explicit Wheels(const DeviceSetup& setup) : wheels_(setup.robot.Actuator<CCI_FootBotWheelsActuator>("footbot_wheels"))
  {
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void SetLinearVelocity(Real left, Real right) override
  {
    wheels_.SetFootBotWheelsLinearVelocity(left / kCentimetres, right / kCentimetres);
  }

private:
  CCI_FootBotWheelsActuator& wheels_;
};

// Of robots that are no foot-bots.
class AnyWheels : public ActuatorBridge, public argos::CCI_DifferentialSteeringActuator
{
public:
  explicit AnyWheels(const DeviceSetup& setup) : wheels_(setup.robot.Actuator<CCI_WheelsActuator>("wheels")) {}
  argos::CCI_Actuator& Actuator() override { return *this; }
  void SetLinearVelocity(Real left, Real right) override
  {
    wheels_.SetLinearVelocity(left / kCentimetres, right / kCentimetres);
  }

private:
  CCI_WheelsActuator& wheels_;
};

class Encoders : public SensorBridge, public argos::CCI_DifferentialSteeringSensor
{
public:
  explicit Encoders(const DeviceSetup& setup)
      : robot_(setup.robot), encoders_(setup.robot.Sensor<CCI_FootBotEncodersSensor>("footbot_encoders"))
  {
    m_sReading.WheelAxisLength = kCentimetres * CCI_FootBotWheelsActuator::INTERWHEEL_DISTANCE_M;
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override
  {
    const double tick = robot_.GetTickSeconds();
    m_sReading.CoveredDistanceLeftWheel = kCentimetres * encoders_.GetLeftDistance(tick);
    m_sReading.CoveredDistanceRightWheel = kCentimetres * encoders_.GetRightDistance(tick);
    m_sReading.VelocityLeftWheel = m_sReading.CoveredDistanceLeftWheel / tick;
    m_sReading.VelocityRightWheel = m_sReading.CoveredDistanceRightWheel / tick;
  }

private:
  const CCI_Robot& robot_;
  const CCI_FootBotEncodersSensor& encoders_;
};

// Twelve LEDs of the ring and the beacon.
class FootBotLeds : public ActuatorBridge, public argos::CCI_LEDsActuator
{
public:
  explicit FootBotLeds(const DeviceSetup& setup)
      : ring_(setup.robot.Actuator<CCI_FootBotLedsActuator>("footbot_leds")),
        beacon_(setup.robot.Actuator<CCI_FootBotBeaconActuator>("footbot_beacon"))
  {
    m_tSettings.resize(CCI_FootBotLedsActuator::NUM_LEDS + 1, argos::CColor::BLACK);
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void Commit() override
  {
    for (unsigned led = 0; led < CCI_FootBotLedsActuator::NUM_LEDS; ++led) ring_.SetColour(led, Lit(m_tSettings[led]));
    beacon_.SetColour(Lit(m_tSettings.back()));
  }

private:
  CCI_FootBotLedsActuator& ring_;
  CCI_FootBotBeaconActuator& beacon_;
};

// A ring of LEDs and nothing else.
class RingLeds : public ActuatorBridge, public argos::CCI_LEDsActuator
{
public:
  RingLeds(const DeviceSetup& setup, const char* type) : ring_(setup.robot.Actuator<CCI_LedRingActuator>(type))
  {
    m_tSettings.resize(ring_.GetNumLeds(), argos::CColor::BLACK);
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void Commit() override
  {
    for (unsigned led = 0; led < m_tSettings.size(); ++led) ring_.SetColour(led, Lit(m_tSettings[led]));
  }

private:
  CCI_LedRingActuator& ring_;
};

// A ring of readings whose angles both sides count alike.
template <class Theirs, class Ours>
class Ring : public SensorBridge, public Theirs
{
public:
  Ring(const DeviceSetup& setup, const char* type) : ours_(setup.robot.Sensor<Ours>(type))
  {
    // The right half as negative angles, as ARGoS3 tells them.
    for (unsigned i = 0; i < Ours::NUM_SENSORS; ++i)
      this->m_tReadings.emplace_back(0, argos::CRadians(Ours::AngleOf(i)).SignedNormalize());
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override
  {
    const auto readings = ours_.GetAllSensorReadings();
    for (unsigned i = 0; i < Ours::NUM_SENSORS; ++i) this->m_tReadings[i].Value = readings[i];
  }

private:
  const Ours& ours_;
};

// What ARGoS3's infrared sensors make of a distance, m. Its sensors of that name: generic, e-puck, eye-bot.
double GenericResponse(double distance) { return std::exp(-distance); }
double EPuckResponse(double distance)
{
  constexpr double kFarthest = 0.05;
  if (distance > kFarthest) return 0;
  return std::clamp(298.701 * distance * distance - 36.8961 * distance + 1.08212, 0.0, 1.0);
}
double EyeBotResponse(double distance)
{
  constexpr double kTouching = 0.009889556;
  return distance < kTouching ? 1 : 0.0100527 / (distance + 0.000163144);
}

// Ours fall evenly from 1 at the sensor to 0 at its range, so they tell the distance.
template <class Theirs>
class Proximity : public SensorBridge, public Theirs
{
public:
  Proximity(const DeviceSetup& setup, double range_m, double (*response)(double))
      : robot_(setup.robot),
        ours_(robot_.Sensor<swarmanoid::CCI_ProximitySensor>("proximity")),
        range_m_(range_m),
        response_(response),
        noise_(setup.options.GetNumber("proximity_noise", 0))
  {
    for (unsigned i = 0; i < ours_.GetAllSensorReadings().size(); ++i)
    {
      if constexpr (kHasAngles)
        this->m_tReadings.emplace_back(0, argos::CRadians(ours_.GetAngle(i)).SignedNormalize());
      else
        this->m_tReadings.emplace_back(0);
    }
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override
  {
    const auto readings = ours_.GetAllSensorReadings();
    for (unsigned i = 0; i < readings.size(); ++i)
    {
      const double noise = noise_ > 0 ? robot_.GetRandom().Uniform(-noise_, noise_) : 0;
      const double seen = readings[i] > 0 ? response_(range_m_ * (1 - readings[i])) : 0;
      const double value = std::clamp(seen + noise, 0.0, 1.0);
      if constexpr (kHasAngles)
        this->m_tReadings[i].Value = value;
      else
        this->m_tReadings[i] = value;
    }
  }

private:
  static constexpr bool kHasAngles = !std::is_same_v<typename Theirs::TReadings, std::vector<Real>>;

  CCI_Robot& robot_;
  const swarmanoid::CCI_ProximitySensor& ours_;
  const double range_m_;
  double (*const response_)(double);
  const double noise_;
};

// The floor that loop functions paint, under one robot.
class PaintedFloor
{
public:
  PaintedFloor(const Translation& translation, const swarmanoid::CCI_PositioningSensor& place)
      : functions_(argos::CSimulator::GetInstance().GetLoopFunctions()),
        middle_(translation.Argos3Position(place.GetPosition())),
        cosine_(std::cos(place.GetHeading())),
        sine_(std::sin(place.GetHeading()))
  {
  }
  // At a place in the frame of the robot, m; 0 on black, 1 on white.
  double GreyAt(double x, double y) const
  {
    const argos::CVector2 at(middle_.GetX() + x * cosine_ - y * sine_, middle_.GetY() + x * sine_ + y * cosine_);
    return functions_.GetFloorColor(at).ToGrayScale() / 255.0;
  }

private:
  argos::CLoopFunctions& functions_;
  const argos::CVector3 middle_;
  const double cosine_;
  const double sine_;
};

class EPuckGround : public SensorBridge, public argos::CCI_GroundSensor
{
public:
  explicit EPuckGround(const DeviceSetup& setup)
      : robot_(setup.robot), translation_(setup.translation), noise_(setup.options.GetNumber("ground_noise", 0))
  {
    if (setup.options.GetText("floor", "") == "loop_functions")
      positioning_ = &robot_.Sensor<swarmanoid::CCI_PositioningSensor>("positioning");
    else
      ours_ = &robot_.Sensor<swarmanoid::CCI_GroundSensor>("ground");
    m_tReadings.resize(kEPuckGround.size());
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override
  {
    if (positioning_ == nullptr)
    {
      std::ranges::copy(ours_->GetAllSensorReadings(), m_tReadings.begin());
      return;
    }
    const PaintedFloor floor(translation_, *positioning_);
    for (std::size_t i = 0; i < kEPuckGround.size(); ++i)
    {
      const double noise = noise_ > 0 ? robot_.GetRandom().Uniform(-noise_, noise_) : 0;
      m_tReadings[i] = std::clamp(floor.GreyAt(kEPuckGround[i].x, kEPuckGround[i].y) + noise, 0.0, 1.0);
    }
  }

private:
  CCI_Robot& robot_;
  const Translation& translation_;
  const double noise_;
  const swarmanoid::CCI_PositioningSensor* positioning_ = nullptr;
  const swarmanoid::CCI_GroundSensor* ours_ = nullptr;
};

template <class Theirs, class Ours>
class Ground : public SensorBridge, public Theirs
{
public:
  Ground(const DeviceSetup& setup, const char* type)
      : robot_(setup.robot),
        translation_(setup.translation),
        is_painted_(setup.options.GetText("floor", "") == "loop_functions"),
        noise_(setup.options.GetNumber("ground_noise", 0))
  {
    if (is_painted_)
      positioning_ = &robot_.Sensor<CCI_PositioningSensor>("positioning");
    else
      ours_ = &robot_.Sensor<Ours>(type);
    for (const auto& place : Ours::PLACES_M)
      this->m_tReadings.emplace_back(0, argos::CVector2(kCentimetres * place.x, kCentimetres * place.y));
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override
  {
    if (is_painted_) return Ask();
    const auto readings = ours_->GetAllSensorReadings();
    for (unsigned i = 0; i < Ours::NUM_SENSORS; ++i) this->m_tReadings[i].Value = readings[i];
  }

private:
  static constexpr bool kBlackOrWhite = std::is_same_v<Ours, CCI_FootBotBaseGroundSensor>;

  void Ask()
  {
    const PaintedFloor floor(translation_, *positioning_);
    for (unsigned i = 0; i < Ours::NUM_SENSORS; ++i)
    {
      const double noise = noise_ > 0 ? robot_.GetRandom().Uniform(-noise_, noise_) : 0;
      const double reading = std::clamp(floor.GreyAt(Ours::PLACES_M[i].x, Ours::PLACES_M[i].y) + noise, 0.0, 1.0);
      this->m_tReadings[i].Value = kBlackOrWhite ? (reading >= 0.5 ? 1 : 0) : reading;
    }
  }

  CCI_Robot& robot_;
  const Translation& translation_;
  const bool is_painted_;
  const double noise_;
  const CCI_PositioningSensor* positioning_ = nullptr;
  const Ours* ours_ = nullptr;
};

class Positioning : public SensorBridge, public argos::CCI_PositioningSensor
{
public:
  explicit Positioning(const DeviceSetup& setup)
      : translation_(setup.translation), ours_(setup.robot.Sensor<swarmanoid::CCI_PositioningSensor>("positioning"))
  {
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override
  {
    m_sReading.Position = translation_.Argos3Position(ours_.GetPosition());
    m_sReading.Orientation = Argos3Orientation(ours_.GetOrientation());
  }

private:
  const Translation& translation_;
  const swarmanoid::CCI_PositioningSensor& ours_;
};

class Battery : public SensorBridge, public argos::CCI_BatterySensor
{
public:
  explicit Battery(const DeviceSetup& setup) : ours_(setup.robot.Sensor<swarmanoid::CCI_BatterySensor>("battery")) {}
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override
  {
    m_sReading.AvailableCharge = ours_.GetCharge();
    m_sReading.TimeLeft = ours_.GetTimeLeft();
  }

private:
  const swarmanoid::CCI_BatterySensor& ours_;
};

// Dark until it is enabled, as in ARGoS3.
class OmnidirectionalCamera : public SensorBridge, public argos::CCI_ColoredBlobOmnidirectionalCameraSensor
{
public:
  explicit OmnidirectionalCamera(const DeviceSetup& setup)
      : ours_(setup.robot.Sensor<CCI_FootBotOmnidirectionalCameraSensor>("footbot_omnidirectional_camera"))
  {
    Disable();
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override
  {
    m_sReadings.BlobList.clear();
    if (IsDisabled()) return;
    const auto blobs = ours_.GetAllBlobs();
    if (blobs_.size() < blobs.size()) blobs_.resize(blobs.size());
    for (std::size_t i = 0; i < blobs.size(); ++i)
    {
      blobs_[i].Color = argos::CColor(0xff000000U | blobs[i].colour);
      blobs_[i].Angle.SetValue(blobs[i].angle_rad);
      blobs_[i].Distance = kCentimetres * blobs[i].distance_m;
      m_sReadings.BlobList.push_back(&blobs_[i]);
    }
    ++m_sReadings.Counter;
  }

private:
  const CCI_FootBotOmnidirectionalCameraSensor& ours_;
  std::vector<SBlob> blobs_;
};

class Gripper : public ActuatorBridge, public argos::CCI_FootBotGripperActuator
{
public:
  explicit Gripper(const DeviceSetup& setup)
      : ours_(setup.robot.Actuator<swarmanoid::CCI_FootBotGripperActuator>("footbot_gripper"))
  {
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void SetAperture(const argos::CRadians& aperture) override
  {
    ours_.SetGripper(aperture.GetAbsoluteValue() / LOCKED_POSITIVE.GetValue());
  }

private:
  swarmanoid::CCI_FootBotGripperActuator& ours_;
};

class Turret : public ActuatorBridge, public argos::CCI_FootBotTurretActuator
{
public:
  explicit Turret(const DeviceSetup& setup)
      : robot_(setup.robot),
        ours_(robot_.Actuator<swarmanoid::CCI_FootBotTurretActuator>("footbot_turret")),
        encoder_(robot_.Sensor<swarmanoid::CCI_FootBotTurretEncoderSensor>("footbot_turret_encoder"))
  {
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void SetRotation(const argos::CRadians& angle) override { angle_ = angle.GetValue(); }
  void SetRotationSpeed(SInt32 speed) override { speed_ = speed; }
  void SetMode(ETurretModes mode) override { mode_ = mode; }
  // What is left of the way is done within a tick, as far as the motor can.
  void Commit() override
  {
    double speed = mode_ == MODE_SPEED_CONTROL ? speed_ : 0;
    if (mode_ == MODE_POSITION_CONTROL)
      speed = std::remainder(angle_ - encoder_.GetTurretAngle(), 2 * std::numbers::pi) / robot_.GetTickSeconds();
    ours_.SetTurretAngularVelocity(speed);
  }

private:
  const CCI_Robot& robot_;
  swarmanoid::CCI_FootBotTurretActuator& ours_;
  const swarmanoid::CCI_FootBotTurretEncoderSensor& encoder_;
  ETurretModes mode_ = MODE_OFF;
  double angle_ = 0;
  double speed_ = 0;
};

class TurretEncoder : public SensorBridge, public argos::CCI_FootBotTurretEncoderSensor
{
public:
  explicit TurretEncoder(const DeviceSetup& setup)
      : ours_(setup.robot.Sensor<swarmanoid::CCI_FootBotTurretEncoderSensor>("footbot_turret_encoder"))
  {
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override { m_cRotation.SetValue(ours_.GetTurretAngle()); }

private:
  const swarmanoid::CCI_FootBotTurretEncoderSensor& ours_;
};

class ScannerHead : public ActuatorBridge, public argos::CCI_FootBotDistanceScannerActuator
{
public:
  explicit ScannerHead(const DeviceSetup& setup)
      : ours_(setup.robot.Sensor<CCI_FootBotTurningScannerSensor>("footbot_distance_scanner"))
  {
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void SetAngle(const argos::CRadians& angle) override
  {
    angle_ = angle.GetValue();
    Enable();
  }
  void SetRPM(Real turns_a_minute) override { ours_.Turn(turns_a_minute * 2 * std::numbers::pi / 60); }
  void Enable() override { ours_.Look(angle_); }
  void Disable() override { ours_.SwitchOff(); }

private:
  CCI_FootBotTurningScannerSensor& ours_;
  double angle_ = 0;
};

class Scanner : public SensorBridge, public argos::CCI_FootBotDistanceScannerSensor
{
public:
  explicit Scanner(const DeviceSetup& setup)
      : ours_(setup.robot.Sensor<CCI_FootBotTurningScannerSensor>("footbot_distance_scanner"))
  {
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override
  {
    m_tReadingsMap.clear();
    m_tShortReadingsMap.clear();
    m_tLongReadingsMap.clear();
    const auto readings = ours_.GetAllReadings();
    for (std::size_t i = 0; i < readings.size(); ++i)
    {
      const auto& reading = readings[i];
      const argos::CRadians angle(reading.angle_rad);
      const Real value = reading.echo == CCI_DistanceScannerSensor::Echo::kTooNear ? -1
                         : reading.echo == CCI_DistanceScannerSensor::Echo::kNothing
                             ? -2
                             : kCentimetres * reading.distance_m;
      m_tReadingsMap[angle] = value;
      // The two short beams come first.
      (2 * i < readings.size() ? m_tShortReadingsMap : m_tLongReadingsMap)[angle] = value;
    }
  }

private:
  const CCI_FootBotTurningScannerSensor& ours_;
};

class RangeAndBearingSender : public ActuatorBridge, public argos::CCI_RangeAndBearingActuator
{
public:
  explicit RangeAndBearingSender(const DeviceSetup& setup)
      : ours_(setup.robot.Actuator<swarmanoid::CCI_RangeAndBearingActuator>("range_and_bearing"))
  {
    m_cData.Resize(static_cast<size_t>(setup.options.GetInteger("rab_data_size", 10)));
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void Commit() override
  {
    swarmanoid::CCI_RangeAndBearingActuator::Message message{};
    std::copy_n(m_cData.ToCArray(), m_cData.Size(), message.begin());
    ours_.SetMessage(message);
  }

private:
  swarmanoid::CCI_RangeAndBearingActuator& ours_;
};

class RangeAndBearingReceiver : public SensorBridge, public argos::CCI_RangeAndBearingSensor
{
public:
  explicit RangeAndBearingReceiver(const DeviceSetup& setup)
      : ours_(setup.robot.Sensor<swarmanoid::CCI_RangeAndBearingSensor>("range_and_bearing")),
        size_(static_cast<size_t>(setup.options.GetInteger("rab_data_size", 10)))
  {
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override
  {
    const auto packets = ours_.GetAllPackets();
    m_tReadings.resize(packets.size());
    for (std::size_t i = 0; i < packets.size(); ++i)
    {
      SPacket& packet = m_tReadings[i];
      packet.Range = kCentimetres * packets[i].range_m;
      packet.HorizontalBearing.SetValue(packets[i].bearing_rad);
      packet.VerticalBearing.SetValue(packets[i].vertical_bearing_rad);
      packet.Data.Resize(size_);
      std::copy_n(packets[i].message.begin(), size_, packet.Data.ToCArray());
    }
  }

private:
  const swarmanoid::CCI_RangeAndBearingSensor& ours_;
  const size_t size_;
};

class QuadrotorPosition : public ActuatorBridge, public argos::CCI_QuadRotorPositionActuator
{
public:
  explicit QuadrotorPosition(const DeviceSetup& setup)
      : translation_(setup.translation),
        propellers_(setup.robot.Actuator<CCI_EyeBotPropellersActuator>("eyebot_propellers")),
        place_(setup.robot.Sensor<swarmanoid::CCI_PositioningSensor>("positioning"))
  {
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void SetAbsolutePosition(const argos::CVector3& position) override
  {
    position_ = translation_.OurPosition(position);
    if (!yaw_) yaw_ = place_.GetHeading();
  }
  void SetRelativePosition(const argos::CVector3& position) override
  {
    position_ =
        place_.GetPosition() + place_.GetOrientation() * Vector3(position.GetX(), position.GetY(), position.GetZ());
    if (!yaw_) yaw_ = place_.GetHeading();
  }
  void SetAbsoluteYaw(const argos::CRadians& yaw) override
  {
    yaw_ = yaw.GetValue();
    if (!position_) position_ = place_.GetPosition();
  }
  void SetRelativeYaw(const argos::CRadians& yaw) override
  {
    yaw_ = place_.GetHeading() + yaw.GetValue();
    if (!position_) position_ = place_.GetPosition();
  }
  void Commit() override
  {
    if (position_) propellers_.SetPosition(*position_, *yaw_);
  }

private:
  const Translation& translation_;
  CCI_EyeBotPropellersActuator& propellers_;
  const swarmanoid::CCI_PositioningSensor& place_;
  std::optional<Vector3> position_;
  std::optional<double> yaw_;
};

class QuadrotorSpeed : public ActuatorBridge, public argos::CCI_QuadRotorSpeedActuator
{
public:
  explicit QuadrotorSpeed(const DeviceSetup& setup)
      : propellers_(setup.robot.Actuator<CCI_EyeBotPropellersActuator>("eyebot_propellers"))
  {
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void SetLinearVelocity(const argos::CVector3& velocity) override { velocity_ = velocity; }
  void SetRotationalSpeed(const argos::CRadians& speed) override { yaw_rate_ = speed.GetValue(); }
  void Commit() override { propellers_.SetVelocity(velocity_.GetX(), velocity_.GetY(), velocity_.GetZ(), yaw_rate_); }

private:
  CCI_EyeBotPropellersActuator& propellers_;
  argos::CVector3 velocity_;
  double yaw_rate_ = 0;
};

}  // namespace

std::unique_ptr<SensorBridge> MakeSensor(const std::string& tag, const DeviceSetup& setup)
{
  if (tag == "differential_steering") return std::make_unique<Encoders>(setup);
  if (tag == "footbot_proximity")
    return std::make_unique<Ring<argos::CCI_FootBotProximitySensor, CCI_FootBotProximitySensor>>(setup, tag.c_str());
  const double proximity_range_m = setup.robot.GetKind() == "eyebot" ? 3 : 0.1;
  if (tag == "proximity")
    return std::make_unique<Proximity<argos::CCI_ProximitySensor>>(setup, proximity_range_m, GenericResponse);
  if (tag == "epuck_proximity")
    return std::make_unique<Proximity<argos::CCI_EPuckProximitySensor>>(setup, proximity_range_m, EPuckResponse);
  if (tag == "eyebot_proximity")
    return std::make_unique<Proximity<argos::CCI_EyeBotProximitySensor>>(setup, proximity_range_m, EyeBotResponse);
  if (tag == "footbot_light")
    return std::make_unique<Ring<argos::CCI_FootBotLightSensor, CCI_FootBotLightSensor>>(setup, tag.c_str());
  if (tag == "eyebot_light")
    return std::make_unique<Ring<argos::CCI_EyeBotLightSensor, CCI_EyeBotLightSensor>>(setup, tag.c_str());
  if (tag == "footbot_motor_ground")
    return std::make_unique<Ground<argos::CCI_FootBotMotorGroundSensor, CCI_FootBotMotorGroundSensor>>(setup,
                                                                                                       tag.c_str());
  if (tag == "footbot_base_ground")
    return std::make_unique<Ground<argos::CCI_FootBotBaseGroundSensor, CCI_FootBotBaseGroundSensor>>(setup,
                                                                                                     tag.c_str());
  if (tag == "ground") return std::make_unique<EPuckGround>(setup);
  if (tag == "positioning") return std::make_unique<Positioning>(setup);
  if (tag == "battery") return std::make_unique<Battery>(setup);
  if (tag == "colored_blob_omnidirectional_camera") return std::make_unique<OmnidirectionalCamera>(setup);
  if (tag == "footbot_turret_encoder") return std::make_unique<TurretEncoder>(setup);
  if (tag == "footbot_distance_scanner") return std::make_unique<Scanner>(setup);
  if (tag == "range_and_bearing") return std::make_unique<RangeAndBearingReceiver>(setup);
  return nullptr;
}

std::unique_ptr<ActuatorBridge> MakeActuator(const std::string& tag, const DeviceSetup& setup)
{
  const bool is_epuck = setup.robot.GetKind() == "argos3_epuck";
  if (tag == "differential_steering" && is_epuck) return std::make_unique<AnyWheels>(setup);
  if (tag == "differential_steering") return std::make_unique<Wheels>(setup);
  if (tag == "leds" && setup.robot.GetKind() == "eyebot") return std::make_unique<RingLeds>(setup, "eyebot_leds");
  if (tag == "leds" && is_epuck) return std::make_unique<RingLeds>(setup, "led_ring");
  if (tag == "leds") return std::make_unique<FootBotLeds>(setup);
  if (tag == "footbot_gripper") return std::make_unique<Gripper>(setup);
  if (tag == "footbot_turret") return std::make_unique<Turret>(setup);
  if (tag == "footbot_distance_scanner") return std::make_unique<ScannerHead>(setup);
  if (tag == "range_and_bearing") return std::make_unique<RangeAndBearingSender>(setup);
  if (tag == "quadrotor_position") return std::make_unique<QuadrotorPosition>(setup);
  if (tag == "quadrotor_speed") return std::make_unique<QuadrotorSpeed>(setup);
  return nullptr;
}

}  // namespace swarmanoid::argos3
