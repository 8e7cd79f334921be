// The eight sensors around the base of a footbot, which distinguish a black floor from a white one.
#pragma once

#include <array>
#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotBaseGroundSensor : public CCI_SensorOf<CCI_FootBotBaseGroundSensor>
{
public:
  static constexpr unsigned NUM_SENSORS = 8;
  struct Place
  {
    double x, y;
  };
  // The positions of the sensors ahead of and to the left of the middle of the robot, m, from footbot_entity.cpp of
  // ARGoS3.
  static constexpr std::array<Place, NUM_SENSORS> PLACES_M{{
      {0.08, 0},
      {0.042, 0.065},
      {0, 0.08},
      {-0.042, 0.065},
      {-0.08, 0},
      {-0.042, -0.065},
      {0, -0.08},
      {0.042, -0.065},
  }};

  // Returns 1 for each sensor whose floor has at least half of the brightness of white, and 0 for the others.
  virtual std::span<const double, NUM_SENSORS> GetAllSensorReadings() const = 0;

  static void Declare(Declaration& columns)
  {
    columns.Add({"#", "", 0, 1}, &CCI_FootBotBaseGroundSensor::GetAllSensorReadings);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotBaseGroundSensor;
