#include "footbot/bt_footbot_grip.h"

#include <cmath>

#include "common/math/elementary.h"
#include "footbot/bt_footbot_drive.h"

using namespace swarmanoid;

namespace
{

// The object must be this close to straight ahead before the gripper closes.
const double kAhead = DegreesToRadians(8);

}  // namespace

CBTFootbotGrip::CBTFootbotGrip(std::uint32_t colour, double reach, double speed)
    : CCI_Behavior("grip"), colour_(colour), reach_(reach), speed_(speed)
{
}

void CBTFootbotGrip::Step(CCI_FootBotState& cRobotState)
{
  has_object_ = cRobotState.IsGripping();
  if (has_object_)
  {
    cRobotState.SetFootBotWheelsAngularVelocity(0, 0);
    cRobotState.SetGripper(1);
    return;
  }
  const CCI_ColourBlob* object = cRobotState.GetNearestColourBlob(colour_);
  if (object == nullptr)
  {
    cRobotState.SetGripper(0);
    return;
  }
  const bool ahead = std::abs(object->angle_rad) < kAhead;
  cRobotState.SetGripper(ahead && object->distance_m < reach_ ? 1 : 0);
  if (ahead)
    cRobotState.SetFootBotWheelsLinearVelocity(speed_, speed_);
  else
    BTFootbotTurn(cRobotState, object->angle_rad, speed_);
}
