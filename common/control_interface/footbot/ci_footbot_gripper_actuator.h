// A footbot has its gripper at the front of its turret.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotGripperActuator : public CCI_ActuatorOf<CCI_FootBotGripperActuator>
{
public:
  // 0 is open and 1 is closed. Beyond LOCK_THRESHOLD the gripper grips the body that it touches and keeps it (ARGoS3,
  // foot-bot).
  static constexpr double LOCK_THRESHOLD = 0.5;

  // Sets the gripper. Values are clamped to 0..1. NaN ends a simulation with an error.
  virtual void SetGripper(double closed) = 0;
  void Grip() { SetGripper(1); }
  void Release() { SetGripper(0); }

  static void Declare(Declaration& columns)
  {
    columns.Set({{"closed", "", 0, 1}}, &CCI_FootBotGripperActuator::SetGripper);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotGripperActuator;
