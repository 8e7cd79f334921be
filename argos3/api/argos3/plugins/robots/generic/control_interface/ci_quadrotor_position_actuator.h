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
  // Sets a position in the arena (m) to fly to.
  virtual void SetAbsolutePosition(const CVector3& position) = 0;
  // Sets a position to fly to, in m ahead, to the left and above the robot.
  virtual void SetRelativePosition(const CVector3& position) = 0;
  // Sets a heading in the arena.
  virtual void SetAbsoluteYaw(const CRadians& yaw) = 0;
  // Sets a heading relative to the present one.
  virtual void SetRelativeYaw(const CRadians& yaw) = 0;
};

}  // namespace argos
