// The sensors under a footbot that see the floor: the nest is a coloured patch of it.
#pragma once

#include <cstdint>
#include <span>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotGroundSensor : public CCI_SensorOf<CCI_FootBotGroundSensor>
{
public:
  static constexpr unsigned NUM_SENSORS = 8;

  // Returns the brightness of the floor under each sensor, 0 (black, or a hole) to 1 (white). The sensors are about
  // 0.08 m from the middle, counter-clockwise from the front: CCI_FootBotBaseGroundSensor::PLACES_M.
  virtual std::span<const double, NUM_SENSORS> GetAllSensorReadings() const = 0;
  // Returns the colour of the floor (0xRRGGBB) under the centre of the robot, without noise.
  virtual std::uint32_t GetFloorColour() const = 0;

  static void Declare(Declaration& columns)
  {
    columns.Add({"#", "", 0, 1}, &CCI_FootBotGroundSensor::GetAllSensorReadings)
        .Add({"floor", "colour", 0, 0xffffff}, &CCI_FootBotGroundSensor::GetFloorColour);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotGroundSensor;
