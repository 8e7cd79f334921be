#include "eyebot/bt_eyebot_go_to.h"

#include <algorithm>

#include "common/math/elementary.h"

using namespace swarmanoid;

void CBTEyebotGoTo::Step(CCI_EyeBotState& cRobotState)
{
  const CCI_ColourBlob* target = cRobotState.GetNearestColourBlob(colour_);
  has_target_ = target != nullptr;
  has_arrived_ = has_target_ && target->distance_m <= near_;
  if (!has_target_) return;
  // The speed decreases near the target, so that the robot does not fly past it.
  const double speed = has_arrived_ ? 0 : std::min(speed_, target->distance_m);
  const SinCos direction = SinCosOf(target->angle_rad);
  cRobotState.SetVelocity(speed * direction.cos, speed * direction.sin, 0, 0);
}
