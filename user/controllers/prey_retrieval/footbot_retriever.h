// The footbot of the prey retrieval experiment (behaviour diagram: figure 4.5). It wanders until it sees the laser,
// goes to it, grips the prey there, and follows the laser to the nest with blue LEDs. It avoids another footbot that
// carries a prey.
#pragma once

#include <string>

#include "behavior/ci_behavior.h"
#include "behavior/ci_footbot_state.h"
#include "behavior/fsm.h"
#include "footbot/bt_footbot_follow_laser.h"
#include "footbot/bt_footbot_grip.h"
#include "footbot/bt_footbot_obstacle_avoidance.h"
#include "footbot/bt_footbot_random_walk_with_obstacle_avoidance.h"

class CBTFootbotRetriever : public CCI_Behavior<CCI_FootBotState>, public FSM<std::string>
{
public:
  static constexpr unsigned int SEARCH_FOR_LASER = 0;
  static constexpr unsigned int GO_TO_LASER = 1;
  static constexpr unsigned int GRIP_PREY = 2;
  static constexpr unsigned int GO_TO_NEST = 3;
  static constexpr unsigned int AVOID_GRIPPING_FOOTBOT = 4;

  CBTFootbotRetriever();

  void Step(CCI_FootBotState& cRobotState) override;
  std::string StatusText() const override { return GetStateName(); }
  void SaveState(std::ostream& state) const override;
  void LoadState(std::istream& state) override;

private:
  void SearchForLaser(CCI_FootBotState& cRobotState);
  void GoToLaser(CCI_FootBotState& cRobotState);
  void GripPrey(CCI_FootBotState& cRobotState);
  void GoToNest(CCI_FootBotState& cRobotState);
  void AvoidGrippingFootbot(CCI_FootBotState& cRobotState);
  // Returns the input of the state machine for what the robot sees.
  std::string Transition(CCI_FootBotState& cRobotState) const;

  CBTFootbotRandomWalkWithObstacleAvoidance wander_;
  CBTFootbotObstacleAvoidance avoid_;
  CBTFootbotGrip grip_;
  CBTFootbotFollowLaser follow_laser_;
  double in_state_s_ = 0;        // since the last transition
  double held_back_s_ = 0;       // time in which it failed to turn to the laser with its prey
  double backing_s_ = 0;         // remaining time of driving back
  double since_signal_s_ = 1e9;  // since another robot with blue LEDs was seen
};
