#include "wanderer.h"

#include <istream>
#include <ostream>

using namespace swarmanoid;

int CWanderer::Init(const TConfigurationTree t_tree)
{
  wheels_ = &GetRobot()->Actuator<CCI_WheelsActuator>("wheels");
  velocity_m_s_ = t_tree.GetNumber("velocity");
  return RETURN_OK;
}

void CWanderer::ControlStep()
{
  constexpr double kLeastWay = 5, kMostWay = 40;  // ticks
  if (remaining_ == 0)
  {
    auto& random = GetRobot()->GetRandom();
    turn_ = turn_ == 0 ? (random.Uniform() < 0.5 ? -1 : 1) : 0;
    remaining_ = static_cast<unsigned>(random.Uniform(kLeastWay, turn_ == 0 ? kMostWay : 2 * kLeastWay));
  }
  --remaining_;
  const double left = turn_ == 0 ? velocity_m_s_ : -turn_ * velocity_m_s_ / 2;
  const double right = turn_ == 0 ? velocity_m_s_ : turn_ * velocity_m_s_ / 2;
  wheels_->SetLinearVelocity(left, right);
}

void CWanderer::SaveState(std::ostream& state) const { state << turn_ << ' ' << remaining_; }

void CWanderer::LoadState(std::istream& state) { state >> turn_ >> remaining_; }

REGISTER_CONTROLLER(CWanderer,
                    {.label = "wanderer",
                     .brief = "drives any robot on two wheels straight on and around by turns, without looking",
                     .parameters = {{.name = "velocity",
                                     .unit = "m/s",
                                     .default_value = "0.1",
                                     .description = "Of a wheel, straight on; half of it around.",
                                     .minimum = 0,
                                     .maximum = 1000}}})
