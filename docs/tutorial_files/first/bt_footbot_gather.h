// CBTFootbotGather: wanders until it stands on green ground, rests there with blue LEDs, and goes to the blue LEDs of
// others.
#pragma once

#include <string>

#include "behavior/fsm.h"
#include "footbot/bt_footbot_go_to_blob.h"
#include "footbot/bt_footbot_obstacle_avoidance.h"
#include "footbot/bt_footbot_random_walk.h"

class CBTFootbotGather : public CCI_Behavior<CCI_FootBotState>, public FSM<std::string>
{
public:
  static constexpr unsigned int WANDER = 0;
  static constexpr unsigned int JOIN = 1;
  static constexpr unsigned int REST = 2;

  CBTFootbotGather();
  void Step(CCI_FootBotState& cRobotState) override;

private:
  CBTFootbotRandomWalk random_walk_;
  CBTFootbotGoToBlob go_to_light_;
  CBTFootbotObstacleAvoidance obstacle_avoidance_;
};
