// PoweredDevice: a sensor or actuator of one's own that draws power from the batteries of its robots
// (docs/batteries.md). It is a second base class of a SensorBatch or an ActuatorBatch.
#pragma once

#include <cstddef>

namespace swarmanoid
{

class PoweredDevice
{
public:
  virtual ~PoweredDevice() = default;
  // Returns the power (W, at least 0) that the device of robot k draws in this tick, by its present settings. Called
  // once a tick, after Commit, for robots with an energy_battery that are not switched off.
  virtual double Power(std::size_t k) const = 0;
};

}  // namespace swarmanoid
