// A ring of light sensors around the body, each of which tells how bright the lights are that it sees. Type label
// "light". Any robot can carry it.
#pragma once

#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_LightSensor : public CCI_Sensor
{
public:
  // All readings, 0 (dark) to 1, valid until the next control step.
  virtual std::span<const double> GetAllSensorReadings() const = 0;
  // Where a sensor is: radians, counter-clockwise from the front. Throws std::out_of_range for a sensor that is not
  // there.
  virtual double GetAngle(unsigned sensor) const = 0;

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    const std::span<const double> all = GetAllSensorReadings();
    for (std::size_t i = 0; i < all.size(); ++i) readings.push_back({std::to_string(i), "", all[i]});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_LightSensor;
