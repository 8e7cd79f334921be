// Sends a packet with a fixed probability in each step, as in slotted ALOHA, and counts the packets that it hears. It
// publishes "heard", their mean number in a step so far.
#pragma once

#include "ci_controller.h"
#include "ci_radio.h"

class CAlohaSender : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override;
  void ControlStep() override;
  bool HasState() const override { return true; }
  void SaveState(std::ostream& state) const override { state << steps_ << ' ' << heard_; }
  void LoadState(std::istream& state) override { state >> steps_ >> heard_; }
  bool StepsInParallel() const override { return true; }

private:
  CCI_RadioActuator* sender_ = nullptr;
  CCI_RadioSensor* receiver_ = nullptr;
  double probability_ = 0;
  std::uint64_t steps_ = 0, heard_ = 0;
};
