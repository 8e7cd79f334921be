// The accelerometer of a footbot. Only engines that know forces provide it.
#pragma once

#include <span>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotAccelerometerSensor : public CCI_Sensor
{
public:
  // {forward, left, up} in m/s^2 in the frame of the body, mean over the last tick; at rest {0, 0, 9.81}: what holds
  // the robot against gravity is felt.
  virtual std::span<const double, 3> GetAllSensorReadings() const = 0;
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotAccelerometerSensor;
