#include "footbot_chain.h"

int CFootBotChain::Init(const TConfigurationTree t_tree)
{
  wheels_ = &GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
  gripper_ = &GetRobot()->Actuator<CCI_FootBotGripperActuator>("footbot_gripper");
  grip_ = &GetRobot()->Sensor<CCI_FootBotGripperSensor>("footbot_gripper");
  velocity_m_s_ = t_tree.GetNumber("velocity");
  return RETURN_OK;
}

void CFootBotChain::ControlStep()
{
  gripper_->SetGripper(1);
  const double velocity = grip_->IsGripping() ? velocity_m_s_ : 0;
  wheels_->SetFootBotWheelsLinearVelocity(velocity, velocity);
}

REGISTER_CONTROLLER(CFootBotChain, {.label = "footbot_chain",
                                    .brief = "closes its gripper, and drives while it holds something",
                                    .parameters = {{.name = "velocity",
                                                    .unit = "m/s",
                                                    .default_value = "-0.1",
                                                    .description = "Of both wheels; negative: backwards, pulling.",
                                                    .minimum = -1000,
                                                    .maximum = 1000}}})
