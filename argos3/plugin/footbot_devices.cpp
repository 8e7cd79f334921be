// The devices that foot-bots alone have. ARGoS3's values are in cm where ours are in m. Wheel speeds are also recorded
// where loop functions read them. The turret is turned by speed here, so a commanded angle becomes the speed
// that the controller of ARGoS3's foot-bot model gives. A distance scanner reports -1 for an object that is too near,
// and -2 for none.
#include "argos3/plugin/device_parts.h"

#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_base_ground_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_distance_scanner_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_distance_scanner_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_gripper_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_light_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_motor_ground_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_proximity_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_turret_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_turret_encoder_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_colored_blob_omnidirectional_camera_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_leds_actuator.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "argos3/plugin/device_noise.h"
#include "common/control_interface/ci_positioning_sensor.h"
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

class Wheels : public ActuatorBridge, public argos::CCI_DifferentialSteeringActuator
{
public:
  explicit Wheels(const DeviceSetup& setup)
      : id_(setup.robot.GetId()),
        wheels_(setup.robot.Actuator<CCI_FootBotWheelsActuator>("footbot_wheels")),
        told_(setup.told_wheels)
  {
    TheRunning().wheels[id_] = told_.get();
  }
  ~Wheels() override { TheRunning().wheels.erase(id_); }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void Reset() override { SetLinearVelocity(0, 0); }
  void SetLinearVelocity(Real left, Real right) override
  {
    wheels_.SetFootBotWheelsLinearVelocity(left / kCentimetres, right / kCentimetres);
    *told_ = {left, right};
  }

private:
  const std::string id_;
  CCI_FootBotWheelsActuator& wheels_;
  const std::shared_ptr<WheelSpeeds> told_;
};

