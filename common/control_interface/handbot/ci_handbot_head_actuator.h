// The head of a handbot: it bears the two arms and turns about the forward axis.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_HandBotHeadActuator : public CCI_Actuator
{
public:
  virtual void SetHeadAngularVelocity(double velocity) = 0;  // rad/s
};

}  // namespace swarmanoid

using swarmanoid::CCI_HandBotHeadActuator;
