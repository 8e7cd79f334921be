// Devices of robots whose readings a test sets and whose commands it reads, for tests of behaviour diagrams.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "user/controllers/prey_retrieval/eyebot_guide.h"
#include "user/controllers/prey_retrieval/footbot_retriever.h"

namespace swarmanoid::test
{

class FakeCamera : public CCI_ColourBlobSensor
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

class FakeProximity : public CCI_FootBotProximitySensor
{
public:
  std::span<const double, NUM_SENSORS> GetAllSensorReadings() const override { return readings; }
  std::array<double, NUM_SENSORS> readings{};
};

class FakeWheels : public CCI_FootBotWheelsActuator
{
public:
  void SetFootBotWheelsAngularVelocity(double l, double r) override
  {
    left = l;
    right = r;
  }
  double left = 0;
  double right = 0;
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
