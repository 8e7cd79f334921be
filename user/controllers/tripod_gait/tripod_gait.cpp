#include "tripod_gait.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace swarmanoid;

namespace
{

// Returns how far a leg is between its ends: -1 behind, 1 in front. It stands in the first half of the period, which it
// enters in front.
double Along(double phase) { return phase < 0.5 ? 1 - 4 * phase : 4 * phase - 3; }

// Returns how high a leg is lifted, 0 to 1.
double Height(double phase) { return phase < 0.5 ? 0 : std::min(1.0, 2 * (1 - std::abs(4 * phase - 3))); }

}  // namespace

int CTripodGait::Init(const TConfigurationTree t_tree)
{
  joints_ = &GetRobot()->Actuator<CCI_JointsActuator>("joints");
  positions_ = &GetRobot()->Sensor<CCI_JointsSensor>("joints");
  period_s_ = t_tree.GetNumber("period");
  stride_rad_ = t_tree.GetNumber("stride");
  lift_rad_ = t_tree.GetNumber("lift");
  turn_ = t_tree.GetNumber("turn");
  std::size_t number = 0;
  for (const std::string row : {"front", "middle", "back"})
    for (const std::string side : {"left", "right"})
    {
      const std::string leg = side + "_" + row;
      legs_[number++] = {joints_->GetJoint(leg + "_swing"), joints_->GetJoint(leg + "_lift"), side == "left",
                         (side == "left") == (row != "middle")};
    }
  return RETURN_OK;
}

void CTripodGait::ControlStep()
{
  // The legs start in the middle of their way.
  const double time = (GetRobot()->GetTime() + GetRobot()->GetTickSeconds()) / period_s_ + 0.25;
  for (const Leg& leg : legs_)
  {
    const double shifted = time + (leg.is_first ? 0 : 0.5);
    const double phase = shifted - std::floor(shifted);
    // The legs on the inner side of a curve make shorter strides.
    const double part = 1 - std::max(leg.is_left ? turn_ : -turn_, 0.0) * 2;
    MoveTo(leg.swing, part * stride_rad_ * Along(phase));
    MoveTo(leg.lift, lift_rad_ * Height(phase));
  }
}

// A joint that gets a position goes there at its largest speed. One that gets the speed for a tick moves evenly.
void CTripodGait::MoveTo(unsigned joint, double position)
{
  joints_->SetVelocity(joint, (position - positions_->GetPosition(joint)) / GetRobot()->GetTickSeconds());
}

REGISTER_CONTROLLER(CTripodGait,
                    {.label = "tripod_gait",
                     .brief = "walks on six legs with the tripod gait, straight on or in curves",
                     .parameters = {{.name = "period",
                                     .unit = "s",
                                     .default_value = "1",
                                     .description = "Of a step of both groups of legs.",
                                     .minimum = 0.2,
                                     .maximum = 60},
                                    {.name = "stride",
                                     .unit = "rad",
                                     .default_value = "0.25",
                                     .description = "How far the legs swing to each side of their middle.",
                                     .minimum = 0,
                                     .maximum = 0.7},
                                    {.name = "lift",
                                     .unit = "rad",
                                     .default_value = "0.4",
                                     .description = "How far a leg is lifted while it swings forward.",
                                     .minimum = 0,
                                     .maximum = 1},
                                    {.name = "turn",
                                     .default_value = "0",
                                     .description = "The curve: 0 straight on, 1 around to the left, -1 to the right.",
                                     .minimum = -1,
                                     .maximum = 1}}})
