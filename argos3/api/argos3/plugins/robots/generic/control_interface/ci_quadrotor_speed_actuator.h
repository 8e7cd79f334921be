// Flies at a velocity.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/core/utility/math/angles.h>
#include <argos3/core/utility/math/vector3.h>

namespace argos
{

class CCI_QuadRotorSpeedActuator : public CCI_Actuator
{
public:
  // Sets the velocity in m/s ahead, to the left and up.
  virtual void SetLinearVelocity(const CVector3& velocity) = 0;
  // Sets the yaw rate in rad/s, counter-clockwise.
  virtual void SetRotationalSpeed(const CRadians& speed) = 0;
};

}  // namespace argos
