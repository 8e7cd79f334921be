// CCI_LedRingActuator: a ring of coloured LEDs. The base of the rings of all robots.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include "common/control_interface/ci_colour.h"
#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_LedRingActuator : public CCI_ActuatorOf<CCI_LedRingActuator>
{
public:
  // Returns the number of LEDs on the ring.
  virtual unsigned GetNumLeds() const = 0;
  // Sets all LEDs. Colours are 0xRRGGBB, 0 is off; higher bits are ignored.
  virtual void SetAllColours(std::uint32_t colour) = 0;
  // Sets a colour for each LED. Throws std::invalid_argument unless there are GetNumLeds() colours.
  void SetAllActuatorOutputs(std::span<const std::uint32_t> colours)
  {
    if (colours.size() != GetNumLeds())
      throw std::invalid_argument(std::to_string(colours.size()) + " colours for a ring of " +
                                  std::to_string(GetNumLeds()) + " LEDs");
    for (unsigned led = 0; led < GetNumLeds(); ++led) SetColour(led, colours[led]);
  }
  // Sets one LED. LEDs count counter-clockwise from the front left. An index beyond the ring throws std::out_of_range.
  virtual void SetColour(unsigned led, std::uint32_t colour) = 0;

  static void Declare(Declaration& columns)
  {
    columns.Set(
        {{"led #", "colour", 0, 0xffffff}},
        [](CCI_LedRingActuator& ring, std::span<const double> values)
        {
          for (unsigned led = 0; led < values.size(); ++led) ring.SetColour(led, CCI_Colour::FromNumber(values[led]));
        },
        &CCI_LedRingActuator::GetNumLeds);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_LedRingActuator;
