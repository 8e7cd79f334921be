// The gradient of the Kilobot labs (github.com/acornejo/kilobot-labs, lab 6). A seed sends 0. Each other robot sends
// one more than the least number that it hears, and shows it by its LED. Robots that hear no number wander.
#pragma once

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_led_ring_actuator.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/control_interface/ci_wheels_actuator.h"

class CKilobotGradient : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override;
  void ControlStep() override;

  bool HasState() const override { return true; }
  void SaveState(std::ostream& state) const override;
  void LoadState(std::istream& state) override;
  std::string StatusText() const override;

private:
  // Returns the hops to the seed, by the received numbers; kUnknown if no neighbour knows them.
  unsigned Hops() const;
  void Wander();

  CCI_WheelsActuator* wheels_ = nullptr;
  CCI_LedRingActuator* leds_ = nullptr;
  CCI_RangeAndBearingActuator* sender_ = nullptr;
  CCI_RangeAndBearingSensor* receiver_ = nullptr;
  bool is_seed_ = false;
  double velocity_m_s_ = 0;
  unsigned hops_ = 0;
  int turn_ = 0;               // -1, 0 or 1
  unsigned until_change_ = 0;  // ticks
};
