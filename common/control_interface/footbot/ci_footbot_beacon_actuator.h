// The beacon on top of a footbot: one LED, seen from all sides.
#pragma once

#include <cstdint>

#include "common/control_interface/ci_colour.h"
#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotBeaconActuator : public CCI_ActuatorOf<CCI_FootBotBeaconActuator>
{
public:
  // Sets the colour of the beacon, 0xRRGGBB. 0 is off, and higher bits are ignored.
  virtual void SetColour(std::uint32_t colour) = 0;

  static void Declare(Declaration& columns)
  {
    columns.Set({{"colour", "colour", 0, 0xffffff}}, &CCI_FootBotBeaconActuator::SetColour);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotBeaconActuator;
