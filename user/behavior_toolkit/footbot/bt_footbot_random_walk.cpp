#include "footbot/bt_footbot_random_walk.h"

#include <istream>
#include <ostream>

#include "bt_numbers.h"
#include "footbot/bt_footbot_drive.h"

using namespace swarmanoid;

CBTFootbotRandomWalk::CBTFootbotRandomWalk(double speed, double mean_straight, double largest_turn)
    : CCI_Behavior("random walk"), speed_(speed), mean_straight_(mean_straight), largest_turn_(largest_turn)
{
}

void CBTFootbotRandomWalk::Step(CCI_FootBotState& cRobotState)
{
  const double tick = cRobotState.GetTickSeconds();
  if (turn_left_ == 0 && straight_left_ <= 0)
  {
    turn_left_ = cRobotState.GetRandom().Uniform(-largest_turn_, largest_turn_);
    straight_left_ = cRobotState.GetRandom().Uniform(0, 2 * mean_straight_);
  }
  if (turn_left_ != 0)
  {
    turn_left_ -= BTFootbotTurn(cRobotState, turn_left_, speed_);
    if (turn_left_ < 1e-3 && turn_left_ > -1e-3) turn_left_ = 0;
    return;
  }
  cRobotState.SetFootBotWheelsLinearVelocity(speed_, speed_);
  straight_left_ -= tick;
}

void CBTFootbotRandomWalk::SaveState(std::ostream& state) const
{
  BTSaveNumber(state, straight_left_);
  BTSaveNumber(state, turn_left_);
}

void CBTFootbotRandomWalk::LoadState(std::istream& state)
{
  straight_left_ = BTLoadNumber(state);
  turn_left_ = BTLoadNumber(state);
}
