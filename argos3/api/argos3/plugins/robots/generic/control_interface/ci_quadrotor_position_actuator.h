// Flies to a position.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/core/utility/math/angles.h>
#include <argos3/core/utility/math/vector3.h>

namespace argos
{

class CCI_QuadRotorPositionActuator : public CCI_Actuator
{
public:
  // Set a position in m: in the arena, or ahead, to the left and above the robot.
  virtual void SetAbsolutePosition(const CVector3& position) = 0;
  virtual void SetRelativePosition(const CVector3& position) = 0;
  // Set a heading: in the arena, or relative to the present one.
  virtual void SetAbsoluteYaw(const CRadians& yaw) = 0;
  virtual void SetRelativeYaw(const CRadians& yaw) = 0;
};

}  // namespace argos
