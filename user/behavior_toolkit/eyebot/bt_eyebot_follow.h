// Follows a robot that shows a colour, at a horizontal distance. If the robot is out of view, it hovers.
#pragma once

#include "eyebot/bt_eyebot_go_to.h"

class CBTEyebotFollow : public CCI_Behavior<CCI_EyeBotState>
{
public:
  // `colour` is that of the robot's LEDs (0xRRGGBB), `distance` that to the robot (m), and `speed` is in m/s.
  explicit CBTEyebotFollow(std::uint32_t colour, double distance = 0.3, double speed = 0.2)
      : CCI_Behavior("follow"), go_to_(colour, speed, distance)
  {
  }

  void Step(CCI_EyeBotState& cRobotState) override
  {
    cRobotState.SetVelocity(0, 0, 0, 0);
    go_to_.Step(cRobotState);
  }
  bool HasTarget() const { return go_to_.HasTarget(); }

private:
  CBTEyebotGoTo go_to_;
};
