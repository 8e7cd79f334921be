// The devices of Pi-Pucks. They are those of generic robots, with units, names and responses of ARGoS3's Pi-Puck.
#include <argos3/core/utility/logging/argos_log.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_ground_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_leds_actuator.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_differential_drive_actuator.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_differential_drive_sensor.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_ground_sensor.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_leds_actuator.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_rangefinders_sensor.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_system_sensor.h>

#include "argos3/plugin/device_parts.h"

namespace swarmanoid::argos3
{
namespace
{

class PiPuckDrive : public ActuatorBridge, public argos::CCI_PiPuckDifferentialDriveActuator
{
public:
  explicit PiPuckDrive(const DeviceSetup& setup)
      : bridge_(MakeGenericActuator("differential_steering", setup)),
        wheels_(dynamic_cast<argos::CCI_DifferentialSteeringActuator&>(bridge_->Actuator()))
  {
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void Reset() override { SetLinearVelocity(0, 0); }
  void SetLinearVelocity(Real left, Real right) override
  {
    wheels_.SetLinearVelocity(left * kCentimetres, right * kCentimetres);
  }

private:
  const std::unique_ptr<ActuatorBridge> bridge_;
  argos::CCI_DifferentialSteeringActuator& wheels_;
};

class PiPuckSpeeds : public SensorBridge, public argos::CCI_PiPuckDifferentialDriveSensor
{
public:
  explicit PiPuckSpeeds(const DeviceSetup& setup) : told_(setup.told_wheels) {}
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override { speeds_ = *told_; }
  void Reset() override { speeds_ = {}; }
  Real GetLeftVelocity() override { return speeds_.left / kCentimetres; }
  Real GetRightVelocity() override { return speeds_.right / kCentimetres; }

private:
  const std::shared_ptr<const WheelSpeeds> told_;
  WheelSpeeds speeds_;
};

class PiPuckLeds : public ActuatorBridge, public argos::CCI_PiPuckLEDsActuator
{
public:
  explicit PiPuckLeds(const DeviceSetup& setup)
      : bridge_(MakeActuator("leds", setup)), leds_(dynamic_cast<argos::CCI_LEDsActuator&>(bridge_->Actuator()))
  {
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void Reset() override { bridge_->Actuator().Reset(); }
  void Commit() override { bridge_->Commit(); }
  void SetRingLEDIndex(UInt32 index, bool on) override
  {
    if (index < NUM_RING_LEDS)
      Switch(index, on);
    else
      argos::LOGERR << "a Pi-Puck has no LED " << index << " in its ring; they are 0 to 7" << std::endl;
  }
  void SetRingLEDs(bool on) override
  {
    for (UInt32 led = 0; led < NUM_RING_LEDS; ++led) Switch(led, on);
  }
  void SetFrontLED(bool on) override { Switch(INDEX_FRONT_LED, on); }
  void SetBodyLED(bool on) override { Switch(INDEX_BODY_LED, on); }

private:
  void Switch(UInt32 led, bool on) { leds_.SetSingleColor(led, on ? argos::CColor::WHITE : argos::CColor::BLACK); }

  const std::unique_ptr<ActuatorBridge> bridge_;
  argos::CCI_LEDsActuator& leds_;
};

// Sensors that a controller visits. Configurations stay at their places.
template <class Theirs>
class Visited : public SensorBridge, public Theirs
{
public:
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Visit(std::function<void(const typename Theirs::SInterface&)> function) override
  {
    this->Demand();
    for (const auto& sensor : sensors_) function(sensor);
  }

protected:
  explicit Visited(const std::vector<typename Theirs::TConfiguration>& configurations) : configurations_(configurations)
  {
    for (const auto& configuration : configurations_)
      sensors_.emplace_back(static_cast<UInt8>(sensors_.size()), configuration);
  }

