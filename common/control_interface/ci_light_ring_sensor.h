// CCI_LightRingSensor: the 24 light sensors around the body of a robot, the base of the footbot's and the eyebot's
// light sensors.
#pragma once

#include <span>
#include <stdexcept>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_LightRingSensor : public CCI_SensorOf<CCI_LightRingSensor>
{
public:
  static constexpr unsigned NUM_SENSORS = 24;
  // The angle (radians, counter-clockwise from the front) of sensor i is FIRST_ANGLE + i * SPACING.
  static constexpr double FIRST_ANGLE = 0.1308996938995747;  // 7.5 degrees
  static constexpr double SPACING = 0.2617993877991494;      // 15 degrees

  // Returns all readings, 0 (dark) to 1, valid until the next control step.
  virtual std::span<const double, NUM_SENSORS> GetAllSensorReadings() const = 0;
  // Returns one reading, 0 to 1. Throws std::out_of_range from NUM_SENSORS on.
  double GetLightSensorReading(unsigned sensor) const
  {
    if (sensor >= NUM_SENSORS) throw std::out_of_range("light sensor " + std::to_string(sensor) + " of 24");
    return GetAllSensorReadings()[sensor];
  }
  static double AngleOf(unsigned sensor) { return FIRST_ANGLE + sensor * SPACING; }

  static void Declare(Declaration& columns)
  {
    columns.Add({"#", "", 0, 1}, &CCI_LightRingSensor::GetAllSensorReadings);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_LightRingSensor;
