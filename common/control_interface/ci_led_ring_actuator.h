// A ring of coloured LEDs. The base of the rings of all robots.
#pragma once

#include <cstdint>

#include "common/control_interface/ci_colour.h"
#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_LedRingActuator : public CCI_Actuator
{
public:
  virtual unsigned GetNumLeds() const = 0;
  // Colours are 0xRRGGBB, 0 is off. LEDs count counter-clockwise from the front left; an index beyond the ring throws
  // std::out_of_range.
  virtual void SetAllColours(std::uint32_t colour) = 0;
  virtual void SetColour(unsigned led, std::uint32_t colour) = 0;
};

}  // namespace swarmanoid

using swarmanoid::CCI_LedRingActuator;
