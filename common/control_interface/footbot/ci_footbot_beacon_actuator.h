// The beacon on top of a footbot: one LED, seen from all sides.
#pragma once

#include <cstdint>

#include "common/control_interface/ci_colour.h"
#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotBeaconActuator : public CCI_Actuator
{
public:
  virtual void SetColour(std::uint32_t colour) = 0;  // 0xRRGGBB, 0 is off; higher bits are ignored

  std::vector<CCI_Column> Columns() const override { return {{"colour", "colour", 0, 0xffffff}}; }
  void SetColumns(std::span<const double> values) override { SetColour(CCI_Colour::FromNumber(values[0])); }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotBeaconActuator;
