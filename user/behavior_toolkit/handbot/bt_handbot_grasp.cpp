#include "handbot/bt_handbot_grasp.h"

#include <istream>
#include <ostream>

#include "bt_numbers.h"

namespace
{

constexpr double kStill = 1e-3;   // radians of arm motion in a tick that count as contact
constexpr double kClosed = 0.05;  // radians of aperture

using Hands = CCI_HandBotHandsActuator;
using Joints = CCI_HandBotJointsSensor;

}  // namespace

CBTHandbotGrasp::CBTHandbotGrasp(double opening, double arm_speed)
    : CCI_Behavior("grasp"), opening_(opening), arm_speed_(arm_speed)
{
  State<std::string>* open = initializeState(this, OPEN, "[OPEN]");
  State<std::string>* close_arms = initializeState(this, CLOSE_ARMS, "[CLOSE ARMS]");
  State<std::string>* close_hands = initializeState(this, CLOSE_HANDS, "[CLOSE HANDS]");
  State<std::string>* hold = initializeState(this, HOLD, "[HOLD]");
  open->addTransition("opened", close_arms);
  close_arms->addTransition("contact", close_hands);
  close_hands->addTransition("holding", hold);
  close_hands->addTransition("missed", open);
  hold->addTransition("lost", open);
  setStartState(open);
}

void CBTHandbotGrasp::Step(CCI_HandBotState& cRobotState)
{
  const double left = cRobotState.GetJoint(Joints::ARM_LEFT);
  const double right = cRobotState.GetJoint(Joints::ARM_RIGHT);
  const bool holding = cRobotState.IsHolding(Hands::LEFT) || cRobotState.IsHolding(Hands::RIGHT);
  const bool closed =
      cRobotState.GetJoint(Joints::HAND_LEFT) < kClosed && cRobotState.GetJoint(Joints::HAND_RIGHT) < kClosed;
  const double moved = last_angle_ - (left + right);
  last_angle_ = left + right;
  switch (GetStateID())
  {
    case OPEN:
      cRobotState.OpenHand(Hands::LEFT);
      cRobotState.OpenHand(Hands::RIGHT);
      cRobotState.SetArmVelocities(left < opening_ ? arm_speed_ : 0, right < opening_ ? arm_speed_ : 0);
      input(left >= opening_ && right >= opening_ ? "opened" : "");
      break;
    case CLOSE_ARMS:
      cRobotState.SetArmVelocities(-arm_speed_, -arm_speed_);
      // Arms that no longer move touch an object, or each other.
      input(moved >= 0 && moved < kStill && last_angle_ < 2 * opening_ - kStill ? "contact" : "");
      break;
    case CLOSE_HANDS:
      cRobotState.SetArmVelocities(0, 0);
      cRobotState.CloseHand(Hands::LEFT);
      cRobotState.CloseHand(Hands::RIGHT);
      input(holding ? "holding" : closed ? "missed" : "");
      break;
    default:
      input(holding ? "" : "lost");
      break;
  }
}

void CBTHandbotGrasp::SaveState(std::ostream& state) const
{
  state << GetStateID() << ' ';
  BTSaveNumber(state, last_angle_);
}

void CBTHandbotGrasp::LoadState(std::istream& state)
{
  unsigned int id = 0;
  state >> id;
  RestoreState(id);
  last_angle_ = BTLoadNumber(state);
}
