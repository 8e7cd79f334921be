// The 24 infrared proximity sensors around the body of a footbot.
#pragma once

#include <array>
#include <span>
#include <stdexcept>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotProximitySensor : public CCI_SensorOf<CCI_FootBotProximitySensor>
{
public:
  static constexpr unsigned NUM_SENSORS = 24;
  // The angle (radians, counter-clockwise from the front) of sensor i is FIRST_ANGLE + i * SPACING (ARGoS3, foot-bot).
  static constexpr double FIRST_ANGLE = 0.1308996938995747;  // 7.5 degrees
  static constexpr double SPACING = 0.2617993877991494;      // 15 degrees
  static constexpr double RANGE_M = 0.1;                     // unless the experiment file says otherwise

  // Returns all readings, 0 (nothing in range) to 1 (touching), valid until the next control step.
  virtual std::span<const double, NUM_SENSORS> GetAllSensorReadings() const = 0;

  // Copies them to `readings`, which holds NUM_SENSORS numbers.
  void GetAllProximitySensorReadings(double* readings) const
  {
    for (const double reading : GetAllSensorReadings()) *readings++ = reading;
  }
  // Throws std::out_of_range from NUM_SENSORS on.
  double GetProximitySensorReading(unsigned sensor) const
  {
    if (sensor >= NUM_SENSORS) throw std::out_of_range("proximity sensor " + std::to_string(sensor) + " of 24");
    return GetAllSensorReadings()[sensor];
  }
  static double AngleOf(unsigned sensor) { return FIRST_ANGLE + sensor * SPACING; }

  static void Declare(Declaration& columns)
  {
    columns.Add({"#", "", 0, 1}, &CCI_FootBotProximitySensor::GetAllSensorReadings);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotProximitySensor;
