// Diffusion with obstacle avoidance: drives straight on, and turns away from obstacles that the proximity sensors see.
//
// The readings are added as vectors that point to the obstacles (Howard, Mataric and Sukhatme, "Mobile sensor network
// deployment using potential fields", 2002). If the sum points back, or is short and points aside, the robot goes on.
// Otherwise it turns away from the sum with one wheel standing.
#pragma once

#include "ci_controller.h"
#include "footbot/ci_footbot_proximity_sensor.h"
#include "footbot/ci_footbot_wheels_actuator.h"

class CFootBotDiffusion : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override;
  void ControlStep() override;
  // Nothing is remembered between steps, so a run can be restored without saved data.
  bool HasState() const override { return true; }
  bool StepsInParallel() const override { return true; }

private:
  CCI_FootBotWheelsActuator* wheels_ = nullptr;
  CCI_FootBotProximitySensor* proximity_ = nullptr;
  double velocity_m_s_ = 0;
  double tan_alpha_ = 0;
  double delta_ = 0;
};
