// The gripper of a foot-bot.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/core/utility/math/angles.h>

namespace argos
{

class CCI_FootBotGripperActuator : public CCI_Actuator
{
public:
  static const CRadians UNLOCKED;
  static const CRadians LOCKED_POSITIVE;
  static const CRadians LOCKED_NEGATIVE;

  // Sets the angle of the jaws: 0 is open, +-pi/2 is closed.
  virtual void SetAperture(const CRadians& aperture) = 0;
  // Does nothing here, since the gripper always reports what it holds.
  virtual void EnableCheckForObjectGrippedRoutine() {}
  // Does nothing here.
  virtual void DisableCheckForObjectGrippedRoutine() {}
  void LockPositive() { SetAperture(LOCKED_POSITIVE); }
  void LockNegative() { SetAperture(LOCKED_NEGATIVE); }
  void Unlock() { SetAperture(UNLOCKED); }
};

inline const CRadians CCI_FootBotGripperActuator::UNLOCKED{0};
inline const CRadians CCI_FootBotGripperActuator::LOCKED_POSITIVE{ARGOS_PI / 2};
inline const CRadians CCI_FootBotGripperActuator::LOCKED_NEGATIVE{-ARGOS_PI / 2};

}  // namespace argos
