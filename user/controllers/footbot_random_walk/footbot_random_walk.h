// A correlated random walk: one step straight on, then a turn on the spot by a normally distributed angle, and so on.
// Kareiva and Shigesada, "Analyzing insect movement as a correlated random walk", Oecologia 56 (1983),
// https://doi.org/10.1007/BF00379695. It sees nothing: give it room.
#pragma once

#include "ci_controller.h"
#include "footbot/ci_footbot_wheels_actuator.h"

class CFootBotRandomWalk : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override;
  void ControlStep() override;
  // What it does follows from the tick, and from random numbers that are drawn for the tick.
  bool HasState() const override { return true; }

private:
  CCI_FootBotWheelsActuator* wheels_ = nullptr;
  double step_m_ = 0;
  double deviation_rad_ = 0;
};
