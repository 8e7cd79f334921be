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

  std::vector<CCI_Column> Columns() const override
  {
    return NumberedColumns(GetAllSensorReadings().size(), "", {.name = {}, .minimum = 0, .maximum = 1});
  }
  void ReadColumns(std::vector<double>& values) const override
  {
    const auto all = GetAllSensorReadings();
    values.insert(values.end(), all.begin(), all.end());
  }
  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    CCI_Sensor::Describe(readings);
    readings.push_back({"floor", "colour", static_cast<double>(GetFloorColour())});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_GroundSensor;
