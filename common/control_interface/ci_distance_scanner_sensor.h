// CCI_DistanceScannerSensor: beams that measure distances around a robot. They are fixed, or on a head that turns.
#pragma once

#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_DistanceScannerSensor : public CCI_SensorOf<CCI_DistanceScannerSensor>
{
public:
  enum class Echo
  {
    kMeasured,
    kTooNear,  // a body is nearer than the beam can measure
    kNothing   // no body is within the range of the beam
  };
  struct Reading
  {
    double angle_rad = 0;  // direction of the beam, counter-clockwise from the front, -pi..pi
    // The distance is measured from the surface of the robot. It is 0 if a body is too near, and the range of the beam
    // if no body is in it.
    double distance_m = 0;
    Echo echo = Echo::kNothing;
  };

  // Returns all readings of the last tick, beam after beam, valid until the next control step.
  virtual std::span<const Reading> GetAllReadings() const = 0;

  static void Declare(Declaration& columns)
  {
    columns.AddRows(
        "reading", &CCI_DistanceScannerSensor::GetAllReadings, CCI_Field({"angle", "rad"}, &Reading::angle_rad),
        CCI_Field({"distance", "m", 0}, &Reading::distance_m), CCI_Field({"echo", "", 0, 2}, &Reading::echo));
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_DistanceScannerSensor;
