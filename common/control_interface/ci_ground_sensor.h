// CCI_GroundSensor: the sensors under any robot whose kind has them, which see the floor.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_GroundSensor : public CCI_SensorOf<CCI_GroundSensor>
{
public:
  // Returns the brightness of the floor under each sensor, 0 (black, or a hole) to 1 (white), valid until the next
  // control step.
  virtual std::span<const double> GetAllSensorReadings() const = 0;
  // Returns the colour of the floor (0xRRGGBB) under the centre of the robot, without noise.
  virtual std::uint32_t GetFloorColour() const = 0;

  static void Declare(Declaration& columns)
  {
    columns.Add({"#", "", 0, 1}, &CCI_GroundSensor::GetAllSensorReadings)
        .Add({"floor", "colour", 0, 0xffffff}, &CCI_GroundSensor::GetFloorColour);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_GroundSensor;
