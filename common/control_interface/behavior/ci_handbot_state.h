// CCI_HandBotState: the robot state of a handbot. Getters and setters of devices that the controller does not list
// throw CCI_DeviceError.
#pragma once

#include <array>
#include <vector>

#include "common/control_interface/behavior/ci_seeing_robot_state.h"
#include "common/control_interface/handbot/ci_handbot_arms_actuator.h"
#include "common/control_interface/handbot/ci_handbot_beacon_actuator.h"
#include "common/control_interface/handbot/ci_handbot_camera_sensor.h"
#include "common/control_interface/handbot/ci_handbot_hands_actuator.h"
#include "common/control_interface/handbot/ci_handbot_head_actuator.h"
#include "common/control_interface/handbot/ci_handbot_joints_sensor.h"
#include "common/control_interface/handbot/ci_handbot_leds_actuator.h"
#include "common/control_interface/handbot/ci_handbot_rope_actuator.h"

namespace swarmanoid
{

class CCI_HandBotState : public CCI_SeeingRobotState<CCI_HandBotLedsActuator>
{
public:
  explicit CCI_HandBotState(CCI_Robot* robot) : CCI_SeeingRobotState(robot, "handbot_camera", "handbot_leds") {}

  // Looks up the devices that the controller lists. Call it once, before the first tick.
  void Init();
  // ReadSensors is called at the start of a control step, and WriteActuators at its end.
  void ReadSensors();
  void WriteActuators();

  // Sensors. GetJoint returns radians or metres, see CCI_HandBotJointsSensor.
  double GetJoint(CCI_HandBotJointsSensor::Reading joint) const;
  bool IsHolding(CCI_HandBotHandsActuator::Hand hand) const;
  const std::string& GetHeldId(CCI_HandBotHandsActuator::Hand hand) const;

  // Actuators. Velocities are in rad/s and m/s.
  void SetArmVelocities(double left, double right);
  void SetWristVelocities(double left, double right);
  void SetHeadAngularVelocity(double velocity);
  void CloseHand(CCI_HandBotHandsActuator::Hand hand);
  void OpenHand(CCI_HandBotHandsActuator::Hand hand);
  void LaunchRope();
  void ReleaseRope();
  void SetWinchVelocity(double velocity);  // speed of rope let out; negative values pull the robot up
  void SetBeaconColour(std::uint32_t colour);

private:
  struct Devices
  {
    CCI_HandBotJointsSensor* joints = nullptr;
    CCI_HandBotArmsActuator* arms = nullptr;
    CCI_HandBotHeadActuator* head = nullptr;
    CCI_HandBotHandsActuator* hands = nullptr;
    CCI_HandBotRopeActuator* rope = nullptr;
    CCI_HandBotBeaconActuator* beacon = nullptr;
  };

  Devices devices_;

  std::array<double, CCI_HandBotJointsSensor::NUM_READINGS> joints_{};
  std::array<std::string, 2> held_ids_;

  PendingValue<std::array<double, 2>> arms_;
  PendingValue<std::array<double, 2>> wrists_;
  PendingValue<double> head_;
  std::array<PendingValue<bool>, 2> hands_closed_;
  PendingValue<bool> rope_launched_;
  PendingValue<double> winch_;
  PendingValue<std::uint32_t> beacon_;
};

}  // namespace swarmanoid

using swarmanoid::CCI_HandBotState;