  const std::vector<typename Theirs::TConfiguration> configurations_;
  std::vector<typename Theirs::SInterface> sensors_;
};

const EntityKindDescription& RowOf(const DeviceSetup& setup)
{
  return DescriptionOf(*KindOfTag(setup.robot.GetKind()));
}

class PiPuckRangefinders : public Visited<argos::CCI_PiPuckRangefindersSensor>
{
public:
  explicit PiPuckRangefinders(const DeviceSetup& setup)
      : Visited(Configurations(*RowOf(setup).proximity)),
        ours_(setup.robot.Sensor<swarmanoid::CCI_ProximitySensor>("proximity")),
        range_m_(RowOf(setup).proximity->range_m)
  {
    Reset();
  }
  void Reset() override
  {
    for (SInterface& sensor : sensors_) sensor.Proximity = range_m_;
  }
  void BeforeStep() override { OnDemand(); }
  // Our readings fall linearly from 1 at the sensor to 0 at its range.
  void Update() override
  {
    const auto readings = ours_.GetAllSensorReadings();
    for (std::size_t i = 0; i < sensors_.size(); ++i) sensors_[i].Proximity = range_m_ * (1 - readings[i]);
  }

private:
  static std::vector<TConfiguration> Configurations(const ProximityRing& ring)
  {
    std::vector<TConfiguration> configurations;
    for (const ProximityRing::Sensor& sensor : ring.sensors)
    {
      const argos::CVector3 axis(-std::sin(sensor.direction), std::cos(sensor.direction), 0);
      configurations.emplace_back("origin", argos::CVector3(sensor.place.x(), sensor.place.y(), ring.height_m),
                                  argos::CQuaternion(argos::CRadians::PI_OVER_TWO, axis), ring.range_m);
    }
    return configurations;
  }

  const swarmanoid::CCI_ProximitySensor& ours_;
  const double range_m_;
};

class PiPuckGround : public Visited<argos::CCI_PiPuckGroundSensor>
{
public:
  explicit PiPuckGround(const DeviceSetup& setup)
      : Visited(Configurations(RowOf(setup).ground_points)),
        bridge_(MakeGenericSensor("ground", setup)),
        ours_(dynamic_cast<argos::CCI_GroundSensor&>(bridge_->Sensor()))
  {
  }
  void Reset() override
  {
    for (SInterface& sensor : sensors_) sensor.Reflected = 0;
  }
  void Update() override
  {
    bridge_->Update();
    for (std::size_t i = 0; i < sensors_.size(); ++i) sensors_[i].Reflected = ours_.GetReadings()[i];
  }

private:
  static std::vector<TConfiguration> Configurations(const std::vector<Vector2>& points)
  {
    constexpr double kHeight = 0.002, kRange = 0.005;  // m
    const argos::CQuaternion down(argos::CRadians::PI, argos::CVector3::Y);
    std::vector<TConfiguration> configurations;
    for (const Vector2& point : points)
      configurations.emplace_back("origin", argos::CVector3(point.x(), point.y(), kHeight), down, kRange);
    return configurations;
  }

  const std::unique_ptr<SensorBridge> bridge_;
  const argos::CCI_GroundSensor& ours_;
};

class PiPuckSystem : public SensorBridge, public argos::CCI_PiPuckSystemSensor
{
public:
  explicit PiPuckSystem(const DeviceSetup& setup) : tick_s_(setup.robot.GetTickSeconds()) {}
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Reset() override { m_fTime = 0; }
  void Update() override { m_fTime += tick_s_; }

private:
  const double tick_s_;
};

}  // namespace

std::unique_ptr<SensorBridge> MakePiPuckSensor(const std::string& tag, const DeviceSetup& setup)
{
  if (tag == "pipuck_differential_drive") return std::make_unique<PiPuckSpeeds>(setup);
  if (tag == "pipuck_rangefinders") return std::make_unique<PiPuckRangefinders>(setup);
  if (tag == "pipuck_ground") return std::make_unique<PiPuckGround>(setup);
  if (tag == "pipuck_system") return std::make_unique<PiPuckSystem>(setup);
  return nullptr;
}

std::unique_ptr<ActuatorBridge> MakePiPuckActuator(const std::string& tag, const DeviceSetup& setup)
{
  if (tag == "pipuck_differential_drive") return std::make_unique<PiPuckDrive>(setup);
  if (tag == "pipuck_leds") return std::make_unique<PiPuckLeds>(setup);
  return nullptr;
}

}  // namespace swarmanoid::argos3
