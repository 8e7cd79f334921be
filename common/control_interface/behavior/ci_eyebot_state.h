// CCI_EyeBotState: the robot state of an eyebot. Getters and setters of devices that the controller does not list throw
// CCI_DeviceError.
#pragma once

#include <array>
#include <vector>

#include "common/control_interface/behavior/ci_seeing_robot_state.h"
#include "common/control_interface/eyebot/ci_eyebot_altitude_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_attachment_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_camera_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_laser_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_leds_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_propellers_actuator.h"

namespace swarmanoid
{

class CCI_EyeBotState : public CCI_SeeingRobotState<CCI_EyeBotLedsActuator>
{
public:
  explicit CCI_EyeBotState(CCI_Robot* robot) : CCI_SeeingRobotState(robot, "eyebot_camera", "eyebot_leds") {}

  // Looks up the devices that the controller lists. Call it once, before the first tick.
  void Init();
  // ReadSensors is called at the start of a control step, and WriteActuators at its end.
  void ReadSensors();
  void WriteActuators();

  // Sensors. Angles are in radians counter-clockwise from the front, distances in metres.
  double GetAltitude() const;

  // Actuators. Settings of earlier steps are not part of a saved state, so a behaviour that needs them must store them.
  void SetVelocity(double forward, double left, double up, double yaw_rate);  // m/s in the robot's frame, rad/s
  const std::array<double, 4>& GetVelocity() const { return velocity_.Get(); }
  // Flies to the position and hovers, see CCI_EyeBotPropellersActuator. If both velocity and position are set, the
  // later call counts.
  void SetPosition(const Vector3& position, double yaw);
  void SwitchLaserOn(std::uint32_t colour);
  void SwitchLaserOff();
  bool IsLaserOn() const { return laser_.Get().on; }
  void SetLaserDirection(double pan, double tilt);  // radians, see CCI_EyeBotLaserActuator
  void Attach();
  void Detach();

private:
  struct Devices
  {
    CCI_EyeBotAltitudeSensor* altitude = nullptr;
    CCI_EyeBotPropellersActuator* propellers = nullptr;
    CCI_EyeBotLaserActuator* laser = nullptr;
    CCI_EyeBotAttachmentActuator* attachment = nullptr;
  };
  struct Laser
  {
    bool on = false;
    std::uint32_t colour = 0xff0000;
    double pan = 0;
    double tilt = 0;
  };

  Devices devices_;

  double altitude_ = 0;

  PendingValue<std::array<double, 4>> velocity_;
  PendingValue<std::array<double, 4>> position_;  // x, y, z, yaw
  PendingValue<Laser> laser_;
  PendingValue<bool> attached_;
};

}  // namespace swarmanoid

using swarmanoid::CCI_EyeBotState;
