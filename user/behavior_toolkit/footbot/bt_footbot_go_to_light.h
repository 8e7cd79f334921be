// Goes to light, or away from it. It decides only while a light sensor reads light.
#pragma once

#include "behavior/ci_behavior.h"
#include "behavior/ci_footbot_state.h"

class CBTFootbotGoToLight : public CCI_Behavior<CCI_FootBotState>
{
public:
  // `speed` is in m/s. If `away` is true, the robot flees the light. `arrived_at` is the strongest reading (0..1) at
  // which it stops.
  explicit CBTFootbotGoToLight(double speed = 0.1, bool away = false, double arrived_at = 0.95);
  void Step(CCI_FootBotState& cRobotState) override;

private:
  double speed_;
  bool away_;
  double arrived_at_;
};
