// A correlated random walk: steps straight on alternate with turns on the spot by normally distributed angles. Kareiva
// and Shigesada, "Analyzing insect movement as a correlated random walk", Oecologia 56 (1983),
// https://doi.org/10.1007/BF00379695. The robot has no sensors, so the arena must be large and free.
#pragma once

#include "ci_controller.h"
#include "footbot/ci_footbot_wheels_actuator.h"

class CFootBotRandomWalk : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override;
  void ControlStep() override;
  // The step follows from the tick, and from random numbers that are drawn for the tick.
  bool HasState() const override { return true; }

private:
  CCI_FootBotWheelsActuator* wheels_ = nullptr;
  double step_m_ = 0;
  double deviation_rad_ = 0;
};
