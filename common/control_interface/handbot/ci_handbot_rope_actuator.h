// The rope of a handbot: the robot shoots it to the ceiling, and climbs on it by its winch.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_HandBotRopeActuator : public CCI_ActuatorOf<CCI_HandBotRopeActuator>
{
public:
  static constexpr double MAX_WINCH_SPEED = 0.15;  // m/s
  // Shoots the rope, which attaches to the ceiling or body above until Release.
  virtual void Launch() = 0;
  // Detaches the rope from the ceiling.
  virtual void Release() = 0;
  // Sets the speed of rope let out, in m/s, clamped to MAX_WINCH_SPEED. Negative values pull the robot up. NaN ends a
  // simulation with an error.
  virtual void SetWinchVelocity(double velocity) = 0;

  static void Declare(Declaration& columns)
  {
    columns.Set({{"attached", "yes/no", 0, 1}, {"winch", "m/s"}},
                [](CCI_HandBotRopeActuator& it, std::span<const double> values)
                {
                  values[0] > 0.5 ? it.Launch() : it.Release();
                  it.SetWinchVelocity(values[1]);
                });
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_HandBotRopeActuator;
