// Converts distances to the surface of a footbot's body into readings of its infrared sensors, as in the simulator, and
// back.
#pragma once

#include <limits>

namespace swarmanoid::ros2
{

// The response is fitted to the robot (ARGoS3, foot-bot): 1 below a contact distance, else a / (d + b).
inline constexpr double kInfraredScale = 0.0100527;
inline constexpr double kInfraredOffset_m = 0.000163144;
inline constexpr double kInfraredContact_m = 0.009889556;

inline double InfraredReading(double distance_m, double range_m)
{
  if (distance_m > range_m) return 0;
  return distance_m < kInfraredContact_m ? 1 : kInfraredScale / (distance_m + kInfraredOffset_m);
}

// Returns metres. By REP 117, -infinity means contact and +infinity means nothing in range.
inline double InfraredDistance(double reading)
{
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (reading <= 0) return kInfinity;
  return reading >= 1 ? -kInfinity : kInfraredScale / reading - kInfraredOffset_m;
}

}  // namespace swarmanoid::ros2
