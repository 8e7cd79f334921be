// Follows the spot of a laser on the ground. If the spot is out of view, it waits.
#pragma once

#include "footbot/bt_footbot_go_to_blob.h"

class CBTFootbotFollowLaser : public CCI_Behavior<CCI_FootBotState>
{
public:
  // `colour` is that of the spot (0xRRGGBB); `speed` is in m/s.
  explicit CBTFootbotFollowLaser(std::uint32_t colour = 0xff0000, double speed = 0.1)
      : CCI_Behavior("follow laser"), go_to_spot_(colour, speed, 0.05)
  {
  }

  void Step(CCI_FootBotState& cRobotState) override
  {
    cRobotState.SetFootBotWheelsAngularVelocity(0, 0);
    go_to_spot_.Step(cRobotState);
  }
  bool HasSpot() const { return go_to_spot_.HasBlob(); }
  bool HasArrived() const { return go_to_spot_.HasArrived(); }

private:
  CBTFootbotGoToBlob go_to_spot_;
};
