// CCI_GyroscopeSensor: the angular velocities of a robot.
#pragma once

#include <span>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_GyroscopeSensor : public CCI_SensorOf<CCI_GyroscopeSensor>
{
public:
  // Returns {roll, pitch, yaw}: angular velocities in rad/s about the robot's axes to the front, to the left and up.
  // They are means over the last tick, positive counter-clockwise. The span is valid until the next control step.
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
