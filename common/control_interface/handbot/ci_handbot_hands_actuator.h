// The two hands (grippers) of a handbot.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_HandBotHandsActuator : public CCI_Actuator
{
public:
  enum Hand
  {
    LEFT = 0,
    RIGHT = 1
  };
  // A closing hand takes hold of what it touches; an opening one lets go. Group-level form: {left, right}.
  void SetAllActuatorOutputs(const bool (&closed)[2])
  {
    for (const Hand hand : {LEFT, RIGHT}) closed[hand] ? Close(hand) : Open(hand);
  }
  virtual void Close(Hand hand) = 0;
  virtual void Open(Hand hand) = 0;

  std::vector<CCI_Column> Columns() const override
  {
    return {{"left closed", "yes/no", 0, 1}, {"right closed", "yes/no", 0, 1}};
  }
  void SetColumns(std::span<const double> values) override
  {
    SetAllActuatorOutputs({values[LEFT] > 0.5, values[RIGHT] > 0.5});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_HandBotHandsActuator;
