// Robots pull an object together: each grips what its gripper touches, and drives once it holds it.
#pragma once

#include "ci_controller.h"
#include "footbot/ci_footbot_gripper_actuator.h"
#include "footbot/ci_footbot_gripper_sensor.h"
#include "footbot/ci_footbot_wheels_actuator.h"

class CFootBotChain : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override;
  void ControlStep() override;
  // Nothing is remembered between steps, so a run can be restored without saved data.
  bool HasState() const override { return true; }

private:
  CCI_FootBotWheelsActuator* wheels_ = nullptr;
  CCI_FootBotGripperActuator* gripper_ = nullptr;
  CCI_FootBotGripperSensor* grip_ = nullptr;
  double velocity_m_s_ = 0;
};
