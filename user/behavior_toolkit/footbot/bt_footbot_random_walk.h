// Random walk: drives straight on for a random time, then turns by a random angle.
#pragma once

#include "behavior/ci_behavior.h"
#include "behavior/ci_footbot_state.h"

class CBTFootbotRandomWalk : public CCI_Behavior<CCI_FootBotState>
{
public:
  // `speed` is in m/s on the ground, `mean_straight` the mean time (s) between two turns, and `largest_turn` the
  // largest turn to either side (rad).
  explicit CBTFootbotRandomWalk(double speed = 0.1, double mean_straight = 3.0, double largest_turn = 2.0);

  void Step(CCI_FootBotState& cRobotState) override;
  void SaveState(std::ostream& state) const override;
  void LoadState(std::istream& state) override;

private:
  double speed_;
  double mean_straight_;
  double largest_turn_;
  double straight_left_ = 0;  // s
  double turn_left_ = 0;      // radians, signed
};
