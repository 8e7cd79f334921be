// Goes to the nearest blob of a colour that the omnidirectional camera sees. It decides only while a blob is in view.
#pragma once

#include "behavior/ci_behavior.h"
#include "behavior/ci_footbot_state.h"

class CBTFootbotGoToBlob : public CCI_Behavior<CCI_FootBotState>
{
public:
  // `colour` is 0xRRGGBB, `speed` is in m/s, and `stop_at` is the distance (m) at which the robot stops.
  explicit CBTFootbotGoToBlob(std::uint32_t colour, double speed = 0.1, double stop_at = 0.1);

  void Step(CCI_FootBotState& cRobotState) override;
  void SetColour(std::uint32_t colour) { colour_ = colour; }
  // Return the results of the last step.
  bool HasBlob() const { return has_blob_; }
  bool HasArrived() const { return has_arrived_; }

private:
  std::uint32_t colour_;
  double speed_;
  double stop_at_;
  bool has_blob_ = false;
  bool has_arrived_ = false;
};
