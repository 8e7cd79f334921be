// Goes to light, or away from it. It decides only while a light sensor reads light.
#pragma once

#include "behavior/ci_behavior.h"
#include "behavior/ci_footbot_state.h"

class CBTFootbotGoToLight : public CCI_Behavior<CCI_FootBotState>
{
public:
  // `speed`: m/s; `away`: true to flee the light; `arrived_at`: the strongest reading (0..1) at which the robot stops.
  explicit CBTFootbotGoToLight(double speed = 0.1, bool away = false, double arrived_at = 0.95);
  void Step(CCI_FootBotState& cRobotState) override;

private:
  double speed_;
  bool away_;
  double arrived_at_;
};
