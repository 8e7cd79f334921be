// The head of a handbot: it has the two arms and turns about the forward axis.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_HandBotHeadActuator : public CCI_ActuatorOf<CCI_HandBotHeadActuator>
{
public:
  static constexpr double MAX_SPEED = 3;  // rad/s
  // Sets the angular velocity in rad/s, clamped to MAX_SPEED. Positive values raise the left arm. NaN ends a simulation
  // with an error.
  virtual void SetHeadAngularVelocity(double velocity) = 0;

  static void Declare(Declaration& columns)
  {
    columns.Set({{"velocity", "rad/s"}}, &CCI_HandBotHeadActuator::SetHeadAngularVelocity);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_HandBotHeadActuator;
