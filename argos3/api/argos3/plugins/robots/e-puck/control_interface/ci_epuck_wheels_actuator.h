// The wheels of an e-puck of argos3-epuck.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/core/utility/logging/argos_log.h>

namespace argos
{

class CCI_EPuckWheelsActuator : public CCI_Actuator
{
public:
  // The limits of the real robot, cm/s. The simulated one has none.
  static const Real MAX_VELOCITY_CM_SEC;
  static const Real MIN_VELOCITY_CM_SEC;
  // Sets the speeds of the wheels on the ground, cm/s.
  virtual void SetLinearVelocity(Real left, Real right) = 0;
};

}  // namespace argos
