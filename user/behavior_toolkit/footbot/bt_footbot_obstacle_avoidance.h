// Obstacle avoidance. It decides only while an obstacle is near, so that it can be combined with any other behaviour.
#pragma once

#include "behavior/ci_behavior.h"
#include "behavior/ci_footbot_state.h"

class CBTFootbotObstacleAvoidance : public CCI_Behavior<CCI_FootBotState>
{
public:
  enum EVersion
  {
    VERSION_VECTOR_BASED,  // steers away from the sum of the readings, taken as vectors
    VERSION_BRAITENBERG    // each sensor slows the wheel on the other side (Braitenberg, "Vehicles", 1984)
  };

  // `speed` is in m/s; `threshold` is the largest reading that is ignored, 0..1.
  explicit CBTFootbotObstacleAvoidance(EVersion version = VERSION_VECTOR_BASED, double speed = 0.1,
                                       double threshold = 0.02);

  void Step(CCI_FootBotState& cRobotState) override;
  // Returns true if the last step set the wheels.
  bool IsAvoiding() const { return avoiding_; }

private:
  void AvoidByVector(CCI_FootBotState& cRobotState);
  void AvoidByWeights(CCI_FootBotState& cRobotState);

  EVersion version_;
  double speed_;
  double threshold_;
  bool avoiding_ = false;
};
