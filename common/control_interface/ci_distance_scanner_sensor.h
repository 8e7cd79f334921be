// Beams that measure distances around a robot, fixed or on a head that turns.
#pragma once

#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_DistanceScannerSensor : public CCI_Sensor
{
public:
  enum class Echo
  {
    kMeasured,
    kTooNear,  // something is nearer than the beam can measure
    kNothing   // nothing within its range
  };
  struct Reading
  {
    double angle_rad = 0;   // where the beam looked, counter-clockwise from the front, -pi..pi
    double distance_m = 0;  // from the surface of the robot; 0 if too near, the range of the beam if there is nothing
    Echo echo = Echo::kNothing;
  };

  // All readings of the last tick, beam after beam, valid until the next control step.
  virtual std::span<const Reading> GetAllReadings() const = 0;

  std::vector<CCI_Column> Rows() const override { return {{"angle", "rad"}, {"distance", "m", 0}, {"echo", "", 0, 2}}; }
  void ReadRows(std::vector<double>& values) const override
  {
    for (const Reading& reading : GetAllReadings())
      values.insert(values.end(), {reading.angle_rad, reading.distance_m, static_cast<double>(reading.echo)});
  }
  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    for (std::size_t i = 0; i < GetAllReadings().size(); ++i)
    {
      readings.push_back({"angle " + std::to_string(i), "rad", GetAllReadings()[i].angle_rad});
      readings.push_back({"distance " + std::to_string(i), "m", GetAllReadings()[i].distance_m});
    }
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_DistanceScannerSensor;
