// The devices of ARGoS3, based on ours: they convert units, names and the time of reading.
#pragma once

#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/plugins/robots/kilobot/control_interface/message.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "argos3/library/running.h"
#include "common/control_interface/ci_robot.h"

namespace swarmanoid::argos3
{

// The message of a Kilobot on its way.
struct KilobotRadio
{
  std::optional<message_t> waiting;  // it is sent if no other robot is in the way
  std::optional<message_t> sent;     // others receive it in the next step
};

// The arguments of a device beside the robot.
struct DeviceSetup
{
  CCI_Robot& robot;
  const Translation& translation;
  // The controller's attributes that are no parameters of our devices.
  TConfigurationTree options;
  // The last commanded speeds of the wheels; for e-pucks with the noise of the latest step.
  std::shared_ptr<WheelSpeeds> told_wheels = std::make_shared<WheelSpeeds>();
  // The sender and the receiver of a Kilobot share this object.
  std::shared_ptr<KilobotRadio> kilobot_radio = std::make_shared<KilobotRadio>();
};

// A sensor that reads our sensor before each control step, or when the controller first asks for the readings of a
// step.
class SensorBridge : private argos::CSensorReader
{
public:
  // Returns the sensor for the controller.
  virtual argos::CCI_Sensor& Sensor() = 0;
  // Takes the readings of our sensor.
  virtual void Update() = 0;
  // Called before the controller's Init. A controller that asks for readings there may keep the reference, so they are
  // then updated before each step.
  void BeforeInit() { Sensor().ReadOnDemand(*this); }
  // Called before each control step. Sensors that cost time or are not always read call OnDemand, except if they draw
  // random numbers.
  virtual void BeforeStep() { Update(); }

protected:
  // With `draws` it reads at once, since the order of random numbers may not depend on the controller.
  void OnDemand(bool draws = false)
  {
    if (is_kept_ || draws) return Update();
    has_begun_ = true;
    Sensor().ReadOnDemand(*this);
  }

private:
  void Read() final
  {
    if (has_begun_)
      Update();
    else
      is_kept_ = true;
  }

  bool has_begun_ = false;
  bool is_kept_ = false;
};

// An actuator that passes deferred commands to our actuator after each control step.
class ActuatorBridge
{
public:
  virtual ~ActuatorBridge() = default;
  // Returns the actuator for the controller.
  virtual argos::CCI_Actuator& Actuator() = 0;
  // Passes deferred commands to our actuator, after each control step.
  virtual void Commit() {}
};

// Returns nullptr for a tag without a bridge. Throws CCI_DeviceError if the controller does not list our device.
std::unique_ptr<SensorBridge> MakeSensor(const std::string& tag, const DeviceSetup& setup);
std::unique_ptr<ActuatorBridge> MakeActuator(const std::string& tag, const DeviceSetup& setup);

}  // namespace swarmanoid::argos3
