// Grasps with both hands. It opens the arms and hands, closes the arms about an object between them, and closes the
// hands.
#pragma once

#include "behavior/ci_behavior.h"
#include "behavior/ci_handbot_state.h"
#include "behavior/fsm.h"

class CBTHandbotGrasp : public CCI_Behavior<CCI_HandBotState>, public FSM<std::string>
{
public:
  static constexpr unsigned int OPEN = 0;
  static constexpr unsigned int CLOSE_ARMS = 1;
  static constexpr unsigned int CLOSE_HANDS = 2;
  static constexpr unsigned int HOLD = 3;

  // `opening` is the angle (rad) by which the arms open; `arm_speed` is in rad/s.
  explicit CBTHandbotGrasp(double opening = 0.6, double arm_speed = 0.5);

  void Step(CCI_HandBotState& cRobotState) override;
  std::string StatusText() const override { return GetStateName(); }
  void SaveState(std::ostream& state) const override;
  void LoadState(std::istream& state) override;
  bool HasObject() const { return GetStateID() == HOLD; }

private:
  double opening_;
  double arm_speed_;
  double last_angle_ = 0;
};
