#include "handbot/bt_handbot_climb.h"

#include <algorithm>
#include <cmath>

namespace
{

constexpr double kClose = 0.005;  // metres

}  // namespace

void CBTHandbotClimb::Step(CCI_HandBotState& cRobotState)
{
  has_arrived_ = false;
  if (cRobotState.GetJoint(CCI_HandBotJointsSensor::ROPE_ATTACHED) == 0)
  {
    cRobotState.LaunchRope();
    cRobotState.SetWinchVelocity(0);
    return;
  }
  const double rest = rope_length_ - cRobotState.GetJoint(CCI_HandBotJointsSensor::ROPE_LENGTH);
  has_arrived_ = std::abs(rest) <= kClose;
  // The last tick ends at the wanted length, not beyond it.
  const double velocity = rest / cRobotState.GetTickSeconds();
  cRobotState.SetWinchVelocity(has_arrived_ ? 0 : std::clamp(velocity, -speed_, speed_));
}
