// The sensors under a footbot that see the floor: the nest is a coloured patch of it.
#pragma once

#include <cstdint>
#include <span>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotGroundSensor : public CCI_Sensor
{
public:
  static constexpr unsigned NUM_SENSORS = 8;

  // Brightness of the floor under each sensor, 0 (black, or a hole) to 1 (white). The sensors stand about 0.08 m from
  // the middle, counter-clockwise from the front: CCI_FootBotBaseGroundSensor::PLACES_M.
  virtual std::span<const double, NUM_SENSORS> GetAllSensorReadings() const = 0;
  // The colour of the floor (0xRRGGBB) under the centre of the robot; without noise.
  virtual std::uint32_t GetFloorColour() const = 0;

  std::vector<CCI_Column> Columns() const override
  {
    return NumberedColumns(NUM_SENSORS, "", {.name = {}, .minimum = 0, .maximum = 1});
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

using swarmanoid::CCI_FootBotGroundSensor;
