// The two driven wheels of any robot whose kind has them.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_WheelsActuator : public CCI_Actuator
{
public:
  // Metres.
  virtual double GetWheelRadius() const = 0;
  virtual double GetInterwheelDistance() const = 0;
  // Angular velocities in rad/s; positive drives forward. Values beyond the limit of the robot are clamped to it; one
  // that is not a number ends a simulation with an error.
  virtual void SetAngularVelocity(double left, double right) = 0;
  // Speeds of the wheels on the ground in m/s.
  void SetLinearVelocity(double left, double right)
  {
    SetAngularVelocity(left / GetWheelRadius(), right / GetWheelRadius());
  }

  std::vector<CCI_Column> Columns() const override { return {{"left", "rad/s"}, {"right", "rad/s"}}; }
  void SetColumns(std::span<const double> values) override { SetAngularVelocity(values[0], values[1]); }
};

}  // namespace swarmanoid

using swarmanoid::CCI_WheelsActuator;
