// A footbot drives on two wheels (treels).
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotWheelsActuator : public CCI_ActuatorOf<CCI_FootBotWheelsActuator>
{
public:
  static constexpr unsigned NUM_WHEELS = 2;
  // Radius of a wheel and distance between the two, in metres (ARGoS3, foot-bot).
  static constexpr double WHEEL_RADIUS_M = 0.029112741;
  static constexpr double INTERWHEEL_DISTANCE_M = 0.14;

  // Sets angular velocities of the wheels in rad/s; positive drives forward. Values beyond the implementation's limit
  // are clamped to it. NaN ends a simulation with an error.
  virtual void SetFootBotWheelsAngularVelocity(double left, double right) = 0;
  // Sets the speeds of the wheels on the ground in m/s: angular velocity times radius.
  void SetFootBotWheelsLinearVelocity(double left, double right)
  {
    SetFootBotWheelsAngularVelocity(left / WHEEL_RADIUS_M, right / WHEEL_RADIUS_M);
  }
  // Group-level form: {left, right} in rad/s.
  void SetAllActuatorOutputs(const double (&velocities)[NUM_WHEELS])
  {
    SetFootBotWheelsAngularVelocity(velocities[0], velocities[1]);
  }

  static void Declare(Declaration& columns)
  {
    columns.Set({{"left", "rad/s"}, {"right", "rad/s"}}, &CCI_FootBotWheelsActuator::SetFootBotWheelsAngularVelocity);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotWheelsActuator;
