#include "footbot_chain.h"

int CFootBotChain::Init(const TConfigurationTree t_tree)
{
  wheels_ = &GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
  gripper_ = &GetRobot()->Actuator<CCI_FootBotGripperActuator>("footbot_gripper");
  grip_ = &GetRobot()->Sensor<CCI_FootBotGripperSensor>("footbot_gripper");
  velocity_m_s_ = t_tree.GetNumber("velocity", -0.1);
  return RETURN_OK;
}

void CFootBotChain::ControlStep()
{
  gripper_->SetGripper(1);
  const double velocity = grip_->IsGripping() ? velocity_m_s_ : 0;
  wheels_->SetFootBotWheelsLinearVelocity(velocity, velocity);
}

REGISTER_CONTROLLER(CFootBotChain, "footbot_chain", "closes its gripper, and drives while it holds something")
