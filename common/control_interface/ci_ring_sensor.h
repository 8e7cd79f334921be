// Sensors in a ring around the body of any robot, of which each has one reading. The base of those of proximity and of
// light.
#pragma once

#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_RingSensor : public CCI_SensorOf<CCI_RingSensor>
{
public:
  // All readings, 0 to 1, valid until the next control step.
  virtual std::span<const double> GetAllSensorReadings() const = 0;
  // Where a sensor looks: radians, counter-clockwise from the front. Throws std::out_of_range for a sensor that is not
  // there.
  virtual double GetAngle(unsigned sensor) const = 0;

  static void Declare(Declaration& columns) { columns.Add({"#", "", 0, 1}, &CCI_RingSensor::GetAllSensorReadings); }
};

}  // namespace swarmanoid

using swarmanoid::CCI_RingSensor;
