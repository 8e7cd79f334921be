// The accelerometer of a footbot. Only engines that know forces provide it.
#pragma once

#include <span>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotAccelerometerSensor : public CCI_SensorOf<CCI_FootBotAccelerometerSensor>
{
public:
  // {forward, left, up} in m/s^2 in the frame of the body, mean over the last tick; at rest {0, 0, 9.81}: what holds
  // the robot against gravity is felt.
  virtual std::span<const double, 3> GetAllSensorReadings() const = 0;

  static void Declare(Declaration& columns)
  {
    columns.AddAll({{"forward", "m/s^2"}, {"left", "m/s^2"}, {"up", "m/s^2"}},
                   &CCI_FootBotAccelerometerSensor::GetAllSensorReadings);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotAccelerometerSensor;
