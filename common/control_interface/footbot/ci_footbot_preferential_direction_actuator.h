// Shows a direction on the LED ring of a footbot. Use this device or footbot_leds, not both: the one that is listed
// later in the experiment file wins.
#pragma once

#include <cstdint>

#include "common/control_interface/ci_colour.h"
#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotPreferentialDirectionActuator : public CCI_ActuatorOf<CCI_FootBotPreferentialDirectionActuator>
{
public:
  // Lights the LEDs around this direction, radians counter-clockwise from the front of the body, in a colour
  // (0xRRGGBB). A direction that is not a finite number ends a simulation with an error.
  virtual void SetDirection(double angle, std::uint32_t colour) = 0;
  // Switches the LEDs of the direction off.
  virtual void HideDirection() = 0;

  static void Declare(Declaration& columns)
  {
    columns.Set({{"shown", "yes/no", 0, 1}, {"angle", "rad"}, {"colour", "colour", 0, 0xffffff}},
                [](CCI_FootBotPreferentialDirectionActuator& it, std::span<const double> values) {
                  values[0] > 0.5 ? it.SetDirection(values[1], CCI_Colour::FromNumber(values[2])) : it.HideDirection();
                });
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotPreferentialDirectionActuator;
