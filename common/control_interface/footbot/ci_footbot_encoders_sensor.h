// The wheel encoders of a footbot: odometry. They measure how the wheels turned, which differs from the command if the
// robot was blocked or pulled.
#pragma once

#include <span>

#include "common/control_interface/ci_device.h"
#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"

namespace swarmanoid
{

class CCI_FootBotEncodersSensor : public CCI_SensorOf<CCI_FootBotEncodersSensor>
{
public:
  // Returns {left, right}: the mean angular velocities over the last tick, rad/s. The span is valid until the next
  // control step.
  virtual std::span<const double, 2> GetAllSensorReadings() const = 0;
  double GetLeftVelocity() const { return GetAllSensorReadings()[0]; }
  double GetRightVelocity() const { return GetAllSensorReadings()[1]; }
  // Return the metres that a wheel rolled in a tick of that length.
  double GetLeftDistance(double tick_s) const
  {
    return GetLeftVelocity() * tick_s * CCI_FootBotWheelsActuator::WHEEL_RADIUS_M;
  }
  double GetRightDistance(double tick_s) const
  {
    return GetRightVelocity() * tick_s * CCI_FootBotWheelsActuator::WHEEL_RADIUS_M;
  }

  static void Declare(Declaration& columns)
  {
    columns.AddAll({{"left", "rad/s"}, {"right", "rad/s"}}, &CCI_FootBotEncodersSensor::GetAllSensorReadings);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotEncodersSensor;
