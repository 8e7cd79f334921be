// The turret of a foot-bot.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/core/utility/math/angles.h>

namespace argos
{

class CCI_FootBotTurretActuator : public CCI_Actuator
{
public:
  enum ETurretModes
  {
    MODE_OFF,
    MODE_PASSIVE,
    MODE_SPEED_CONTROL,
    MODE_POSITION_CONTROL
  };

  // Sets the angle to turn to in the mode MODE_POSITION_CONTROL, counter-clockwise.
  virtual void SetRotation(const CRadians& angle) = 0;
  // Sets the speed in rad/s, counter-clockwise.
  virtual void SetRotationSpeed(SInt32 speed) = 0;
  // Sets the mode: off, passive, at a speed, or to an angle.
  virtual void SetMode(ETurretModes mode) = 0;
  void SetActiveWithRotation(const CRadians& angle)
  {
    SetPositionControlMode();
    SetRotation(angle);
  }
  void SetSpeedControlMode() { SetMode(MODE_SPEED_CONTROL); }
  void SetPositionControlMode() { SetMode(MODE_POSITION_CONTROL); }
  void SetPassiveMode() { SetMode(MODE_PASSIVE); }
  void SetOffMode() { SetMode(MODE_OFF); }
  bool IsTurretAvailableForCommands() const { return true; }
};

}  // namespace argos
