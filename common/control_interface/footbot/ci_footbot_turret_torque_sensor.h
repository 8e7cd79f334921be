// The torque and the pull between the body and the turret of a footbot: how others drag what it holds.
#pragma once

#include <array>
#include <span>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotTurretTorqueSensor : public CCI_Sensor
{
public:
  // {torque about the vertical in N m, force along the turret's front in N, force to its left in N}, mean over the last
  // tick.
  virtual std::span<const double, 3> GetAllSensorReadings() const = 0;
  double GetTorque() const { return GetAllSensorReadings()[0]; }
  double GetForwardForce() const { return GetAllSensorReadings()[1]; }
  double GetLeftForce() const { return GetAllSensorReadings()[2]; }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotTurretTorqueSensor;
