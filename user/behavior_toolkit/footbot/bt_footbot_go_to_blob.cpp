#include "footbot/bt_footbot_go_to_blob.h"

#include "footbot/bt_footbot_drive.h"

CBTFootbotGoToBlob::CBTFootbotGoToBlob(std::uint32_t colour, double speed, double stop_at)
    : CCI_Behavior("go to blob"), colour_(colour), speed_(speed), stop_at_(stop_at)
{
}

void CBTFootbotGoToBlob::Step(CCI_FootBotState& cRobotState)
{
  const CCI_ColourBlob* blob = cRobotState.GetNearestColourBlob(colour_);
  has_blob_ = blob != nullptr;
  has_arrived_ = has_blob_ && blob->distance_m <= stop_at_;
  if (!has_blob_) return;
  if (has_arrived_)
    cRobotState.SetFootBotWheelsAngularVelocity(0, 0);
  else
    BTFootbotSteer(cRobotState, blob->angle_rad, speed_);
}
