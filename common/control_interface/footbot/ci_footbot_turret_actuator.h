// The turret of a footbot: it has gripper and LED ring and turns against the body.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotTurretActuator : public CCI_ActuatorOf<CCI_FootBotTurretActuator>
{
public:
  // Sets the angular velocity in rad/s, positive counter-clockwise, clamped to the limit of the implementation. NaN
  // ends a simulation with an error.
  virtual void SetTurretAngularVelocity(double velocity) = 0;

  static void Declare(Declaration& columns)
  {
    columns.Set({{"velocity", "rad/s"}}, &CCI_FootBotTurretActuator::SetTurretAngularVelocity);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotTurretActuator;
