// The two wheels of a robot.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>

namespace argos
{

class CCI_DifferentialSteeringActuator : public CCI_Actuator
{
public:
  // Sets the speeds on the ground in cm/s.
  virtual void SetLinearVelocity(Real left, Real right) = 0;
};

}  // namespace argos
