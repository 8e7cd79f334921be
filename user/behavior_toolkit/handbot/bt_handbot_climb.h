// Climbs on the rope. It launches the rope, pulls itself up to a height by the length of the rope, and holds there.
#pragma once

#include "behavior/ci_behavior.h"
#include "behavior/ci_handbot_state.h"

class CBTHandbotClimb : public CCI_Behavior<CCI_HandBotState>
{
public:
  // `rope_length` is the length (m) of rope between robot and ceiling at the end; `speed` is in m/s of rope.
  explicit CBTHandbotClimb(double rope_length, double speed = 0.1)
      : CCI_Behavior("climb"), rope_length_(rope_length), speed_(speed)
  {
  }

  void Step(CCI_HandBotState& cRobotState) override;
  void SetRopeLength(double rope_length) { rope_length_ = rope_length; }
  bool HasArrived() const { return has_arrived_; }

private:
  double rope_length_;
  double speed_;
  bool has_arrived_ = false;
};
