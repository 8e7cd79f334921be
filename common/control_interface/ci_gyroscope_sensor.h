// How fast a robot turns.
#pragma once

#include <span>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_GyroscopeSensor : public CCI_Sensor
{
public:
  // {roll, pitch, yaw}: angular velocities in rad/s about the axes of the robot ahead, to the left and up, mean over
  // the last tick; positive counter-clockwise about each. Valid until the next control step.
  virtual std::span<const double, 3> GetAllSensorReadings() const = 0;
  double GetYawRate() const { return GetAllSensorReadings()[2]; }

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    readings.push_back({"roll", "rad/s", GetAllSensorReadings()[0]});
    readings.push_back({"pitch", "rad/s", GetAllSensorReadings()[1]});
    readings.push_back({"yaw", "rad/s", GetAllSensorReadings()[2]});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_GyroscopeSensor;
