#include "footbot_random_walk.h"

#include <cmath>

#include "common/math/elementary.h"

using namespace swarmanoid;

int CFootBotRandomWalk::Init(const TConfigurationTree t_tree)
{
  wheels_ = &GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
  step_m_ = t_tree.GetNumber("step");
  deviation_rad_ = DegreesToRadians(t_tree.GetNumber("deviation"));
  return RETURN_OK;
}

// Ticks alternate between a step and a turn.
void CFootBotRandomWalk::ControlStep()
{
  const double tick_s = GetRobot()->GetTickSeconds();
  if (GetRobot()->GetTick() % 2 == 0)
    return wheels_->SetFootBotWheelsLinearVelocity(step_m_ / tick_s, step_m_ / tick_s);
  // The angle is reduced to half a circle, since whole circles change nothing.
  const double angle_rad = std::remainder(GetRobot()->GetRandom().Gaussian(0, deviation_rad_), 2 * kPi);
  const double speed_m_s = angle_rad * CCI_FootBotWheelsActuator::INTERWHEEL_DISTANCE_M / 2 / tick_s;
  wheels_->SetFootBotWheelsLinearVelocity(-speed_m_s, speed_m_s);
}

REGISTER_CONTROLLER(CFootBotRandomWalk,
                    {.label = "footbot_random_walk",
                     .brief = "a step straight on, a turn by a normally distributed angle, and so on, one tick each",
                     .parameters = {{.name = "step",
                                     .unit = "m",
                                     .default_value = "0.1",
                                     .description = "Length of a step.",
                                     .minimum = 0,
                                     .maximum = 1e6},
                                    {.name = "deviation",
                                     .unit = "degrees",
                                     .default_value = "30",
                                     .description = "Standard deviation of the turns about straight ahead.",
                                     .minimum = 0,
                                     .maximum = 1000}}})
