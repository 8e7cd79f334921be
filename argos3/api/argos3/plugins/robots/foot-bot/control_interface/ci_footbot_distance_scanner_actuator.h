// The head of a foot-bot's distance scanner: off at the start.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/core/utility/math/angles.h>

namespace argos
{

class CCI_FootBotDistanceScannerActuator : public CCI_Actuator
{
public:
  // The head goes there and stays; switches it on.
  virtual void SetAngle(const CRadians& angle) = 0;
  // Turns a minute, counter-clockwise; switches it on.
  virtual void SetRPM(Real turns_a_minute) = 0;
  // As SetAngle, with the angle that was set last, 0 at the start: what turned stands still.
  virtual void Enable() = 0;
  virtual void Disable() = 0;
};

}  // namespace argos
