// CCI_WheelsActuator: the two driven wheels of any robot whose kind has them.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_WheelsActuator : public CCI_ActuatorOf<CCI_WheelsActuator>
{
public:
  // Returns the radius of the wheels in m.
  virtual double GetWheelRadius() const = 0;
  // Returns the distance between the wheels in m.
  virtual double GetInterwheelDistance() const = 0;
  // Sets angular velocities in rad/s; positive drives forward. Values beyond the limit of the robot are clamped to it.
  // NaN ends a simulation with an error.
  virtual void SetAngularVelocity(double left, double right) = 0;
  // Sets the speeds of the wheels on the ground in m/s.
  void SetLinearVelocity(double left, double right)
  {
    SetAngularVelocity(left / GetWheelRadius(), right / GetWheelRadius());
  }

  static void Declare(Declaration& columns)
  {
    columns.Set({{"left", "rad/s"}, {"right", "rad/s"}}, &CCI_WheelsActuator::SetAngularVelocity);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_WheelsActuator;
