// A footbot that forages. It goes to the nearest yellow prey that it sees, grips it, and carries it to the green nest.
// It wanders while it sees no prey. Its LEDs are blue while it carries. After half a minute without success it gives up
// for some seconds, so that robots do not block each other for ever.
//
// With the parameter "search" it returns to the nest after so long without a prey, and with "rest" it rests in the nest
// after each delivery and each search in vain, as the robots of Liu and Winfield (2010) do. With "recharge" it goes to
// the nest when its charge is below that, and stays there until the battery is nearly full.
#pragma once

#include "behavior/ci_behavior.h"
#include "behavior/ci_footbot_state.h"
#include "ci_battery_sensor.h"
#include "footbot/bt_footbot_grip.h"
#include "footbot/bt_footbot_obstacle_avoidance.h"
#include "footbot/bt_footbot_random_walk_with_obstacle_avoidance.h"

class CBTFootbotForager : public CCI_Behavior<CCI_FootBotState>
{
public:
  // Times in s; a search of 0 never ends. The battery may be null.
  CBTFootbotForager(double search_s, double rest_s, double recharge, const CCI_BatterySensor* battery);
  void Step(CCI_FootBotState& cRobotState) override;
  void SaveState(std::ostream& state) const override;
  void LoadState(std::istream& state) override;

private:
  void Carry(CCI_FootBotState& cRobotState);
  bool MustReturn(bool carries, bool sees_prey, double tick_s);
  // Drives to the nest and rests there.
  void Return(CCI_FootBotState& cRobotState);
  void Fetch(CCI_FootBotState& cRobotState, const CCI_ColourBlob& prey);

  CBTFootbotRandomWalkWithObstacleAvoidance wander_;
  CBTFootbotObstacleAvoidance avoid_;
  CBTFootbotGrip grip_;
  double busy_s_ = 0;  // time with the current prey
  double rest_s_ = 0;  // remaining time of giving up
  bool carried_ = false;
  // Only with search, rest or recharge:
  double most_search_s_, nest_rest_s_, recharge_;
  const CCI_BatterySensor* battery_;
  double search_s_ = 0;    // time without a prey
  double in_nest_s_ = -1;  // remaining rest in the nest, or negative while it works
  bool returns_ = false;
};
