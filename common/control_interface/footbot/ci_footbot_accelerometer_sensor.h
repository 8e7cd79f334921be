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

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    const auto values = GetAllSensorReadings();
    readings.push_back({"forward", "m/s^2", values[0]});
    readings.push_back({"left", "m/s^2", values[1]});
    readings.push_back({"up", "m/s^2", values[2]});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotAccelerometerSensor;
