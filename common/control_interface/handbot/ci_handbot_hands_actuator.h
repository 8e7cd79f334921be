// The two hands (grippers) of a handbot.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_HandBotHandsActuator : public CCI_ActuatorOf<CCI_HandBotHandsActuator>
{
public:
  enum Hand
  {
    LEFT = 0,
    RIGHT = 1
  };
  // Sets both hands, {left, right}. A closing hand grips the body that it touches; an opening hand releases it.
  void SetAllActuatorOutputs(const bool (&closed)[2])
  {
    for (const Hand hand : {LEFT, RIGHT}) closed[hand] ? Close(hand) : Open(hand);
  }
  // Closes one hand. A closing hand grips the body that it touches.
  virtual void Close(Hand hand) = 0;
  // Opens one hand, which releases the body that it holds.
  virtual void Open(Hand hand) = 0;

  static void Declare(Declaration& columns)
  {
    columns.Set({{"left closed", "yes/no", 0, 1}, {"right closed", "yes/no", 0, 1}},
                [](CCI_HandBotHandsActuator& it, std::span<const double> values) {
                  it.SetAllActuatorOutputs({values[LEFT] > 0.5, values[RIGHT] > 0.5});
                });
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_HandBotHandsActuator;
