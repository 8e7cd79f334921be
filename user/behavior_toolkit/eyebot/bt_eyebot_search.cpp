#include "eyebot/bt_eyebot_search.h"

#include <algorithm>

#include "bt_numbers.h"
#include "common/math/elementary.h"

using namespace swarmanoid;

namespace
{

constexpr double kYawRate = 0.8;  // rad/s

}  // namespace

void CBTEyebotSearch::Step(CCI_EyeBotState& cRobotState)
{
  const double tick = cRobotState.GetTickSeconds();
  if (straight_left_ <= 0 && turn_left_ == 0)
  {
    straight_left_ = cRobotState.GetRandom().Uniform(0, 2 * mean_straight_);
    turn_left_ = cRobotState.GetRandom().Uniform(-kPi, kPi);
  }
  // Turning while flying makes wide bends instead of stops.
  const double turned = std::clamp(turn_left_, -kYawRate * tick, kYawRate * tick);
  turn_left_ -= turned;
  if (turn_left_ < 1e-6 && turn_left_ > -1e-6) turn_left_ = 0;
  if (turn_left_ == 0) straight_left_ -= tick;
  cRobotState.SetVelocity(turned != 0 ? speed_ / 2 : speed_, 0, 0, turned / tick);
}

void CBTEyebotSearch::SaveState(std::ostream& state) const
{
  BTSaveNumber(state, straight_left_);
  BTSaveNumber(state, turn_left_);
}

void CBTEyebotSearch::LoadState(std::istream& state)
{
  straight_left_ = BTLoadNumber(state);
  turn_left_ = BTLoadNumber(state);
}
