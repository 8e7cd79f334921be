#include "gap_follower.h"

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"

using namespace swarmanoid;

namespace
{

constexpr double kGain = 0.5;   // of the steering
constexpr double kAhead = 0.3;  // how much a gap ahead is preferred: part of its width for each radian aside

}  // namespace

int CGapFollower::Init(const TConfigurationTree t_tree)
{
  wheels_ = &GetRobot()->Actuator<CCI_WheelsActuator>("wheels");
  scanner_ = &GetRobot()->Sensor<CCI_RangeScannerSensor>("range_scanner");
  velocity_m_s_ = t_tree.GetNumber("velocity");
  clear_m_ = t_tree.GetNumber("clear");
  return RETURN_OK;
}

double CGapFollower::DirectionOfGap() const
{
  double best = kPi, best_worth = 0;
  unsigned width = 0;
  for (unsigned beam = 0; beam <= scanner_->GetBeams(); ++beam)
  {
    if (beam < scanner_->GetBeams() && scanner_->GetDistance(beam) > clear_m_)
    {
      ++width;
      continue;
    }
    if (width == 0) continue;
    const double middle = (scanner_->GetAngle(beam - width) + scanner_->GetAngle(beam - 1)) / 2;
    const double worth = width * std::max(0.05, 1 - kAhead * std::abs(middle));
    if (worth > best_worth)
    {
      best = middle;
      best_worth = worth;
    }
    width = 0;
  }
  return best;
}

void CGapFollower::ControlStep()
{
  const double turn = DirectionOfGap();
  const double speed = velocity_m_s_ * std::max(0.0, Cos(turn));
  const double wheel = std::clamp(kGain * turn, -1.0, 1.0) * velocity_m_s_;
  wheels_->SetLinearVelocity(speed - wheel, speed + wheel);
}

REGISTER_CONTROLLER(CGapFollower, {.label = "gap_follower",
                                   .brief = "drives towards the widest gap that its range scanner sees",
                                   .parameters = {{.name = "velocity",
                                                   .unit = "m/s",
                                                   .default_value = "0.1",
                                                   .description = "Straight on.",
                                                   .minimum = 0,
                                                   .maximum = 1000},
                                                  {.name = "clear",
                                                   .unit = "m",
                                                   .default_value = "0.5",
                                                   .description = "Distance beyond which a beam belongs to a gap.",
                                                   .minimum = 0,
                                                   .maximum = 1e6}}})
