// A footbot has an accelerometer in its body. Only engines that know forces provide it.
#pragma once

#include <span>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotAccelerometerSensor : public CCI_SensorOf<CCI_FootBotAccelerometerSensor>
{
public:
  // Returns {forward, left, up} in m/s^2 in the frame of the body, as means over the last tick. At rest the readings
  // are {0, 0, 9.81}, since the sensor measures the force that holds the robot against gravity.
  virtual std::span<const double, 3> GetAllSensorReadings() const = 0;

  static void Declare(Declaration& columns)
  {
    columns.AddAll({{"forward", "m/s^2"}, {"left", "m/s^2"}, {"up", "m/s^2"}},
                   &CCI_FootBotAccelerometerSensor::GetAllSensorReadings);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotAccelerometerSensor;
