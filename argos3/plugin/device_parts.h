// Shared code for the devices of ARGoS3's robots, and the makers for each robot. Only devices.cpp includes it.
#pragma once

#include <argos3/core/utility/datatypes/color.h>

#include <cmath>

#include "argos3/plugin/device_adapters.h"
#include "common/control_interface/ci_positioning_sensor.h"

namespace swarmanoid::argos3
{

// Return nullptr for a tag that the robot does not have.
std::unique_ptr<SensorBridge> MakeFootBotSensor(const std::string& tag, const DeviceSetup& setup);
std::unique_ptr<ActuatorBridge> MakeFootBotActuator(const std::string& tag, const DeviceSetup& setup);
std::unique_ptr<SensorBridge> MakeEPuckSensor(const std::string& tag, const DeviceSetup& setup);
std::unique_ptr<ActuatorBridge> MakeEPuckActuator(const std::string& tag, const DeviceSetup& setup);
// Makes the camera of foot-bots and eye-bots.
std::unique_ptr<SensorBridge> MakePerspectiveCamera(const DeviceSetup& setup);
std::unique_ptr<ActuatorBridge> MakeEyeBotActuator(const std::string& tag, const DeviceSetup& setup);

inline constexpr double kCentimetres = 100;  // in a metre

// The alpha of a colour is the intensity of the LED.
inline std::uint32_t Lit(const argos::CColor& colour)
{
  const auto shine = [&](std::uint32_t channel) { return channel * colour.GetAlpha() / 255; };
  return shine(colour.GetRed()) << 16U | shine(colour.GetGreen()) << 8U | shine(colour.GetBlue());
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
  // Returns the grey value at a point in the frame of the robot (m): 0 on black, 1 on white.
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

}  // namespace swarmanoid::argos3
