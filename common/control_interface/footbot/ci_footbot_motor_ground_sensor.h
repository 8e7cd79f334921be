// The four sensors between the tracks of a footbot that see the greys of the floor.
#pragma once

#include <array>
#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotMotorGroundSensor : public CCI_SensorOf<CCI_FootBotMotorGroundSensor>
{
public:
  static constexpr unsigned NUM_SENSORS = 4;
  struct Place
  {
    double x, y;
  };
  // The positions of the sensors ahead of and to the left of the middle of the robot, m, from footbot_entity.cpp of
  // ARGoS3.
  static constexpr std::array<Place, NUM_SENSORS> PLACES_M{{
      {0.063, 0.0116},
      {-0.063, 0.0116},
      {-0.063, -0.0116},
      {0.063, -0.0116},
  }};

  // Returns the brightness of the floor under each sensor, 0 (black, or a hole) to 1 (white).
  virtual std::span<const double, NUM_SENSORS> GetAllSensorReadings() const = 0;

  static void Declare(Declaration& columns)
  {
    columns.Add({"#", "", 0, 1}, &CCI_FootBotMotorGroundSensor::GetAllSensorReadings);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotMotorGroundSensor;