class Encoders : public SensorBridge, public argos::CCI_DifferentialSteeringSensor
{
public:
  explicit Encoders(const DeviceSetup& setup)
      : robot_(setup.robot),
        noise_(setup.options),
        encoders_(setup.robot.Sensor<CCI_FootBotEncodersSensor>("footbot_encoders"))
  {
    m_sReading.WheelAxisLength = kCentimetres * CCI_FootBotWheelsActuator::INTERWHEEL_DISTANCE_M;
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  // The latest measurement of the engine is from before the reset.
  void Reset() override { was_reset_ = true; }
  void Update() override
  {
    const double tick = robot_.GetTickSeconds();
    const bool has_stood = std::exchange(was_reset_, false);
    m_sReading.CoveredDistanceLeftWheel = has_stood ? 0 : kCentimetres * encoders_.GetLeftDistance(tick);
    m_sReading.CoveredDistanceRightWheel = has_stood ? 0 : kCentimetres * encoders_.GetRightDistance(tick);
    m_sReading.VelocityLeftWheel = m_sReading.CoveredDistanceLeftWheel / tick;
    m_sReading.VelocityRightWheel = m_sReading.CoveredDistanceRightWheel / tick;
    noise_.Add(robot_.GetRandom(), m_sReading);
  }

private:
  CCI_Robot& robot_;
  const WheelNoise noise_;
  const CCI_FootBotEncodersSensor& encoders_;
  bool was_reset_ = false;
};

// Controls the twelve LEDs of the ring and the beacon.
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
  void Reset() override { SetAllColors(argos::CColor::BLACK); }
  void Commit() override
  {
    if (!last_.Differs(m_tSettings)) return;
    for (unsigned led = 0; led < CCI_FootBotLedsActuator::NUM_LEDS; ++led) ring_.SetColour(led, Lit(m_tSettings[led]));
    beacon_.SetColour(Lit(m_tSettings.back()));
  }

private:
  LastColours last_;
  CCI_FootBotLedsActuator& ring_;
  CCI_FootBotBeaconActuator& beacon_;
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
  void BeforeStep() override { this->OnDemand(is_painted_ && noise_ > 0); }
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

// The camera is off until it is enabled, as in ARGoS3.
class OmnidirectionalCamera : public SensorBridge, public argos::CCI_ColoredBlobOmnidirectionalCameraSensor
{
public:
  explicit OmnidirectionalCamera(const DeviceSetup& setup)
      : robot_(setup.robot),
        noise_(setup.options.GetNumber("camera_noise", 0)),
        ours_(setup.robot.Sensor<CCI_FootBotOmnidirectionalCameraSensor>("footbot_omnidirectional_camera"))
  {
    Disable();
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void BeforeStep() override
  {
    m_sReadings.BlobList.clear();
    if (IsDisabled()) return;
    ++m_sReadings.Counter;
    OnDemand(noise_ > 0);
  }
  void Update() override
  {
    const auto blobs = ours_.GetAllBlobs();
    if (blobs_.size() < blobs.size()) blobs_.resize(blobs.size());
    m_sReadings.BlobList.resize(blobs.size());
    SBlob* blob = blobs_.data();
    for (std::size_t i = 0; i < blobs.size(); ++i, ++blob)
    {
      double distance_m = blobs[i].distance_m;
      double angle_rad = blobs[i].angle_rad;
      if (noise_ > 0) DisturbBlob(robot_.GetRandom(), noise_, distance_m, angle_rad);
      blob->Color = argos::CColor(0xff000000U | blobs[i].colour);
      blob->Angle.SetValue(angle_rad);
      blob->Distance = kCentimetres * distance_m;
      m_sReadings.BlobList[i] = blob;
    }
  }

private:
  CCI_Robot& robot_;
  const double noise_;
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
  void Reset() override { Unlock(); }
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
  // A pulse is a revolution per minute.
  void SetRotationSpeed(SInt32 pulses) override { speed_ = pulses * std::numbers::pi / 30; }
  void SetMode(ETurretModes mode) override { mode_ = mode; }
  void Reset() override
  {
    mode_ = MODE_OFF;
    angle_ = speed_ = 0;
    error_.reset();
  }
  void Commit() override
  {
    double speed = mode_ == MODE_SPEED_CONTROL ? speed_ : 0;
    if (mode_ == MODE_POSITION_CONTROL)
    {
      // The gains are those of dynamics2d_footbot_model.cpp.
      constexpr double kProportional = 0.4, kDerivative = 0.2;
      const double error = std::remainder(angle_ - encoder_.GetTurretAngle(), 2 * std::numbers::pi);
      const double change = (error - error_.value_or(error)) / robot_.GetTickSeconds();
      speed = kProportional * error + kDerivative * change;
      error_ = error;
    }
    ours_.SetTurretAngularVelocity(speed);
  }

private:
  const CCI_Robot& robot_;
  swarmanoid::CCI_FootBotTurretActuator& ours_;
  const swarmanoid::CCI_FootBotTurretEncoderSensor& encoder_;
  ETurretModes mode_ = MODE_OFF;
  double angle_ = 0;             // rad
  double speed_ = 0;             // rad/s
  std::optional<double> error_;  // rad, in the last step of position control
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
  void Reset() override
  {
    angle_ = 0;
    Disable();
  }

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
  void BeforeStep() override { OnDemand(); }
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

}  // namespace

std::unique_ptr<SensorBridge> MakeFootBotSensor(const std::string& tag, const DeviceSetup& setup)
{
  if (tag == "differential_steering") return std::make_unique<Encoders>(setup);
  if (tag == "footbot_proximity")
    return std::make_unique<Ring<argos::CCI_FootBotProximitySensor, CCI_FootBotProximitySensor>>(setup, tag.c_str());
  if (tag == "footbot_light")
    return std::make_unique<Ring<argos::CCI_FootBotLightSensor, CCI_FootBotLightSensor>>(setup, tag.c_str());
  if (tag == "footbot_motor_ground")
    return std::make_unique<Ground<argos::CCI_FootBotMotorGroundSensor, CCI_FootBotMotorGroundSensor>>(setup,
                                                                                                       tag.c_str());
  if (tag == "footbot_base_ground")
    return std::make_unique<Ground<argos::CCI_FootBotBaseGroundSensor, CCI_FootBotBaseGroundSensor>>(setup,
                                                                                                     tag.c_str());
  if (tag == "colored_blob_omnidirectional_camera") return std::make_unique<OmnidirectionalCamera>(setup);
  if (tag == "footbot_turret_encoder") return std::make_unique<TurretEncoder>(setup);
  if (tag == "footbot_distance_scanner") return std::make_unique<Scanner>(setup);
  return nullptr;
}

std::unique_ptr<ActuatorBridge> MakeFootBotActuator(const std::string& tag, const DeviceSetup& setup)
{
  if (tag == "differential_steering") return std::make_unique<Wheels>(setup);
  if (tag == "leds") return std::make_unique<FootBotLeds>(setup);
  if (tag == "footbot_gripper") return std::make_unique<Gripper>(setup);
  if (tag == "footbot_turret") return std::make_unique<Turret>(setup);
  if (tag == "footbot_distance_scanner") return std::make_unique<ScannerHead>(setup);
  return nullptr;
}

}  // namespace swarmanoid::argos3
