// Searches by flying straight on and taking a new heading at random times. At an obstacle such as a wall, a later
// heading leads away from it.
#pragma once

#include "behavior/ci_behavior.h"
#include "behavior/ci_eyebot_state.h"

class CBTEyebotSearch : public CCI_Behavior<CCI_EyeBotState>
{
public:
  // `speed` is in m/s; `mean_straight` is the mean time (s) between two turns.
  explicit CBTEyebotSearch(double speed = 0.2, double mean_straight = 6.0)
      : CCI_Behavior("search"), speed_(speed), mean_straight_(mean_straight)
  {
  }

  void Step(CCI_EyeBotState& cRobotState) override;
  void SaveState(std::ostream& state) const override;
  void LoadState(std::istream& state) override;

private:
  double speed_;
  double mean_straight_;
  double straight_left_ = 0;  // s
  double turn_left_ = 0;      // radians, signed
};
