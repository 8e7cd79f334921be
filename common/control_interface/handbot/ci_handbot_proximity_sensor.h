// The infrared proximity sensors of the handbot's two hands.
#pragma once

#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_HandBotProximitySensor : public CCI_Sensor
{
public:
  static constexpr unsigned SENSORS_OF_HAND = 12;
  static constexpr unsigned NUM_SENSORS = 2 * SENSORS_OF_HAND;

  // All readings, 0 (nothing in range) to 1 (touching), valid until the next control step: the left hand's, then the
  // right hand's. Of each, while its wrist is at 0: 0 to 2 on the left claw, the outermost first; 3 to 5 above the
  // claws and 6 to 8 below, from left to right; 9 to 11 on the right claw, the outermost last.
  virtual std::span<const double, NUM_SENSORS> GetAllSensorReadings() const = 0;

  std::vector<CCI_Column> Columns() const override
  {
    const CCI_Column like{.name = {}, .minimum = 0, .maximum = 1};
    std::vector<CCI_Column> columns = NumberedColumns(SENSORS_OF_HAND, "left ", like);
    for (CCI_Column& column : NumberedColumns(SENSORS_OF_HAND, "right ", like)) columns.push_back(std::move(column));
    return columns;
  }
  void ReadColumns(std::vector<double>& values) const override
  {
    const auto all = GetAllSensorReadings();
    values.insert(values.end(), all.begin(), all.end());
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_HandBotProximitySensor;
