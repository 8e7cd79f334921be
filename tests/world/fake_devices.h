// Devices of robots whose readings a test sets and whose commands it reads, for tests of behaviours.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/control_interface/ci_colour_blob_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_laser_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_propellers_actuator.h"
#include "common/control_interface/footbot/ci_footbot_gripper_actuator.h"
#include "common/control_interface/footbot/ci_footbot_gripper_sensor.h"
#include "common/control_interface/footbot/ci_footbot_leds_actuator.h"
#include "common/control_interface/footbot/ci_footbot_light_sensor.h"
#include "common/control_interface/footbot/ci_footbot_omnidirectional_camera_sensor.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"

namespace swarmanoid::test
{

class FakeCamera : public CCI_FootBotOmnidirectionalCameraSensor
{
public:
  std::span<const CCI_ColourBlob> GetAllBlobs() const override { return blobs; }
  std::vector<CCI_ColourBlob> blobs;
};

class FakeGripperSensor : public CCI_FootBotGripperSensor
{
public:
  bool IsGripping() const override { return gripping; }
  double GetAperture() const override { return 0; }
  bool gripping = false;
};

// A ring of 24 sensors.
template <class Interface>
class FakeRing : public Interface
{
public:
  std::span<const double, 24> GetAllSensorReadings() const override
  {
    ++reads;
    return readings;
  }
  std::array<double, 24> readings{};
  mutable int reads = 0;
};
using FakeProximity = FakeRing<CCI_FootBotProximitySensor>;
using FakeLight = FakeRing<CCI_FootBotLightSensor>;

class FakeWheels : public CCI_FootBotWheelsActuator
{
public:
  void SetFootBotWheelsAngularVelocity(double l, double r) override
  {
    left = l;
    right = r;
    ++writes;
  }
  // Returns the commanded speeds, m/s.
  std::array<double, 2> Speeds() const { return {left * WHEEL_RADIUS_M, right * WHEEL_RADIUS_M}; }
  double left = 0, right = 0;  // rad/s
  int writes = 0;
};

class FakeGripper : public CCI_FootBotGripperActuator
{
public:
  void SetGripper(double value) override { closed = value; }
  double closed = 0;
};

class FakeLeds : public CCI_FootBotLedsActuator
{
public:
  void SetColour(unsigned, std::uint32_t value) override { colour = value; }
  void SetAllColours(std::uint32_t value) override { colour = value; }
  std::uint32_t colour = 0;
};

class FakePropellers : public CCI_EyeBotPropellersActuator
{
public:
  void SetVelocity(double x, double y, double z, double yaw) override { velocity = {x, y, z, yaw}; }
  void SetPosition(const swarmanoid::Vector3&, double) override {}
  std::array<double, 4> velocity{};
};

class FakeLaser : public CCI_EyeBotLaserActuator
{
public:
  void SwitchOn() override { on = true; }
  void SwitchOff() override { on = false; }
  void SetColour(std::uint32_t value) override { colour = value; }
  void SetDirection(double, double) override {}
  bool on = false;
  std::uint32_t colour = 0;
};

inline CCI_ColourBlob Blob(std::uint32_t colour, double distance)
{
  CCI_ColourBlob blob;
  blob.colour = colour;
  blob.distance_m = distance;
  return blob;
}

}  // namespace swarmanoid::test
