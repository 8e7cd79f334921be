// Sensors in a ring around the body of any robot, of which each has one reading. The base of those of proximity and of
// light.
#pragma once

#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_RingSensor : public CCI_Sensor
{
public:
  // All readings, 0 to 1, valid until the next control step.
  virtual std::span<const double> GetAllSensorReadings() const = 0;
  // Where a sensor looks: radians, counter-clockwise from the front. Throws std::out_of_range for a sensor that is not
  // there.
  virtual double GetAngle(unsigned sensor) const = 0;

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    const std::span<const double> all = GetAllSensorReadings();
    for (std::size_t i = 0; i < all.size(); ++i) readings.push_back({std::to_string(i), "", all[i]});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_RingSensor;
