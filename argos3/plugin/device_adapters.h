// The devices of ARGoS3 over ours: units, names and the moment at which they are read.
#pragma once

#include <argos3/core/control_interface/ci_controller.h>

#include <memory>
#include <string>
#include <vector>

#include "argos3/library/running.h"
#include "common/control_interface/ci_robot.h"

namespace swarmanoid::argos3
{

// What a device needs besides those of the robot.
struct DeviceSetup
{
  CCI_Robot& robot;
  const Translation& translation;
  // Of the controller: attributes that are no parameters of our devices.
  TConfigurationTree options;
  // What the wheels were told last; of e-pucks with the noise of the latest step.
  std::shared_ptr<WheelSpeeds> told_wheels = std::make_shared<WheelSpeeds>();
};

// A sensor that reads ours before each control step.
class SensorBridge
{
public:
  virtual ~SensorBridge() = default;
  virtual argos::CCI_Sensor& Sensor() = 0;
  virtual void Update() = 0;
};

// An actuator that tells ours after each control step what has not been told at once.
class ActuatorBridge
{
public:
  virtual ~ActuatorBridge() = default;
  virtual argos::CCI_Actuator& Actuator() = 0;
  virtual void Commit() {}
};

// nullptr for a tag that has no bridge. Throw CCI_DeviceError if the controller does not list ours.
std::unique_ptr<SensorBridge> MakeSensor(const std::string& tag, const DeviceSetup& setup);
std::unique_ptr<ActuatorBridge> MakeActuator(const std::string& tag, const DeviceSetup& setup);

}  // namespace swarmanoid::argos3
