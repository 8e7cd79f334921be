// CCI_RingSensor: sensors in a ring around the body of any robot, with one reading each. The base of proximity and
// light sensors.
#pragma once

#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_RingSensor : public CCI_SensorOf<CCI_RingSensor>
{
public:
  // Returns all readings, 0 to 1, valid until the next control step.
  virtual std::span<const double> GetAllSensorReadings() const = 0;
  // Returns the direction of a sensor: radians, counter-clockwise from the front. Throws std::out_of_range if the
  // sensor does not exist.
  virtual double GetAngle(unsigned sensor) const = 0;

  static void Declare(Declaration& columns) { columns.Add({"#", "", 0, 1}, &CCI_RingSensor::GetAllSensorReadings); }
};

}  // namespace swarmanoid

using swarmanoid::CCI_RingSensor;
