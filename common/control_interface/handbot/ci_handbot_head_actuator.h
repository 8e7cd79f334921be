// The head of a handbot: it has the two arms and turns about the forward axis.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_HandBotHeadActuator : public CCI_ActuatorOf<CCI_HandBotHeadActuator>
{
public:
  static constexpr double MAX_SPEED = 3;  // rad/s
  // rad/s, positive raises the left arm; clamped to MAX_SPEED. What is not a number ends a simulation.
  virtual void SetHeadAngularVelocity(double velocity) = 0;

  static void Declare(Declaration& columns)
  {
    columns.Set({{"velocity", "rad/s"}}, &CCI_HandBotHeadActuator::SetHeadAngularVelocity);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_HandBotHeadActuator;
