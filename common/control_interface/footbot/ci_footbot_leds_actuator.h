// A footbot has 12 LEDs around its turret. They turn with it.
#pragma once

#include "common/control_interface/ci_led_ring_actuator.h"

namespace swarmanoid
{

class CCI_FootBotLedsActuator : public CCI_LedRingActuator
{
public:
  static constexpr unsigned NUM_LEDS = 12;
  unsigned GetNumLeds() const override { return NUM_LEDS; }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotLedsActuator;
