// The beacon on top of a handbot: one LED, seen from all sides.
#pragma once

#include <cstdint>

#include "common/control_interface/ci_colour.h"
#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_HandBotBeaconActuator : public CCI_Actuator
{
public:
  virtual void SetColour(std::uint32_t colour) = 0;  // 0xRRGGBB, 0 is off; higher bits are ignored
};

}  // namespace swarmanoid

using swarmanoid::CCI_HandBotBeaconActuator;
