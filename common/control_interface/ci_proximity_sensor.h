// The infrared proximity sensors of any robot whose kind has them.
#pragma once

#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_ProximitySensor : public CCI_Sensor
{
public:
  // All readings, 0 (nothing in range) to 1 (touching), valid until the next control step.
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

using swarmanoid::CCI_ProximitySensor;
