// The head of a foot-bot's distance scanner, which is off at the start.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/core/utility/math/angles.h>

namespace argos
{

class CCI_FootBotDistanceScannerActuator : public CCI_Actuator
{
public:
  // Turns the head to the angle, where it stays, and switches it on.
  virtual void SetAngle(const CRadians& angle) = 0;
  // Sets the speed in turns a minute, counter-clockwise, and switches the head on.
  virtual void SetRPM(Real turns_a_minute) = 0;
  // Does the same as SetAngle with the last angle, 0 at the start. A turning head stops.
  virtual void Enable() = 0;
  // Switches the head off: it stops, and nothing is measured.
  virtual void Disable() = 0;
};

}  // namespace argos
