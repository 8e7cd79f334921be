// Hovers at its place. It keeps an altitude if one is given and the robot has an altitude sensor.
#pragma once

#include "behavior/ci_behavior.h"
#include "behavior/ci_eyebot_state.h"

class CBTEyebotHover : public CCI_Behavior<CCI_EyeBotState>
{
public:
  CBTEyebotHover() : CCI_Behavior("hover") {}
  // `altitude` is in m above the ground.
  explicit CBTEyebotHover(double altitude) : CCI_Behavior("hover"), altitude_(altitude), keeps_altitude_(true) {}

  void Step(CCI_EyeBotState& cRobotState) override
  {
    cRobotState.SetVelocity(0, 0, keeps_altitude_ ? altitude_ - cRobotState.GetAltitude() : 0, 0);
  }

private:
  double altitude_ = 0;
  bool keeps_altitude_ = false;
};
