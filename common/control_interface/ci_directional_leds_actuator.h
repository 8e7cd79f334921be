// CCI_DirectionalLedsActuator: LEDs of any robot that has some, each visible only from within a cone about its axis.
// Cameras see them as LEDs behind a lens.
#pragma once

#include "common/control_interface/ci_led_ring_actuator.h"

namespace swarmanoid
{

class CCI_DirectionalLedsActuator : public CCI_LedRingActuator
{
public:
  // Returns the angle between the axis of each cone and its border, rad, 0 to pi.
  virtual double GetObservableAngle() const = 0;
};

}  // namespace swarmanoid

using swarmanoid::CCI_DirectionalLedsActuator;
