// Drives any robot on two wheels without sensors: straight on for a while, then around for a while.
#pragma once

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_wheels_actuator.h"

class CWanderer : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override;
  void ControlStep() override;

  bool HasState() const override { return true; }
  void SaveState(std::ostream& state) const override;
  void LoadState(std::istream& state) override;

private:
  CCI_WheelsActuator* wheels_ = nullptr;
  double velocity_m_s_ = 0;
  int turn_ = 0;            // -1, 0 or 1
  unsigned remaining_ = 0;  // ticks
};
