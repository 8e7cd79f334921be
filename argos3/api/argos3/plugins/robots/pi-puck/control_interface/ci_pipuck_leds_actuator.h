// The LEDs of a Pi-Puck, which are on (white) or off.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>

namespace argos
{

class CCI_PiPuckLEDsActuator : public CCI_Actuator
{
public:
  // Switches an LED of the ring, 0 to 7. Other numbers print an error.
  virtual void SetRingLEDIndex(UInt32 index, bool on) = 0;
  virtual void SetRingLEDs(bool on) = 0;
  virtual void SetFrontLED(bool on) = 0;
  virtual void SetBodyLED(bool on) = 0;

protected:
  static const UInt32 NUM_LEDS = 10;
  static const UInt32 NUM_RING_LEDS = 8;
  static const UInt32 INDEX_FRONT_LED = 8;
  static const UInt32 INDEX_BODY_LED = 9;
};

}  // namespace argos
