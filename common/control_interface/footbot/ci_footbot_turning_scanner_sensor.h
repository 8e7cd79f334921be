// The distance scanner of a footbot whose controller turns the head: two short beams and two long ones.
#pragma once

#include "common/control_interface/ci_distance_scanner_sensor.h"

namespace swarmanoid
{

// Without a command the scanner is off and has no readings. Commands take effect in the next tick. The beams are in the
// order ahead, back (short), left, right (long). Each beam has one reading while the head stands still, and six along
// its way while the head turns.
class CCI_FootBotTurningScannerSensor : public CCI_DistanceScannerSensor
{
public:
  // Turns the head continuously, rad/s counter-clockwise. Throws std::invalid_argument for a number that is not finite.
  virtual void Turn(double speed_rad_s) = 0;
  // Turns the head to an angle at once, rad counter-clockwise from the front. It stays there. Throws
  // std::invalid_argument for a number that is not finite.
  virtual void Look(double angle_rad) = 0;
  // Stops the scanner, which then has no readings.
  virtual void SwitchOff() = 0;
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotTurningScannerSensor;
