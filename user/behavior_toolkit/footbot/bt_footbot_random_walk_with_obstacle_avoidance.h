// Random walk with obstacle avoidance: the two behaviours in sequence, so that avoidance has priority.
#pragma once

#include <memory>

#include "footbot/bt_footbot_obstacle_avoidance.h"
#include "footbot/bt_footbot_random_walk.h"

class CBTFootbotRandomWalkWithObstacleAvoidance : public CCI_Behavior<CCI_FootBotState>
{
public:
  explicit CBTFootbotRandomWalkWithObstacleAvoidance(double speed = 0.1)
      : CCI_Behavior("random walk with obstacle avoidance"),
        m_pcRW(std::make_unique<CBTFootbotRandomWalk>(speed)),
        m_pcOa(std::make_unique<CBTFootbotObstacleAvoidance>(CBTFootbotObstacleAvoidance::VERSION_VECTOR_BASED, speed))
  {
  }

  void Step(CCI_FootBotState& cRobotState) override
  {
    m_pcRW->Step(cRobotState);
    m_pcOa->Step(cRobotState);
  }
  void SaveState(std::ostream& state) const override { m_pcRW->SaveState(state); }
  void LoadState(std::istream& state) override { m_pcRW->LoadState(state); }

private:
  std::unique_ptr<CBTFootbotRandomWalk> m_pcRW;
  std::unique_ptr<CBTFootbotObstacleAvoidance> m_pcOa;
};
