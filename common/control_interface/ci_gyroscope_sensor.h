// How fast a robot turns.
#pragma once

#include <span>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_GyroscopeSensor : public CCI_SensorOf<CCI_GyroscopeSensor>
{
public:
  // {roll, pitch, yaw}: angular velocities in rad/s about the axes of the robot ahead, to the left and up, mean over
  // the last tick; positive counter-clockwise about each. Valid until the next control step.
  virtual std::span<const double, 3> GetAllSensorReadings() const = 0;
  double GetYawRate() const { return GetAllSensorReadings()[2]; }

  static void Declare(Declaration& columns)
  {
    columns.AddAll({{"roll", "rad/s"}, {"pitch", "rad/s"}, {"yaw", "rad/s"}},
                   &CCI_GyroscopeSensor::GetAllSensorReadings);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_GyroscopeSensor;
