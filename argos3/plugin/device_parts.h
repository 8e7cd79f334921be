// Shared code for the devices of ARGoS3's robots, and the makers for each robot.
#pragma once

#include <argos3/core/utility/datatypes/color.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "argos3/plugin/device_adapters.h"
#include "common/control_interface/ci_positioning_sensor.h"
#include "common/control_interface/ci_proximity_sensor.h"
#include "common/experiment/entity_kind.h"

namespace swarmanoid::argos3
{

// Return nullptr for a tag that the robot does not have.
std::unique_ptr<SensorBridge> MakeFootBotSensor(const std::string& tag, const DeviceSetup& setup);
std::unique_ptr<ActuatorBridge> MakeFootBotActuator(const std::string& tag, const DeviceSetup& setup);
// Generic robots are those of robot_rows.h.
std::unique_ptr<SensorBridge> MakeGenericSensor(const std::string& tag, const DeviceSetup& setup);
std::unique_ptr<ActuatorBridge> MakeGenericActuator(const std::string& tag, const DeviceSetup& setup);
std::unique_ptr<SensorBridge> MakeKheperaSensor(const std::string& tag, const DeviceSetup& setup);
std::unique_ptr<SensorBridge> MakeEPuckSensor(const std::string& tag, const DeviceSetup& setup);
std::unique_ptr<ActuatorBridge> MakeEPuckActuator(const std::string& tag, const DeviceSetup& setup);
std::unique_ptr<SensorBridge> MakePiPuckSensor(const std::string& tag, const DeviceSetup& setup);
std::unique_ptr<ActuatorBridge> MakePiPuckActuator(const std::string& tag, const DeviceSetup& setup);
std::unique_ptr<SensorBridge> MakeKilobotSensor(const std::string& tag, const DeviceSetup& setup);
std::unique_ptr<ActuatorBridge> MakeKilobotActuator(const std::string& tag, const DeviceSetup& setup);
// Makes the camera of foot-bots and eye-bots.
std::unique_ptr<SensorBridge> MakePerspectiveCamera(const DeviceSetup& setup);
std::unique_ptr<ActuatorBridge> MakeEyeBotActuator(const std::string& tag, const DeviceSetup& setup);

inline constexpr double kCentimetres = 100;  // in a metre

// Returns the response of an e-puck's infrared sensors to a distance in m, in ARGoS3 and in argos3-epuck.
inline double EPuckResponse(double distance)
{
  constexpr double kFarthest = 0.05;
  if (distance > kFarthest) return 0;
  return std::clamp(298.701 * distance * distance - 36.8961 * distance + 1.08212, 0.0, 1.0);
}

// The alpha of a colour is the intensity of the LED.
inline std::uint32_t Lit(const argos::CColor& colour)
{
  const auto shine = [&](std::uint32_t channel) { return channel * colour.GetAlpha() / 255; };
  return shine(colour.GetRed()) << 16U | shine(colour.GetGreen()) << 8U | shine(colour.GetBlue());
}

// The colours that an actuator passed on last. Our actuators keep them, so equal ones are not passed on again.
class LastColours
{
public:
  // Compares colours with the last ones, and remembers them.
  bool Differs(const std::vector<argos::CColor>& colours)
  {
    static_assert(sizeof(argos::CColor) == 4);
    if (colours.size() == last_.size() && std::memcmp(colours.data(), last_.data(), 4 * last_.size()) == 0)
      return false;
    last_ = colours;
    return true;
  }

private:
  std::vector<argos::CColor> last_;
};

// If robots have several media or sizes of messages, the last byte of a message names both.
inline std::optional<std::uint8_t> ChannelOf(const TConfigurationTree& options)
{
  const auto channel = options.GetInteger("radio_channel", -1);
  return channel < 0 ? std::nullopt : std::optional(static_cast<std::uint8_t>(channel));
}

// A ring of readings, with the same order of angles on both sides.
template <class Theirs, class Ours>
class Ring : public SensorBridge, public Theirs
{
public:
  Ring(const DeviceSetup& setup, const char* type) : ours_(setup.robot.Sensor<Ours>(type))
  {
    // ARGoS3 gives the right half as negative angles.
    for (unsigned i = 0; i < Ours::NUM_SENSORS; ++i)
      this->m_tReadings.emplace_back(0, argos::CRadians(Ours::AngleOf(i)).SignedNormalize());
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void BeforeStep() override { this->OnDemand(); }
  void Update() override
  {
    const auto readings = ours_.GetAllSensorReadings();
    for (unsigned i = 0; i < Ours::NUM_SENSORS; ++i) this->m_tReadings[i].Value = readings[i];
  }

private:
  const Ours& ours_;
};

// Infrared sensors around a robot. Our readings fall linearly from 1 at the sensor to 0 at its range, so the distance
// (m) follows from them, and `response` gives ARGoS3's reading. A ring may look further than ARGoS3's sensors.
template <class Theirs>
class Proximity : public SensorBridge, public Theirs
{
public:
  Proximity(const DeviceSetup& setup, double (*response)(double))
      : robot_(setup.robot),
        ours_(robot_.Sensor<swarmanoid::CCI_ProximitySensor>("proximity")),
        reach_m_(DescriptionOf(*KindOfTag(robot_.GetKind())).proximity->range_m),
        range_m_(setup.options.GetNumber("proximity_range", reach_m_)),
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
  void BeforeStep() override { this->OnDemand(noise_ > 0); }
  void Update() override
  {
    const auto readings = ours_.GetAllSensorReadings();
    for (unsigned i = 0; i < readings.size(); ++i)
    {
      const double noise = noise_ > 0 ? robot_.GetRandom().Uniform(-noise_, noise_) : 0;
      const double distance = range_m_ * (1 - readings[i]);
      const double seen = readings[i] > 0 && distance <= reach_m_ ? response_(distance) : 0;
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
  const double reach_m_;  // of ARGoS3's sensors
  const double range_m_;  // of ours
  double (*const response_)(double);
  const double noise_;
};

// The floor that loop functions paint, under one robot.
class PaintedFloor
{
public:
  PaintedFloor(const Translation& translation, const swarmanoid::CCI_PositioningSensor& place)
      : PaintedFloor(translation.Argos3Position(place.GetPosition()), place.GetHeading())
  {
  }
  // Returns the grey value at a point in the frame of the robot (m): 0 on black, 1 on white.
  double GreyAt(double x, double y) const
  {
    const argos::CVector2 at(middle_.GetX() + x * cosine_ - y * sine_, middle_.GetY() + x * sine_ + y * cosine_);
    return functions_.GetFloorColor(at).ToGrayScale() / 255.0;
  }

private:
  PaintedFloor(const argos::CVector3& middle, double heading)
      : functions_(argos::CSimulator::GetInstance().GetLoopFunctions()),
        middle_(middle),
        cosine_(std::cos(heading)),
        sine_(std::sin(heading))
  {
  }

  argos::CLoopFunctions& functions_;
  const argos::CVector3 middle_;
  const double cosine_;
  const double sine_;
};

}  // namespace swarmanoid::argos3
