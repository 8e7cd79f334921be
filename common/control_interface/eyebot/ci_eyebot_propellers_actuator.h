// The propulsion of an eyebot, by velocity or by position.
#pragma once

#include "common/control_interface/ci_device.h"
#include "common/math/pose.h"

namespace swarmanoid
{

class CCI_EyeBotPropellersActuator : public CCI_Actuator
{
public:
  // Velocity in the frame of the robot: forward, left, up in m/s; yaw rate in rad/s, positive counter-clockwise.
  // Clamped to the limits of the implementation; what is not a number ends a simulation. Planes ignore `up`.
  virtual void SetVelocity(double forward, double left, double up, double yaw_rate) = 0;
  // Flies to a position (m, in the space) and a heading (radians) and hovers there, until told otherwise. What
  // is not a finite number ends a simulation with an error. Implementations without position control throw
  // CCI_DeviceError.
  virtual void SetPosition(const Vector3& position, double yaw) = 0;
  void Hover() { SetVelocity(0, 0, 0, 0); }

  std::vector<CCI_Column> Columns() const override
  {
    return {{"forward", "m/s"}, {"left", "m/s"}, {"up", "m/s"}, {"yaw rate", "rad/s"}};
  }
  void SetColumns(std::span<const double> values) override { SetVelocity(values[0], values[1], values[2], values[3]); }
};

}  // namespace swarmanoid

using swarmanoid::CCI_EyeBotPropellersActuator;
