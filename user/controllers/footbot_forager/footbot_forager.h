// A footbot that forages. It goes to the nearest yellow prey that it sees, grips it, and carries it to the green nest.
// It wanders while it sees no prey. Its LEDs are blue while it carries. After half a minute without success it gives up
// for some seconds, so that robots do not block each other for ever.
#pragma once

#include "behavior/ci_behavior.h"
#include "behavior/ci_footbot_state.h"
#include "footbot/bt_footbot_grip.h"
#include "footbot/bt_footbot_obstacle_avoidance.h"
#include "footbot/bt_footbot_random_walk_with_obstacle_avoidance.h"

class CBTFootbotForager : public CCI_Behavior<CCI_FootBotState>
{
public:
  CBTFootbotForager();
  void Step(CCI_FootBotState& cRobotState) override;
  void SaveState(std::ostream& state) const override;
  void LoadState(std::istream& state) override;

private:
  void Carry(CCI_FootBotState& cRobotState);
  void Fetch(CCI_FootBotState& cRobotState, const CCI_ColourBlob& prey);

  CBTFootbotRandomWalkWithObstacleAvoidance wander_;
  CBTFootbotObstacleAvoidance avoid_;
  CBTFootbotGrip grip_;
  double busy_s_ = 0;  // time with the current prey
  double rest_s_ = 0;  // remaining time of giving up
  bool carried_ = false;
};
