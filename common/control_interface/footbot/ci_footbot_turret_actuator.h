// The turret of a footbot: it has gripper and LED ring and turns against the body.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotTurretActuator : public CCI_Actuator
{
public:
  // rad/s, positive counter-clockwise; clamped to the limit of the implementation. What is not a number ends a
  // simulation.
  virtual void SetTurretAngularVelocity(double velocity) = 0;

  std::vector<CCI_Column> Columns() const override { return {{"velocity", "rad/s"}}; }
  void SetColumns(std::span<const double> values) override { SetTurretAngularVelocity(values[0]); }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotTurretActuator;
