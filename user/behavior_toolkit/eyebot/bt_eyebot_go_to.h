// Flies until the nearest blob of a colour is straight below. It decides only while a blob is in view.
#pragma once

#include "behavior/ci_behavior.h"
#include "behavior/ci_eyebot_state.h"

class CBTEyebotGoTo : public CCI_Behavior<CCI_EyeBotState>
{
public:
  // `colour` is 0xRRGGBB, `speed` is in m/s, and `near` is the horizontal distance (m) that counts as arrived.
  explicit CBTEyebotGoTo(std::uint32_t colour, double speed = 0.2, double near = 0.1)
      : CCI_Behavior("go to"), colour_(colour), speed_(speed), near_(near)
  {
  }

  void Step(CCI_EyeBotState& cRobotState) override;
  void SetColour(std::uint32_t colour) { colour_ = colour; }
  // Return the results of the last step.
  bool HasTarget() const { return has_target_; }
  bool HasArrived() const { return has_arrived_; }

private:
  std::uint32_t colour_;
  double speed_;
  double near_;
  bool has_target_ = false;
  bool has_arrived_ = false;
};
