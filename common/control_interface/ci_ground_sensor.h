// The sensors under any robot whose kind has them: they see the floor.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_GroundSensor : public CCI_Sensor
{
public:
  // Brightness of the floor under each sensor, 0 (black, or a hole) to 1 (white).
  virtual std::span<const double> GetAllSensorReadings() const = 0;
  // The colour of the floor (0xRRGGBB) under the centre of the robot; without noise.
  virtual std::uint32_t GetFloorColour() const = 0;

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    const std::span<const double> all = GetAllSensorReadings();
    for (std::size_t i = 0; i < all.size(); ++i) readings.push_back({std::to_string(i), "", all[i]});
    readings.push_back({"floor", "colour", static_cast<double>(GetFloorColour())});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_GroundSensor;
