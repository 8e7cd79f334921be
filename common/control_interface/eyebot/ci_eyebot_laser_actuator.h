// The laser of an eyebot: projects a coloured spot on the floor, or on a body that stands there. Cameras see the spot.
#pragma once

#include <cstdint>

#include "common/control_interface/ci_colour.h"
#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_EyeBotLaserActuator : public CCI_ActuatorOf<CCI_EyeBotLaserActuator>
{
public:
  // Switches the laser on. It is off at first.
  virtual void SwitchOn() = 0;
  // Switches the laser off.
  virtual void SwitchOff() = 0;
  // Sets the colour of the spot, 0xRRGGBB. It is red at first; 0 shows no spot.
  virtual void SetColour(std::uint32_t colour) = 0;
  // The tilt is at most 70 degrees.
  static constexpr double MAX_TILT = 1.2217304763960306;  // rad
  // Sets the direction of the laser. The tilt is in radians from straight down, clamped to 0..MAX_TILT. The pan is the
  // direction of the tilt, radians counter-clockwise from the front. A value that is not finite ends a simulation with
  // an error.
  virtual void SetDirection(double pan, double tilt) = 0;

  static void Declare(Declaration& columns)
  {
    columns.Set(
        {{"on", "yes/no", 0, 1}, {"colour", "colour", 0, 0xffffff}, {"pan", "rad"}, {"tilt", "rad", 0, MAX_TILT}},
        [](CCI_EyeBotLaserActuator& it, std::span<const double> values)
        {
          values[0] > 0.5 ? it.SwitchOn() : it.SwitchOff();
          it.SetColour(CCI_Colour::FromNumber(values[1]));
          it.SetDirection(values[2], values[3]);
        });
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_EyeBotLaserActuator;
