// The wheels of a Pi-Puck.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>

namespace argos
{

class CCI_PiPuckDifferentialDriveActuator : public CCI_Actuator
{
public:
  // Sets the speeds of the wheels on the ground, m/s.
  virtual void SetLinearVelocity(Real left, Real right) = 0;
};

}  // namespace argos
