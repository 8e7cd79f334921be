// An eyebot has 16 LEDs around it.
#pragma once

#include "common/control_interface/ci_led_ring_actuator.h"

namespace swarmanoid
{

class CCI_EyeBotLedsActuator : public CCI_LedRingActuator
{
public:
  static constexpr unsigned NUM_LEDS = 16;
  unsigned GetNumLeds() const override { return NUM_LEDS; }
};

}  // namespace swarmanoid

using swarmanoid::CCI_EyeBotLedsActuator;
