// Grips the nearest object of a colour. It approaches the object head on, closes the gripper at contact, and tries
// again after a miss.
#pragma once

#include "behavior/ci_behavior.h"
#include "behavior/ci_footbot_state.h"

class CBTFootbotGrip : public CCI_Behavior<CCI_FootBotState>
{
public:
  // `colour` is that of the object (0xRRGGBB), `reach` the distance (m) between centres within which the gripper may
  // touch it, and `speed` is in m/s.
  explicit CBTFootbotGrip(std::uint32_t colour, double reach = 0.22, double speed = 0.05);

  void Step(CCI_FootBotState& cRobotState) override;
  void SetColour(std::uint32_t colour) { colour_ = colour; }
  bool HasObject() const { return has_object_; }

private:
  std::uint32_t colour_;
  double reach_;
  double speed_;
  bool has_object_ = false;
};
