#include "epuck_diffusion.h"

#include "common/math/elementary.h"

using namespace swarmanoid;

int CEPuckDiffusion::Init(const TConfigurationTree t_tree)
{
  wheels_ = &GetRobot()->Actuator<CCI_WheelsActuator>("wheels");
  leds_ = &GetRobot()->Actuator<CCI_LedRingActuator>("led_ring");
  proximity_ = &GetRobot()->Sensor<CCI_ProximitySensor>("proximity");
  velocity_m_s_ = t_tree.GetNumber("velocity");
  threshold_ = t_tree.GetNumber("threshold");
  return RETURN_OK;
}

void CEPuckDiffusion::ControlStep()
{
  // Sums the readings in front, separately for each side.
  double left = 0;
  double right = 0;
  const auto readings = proximity_->GetAllSensorReadings();
  for (unsigned i = 0; i < readings.size(); ++i)
  {
    const SinCos direction = SinCosOf(proximity_->GetAngle(i));
    if (direction.cos <= 0) continue;
    (direction.sin > 0 ? left : right) += readings[i] * direction.cos;
  }
  const bool is_free = left + right <= threshold_;
  leds_->SetAllColours(is_free ? 0x00ff00 : 0xff0000);
  if (is_free)
    wheels_->SetLinearVelocity(velocity_m_s_, velocity_m_s_);
  else if (left > right)
    wheels_->SetLinearVelocity(velocity_m_s_, -velocity_m_s_);
  else
    wheels_->SetLinearVelocity(-velocity_m_s_, velocity_m_s_);
}

REGISTER_CONTROLLER(
    CEPuckDiffusion,
    {.label = "epuck_diffusion",
     .brief = "drives straight on and turns away from what its proximity sensors see; LEDs green, red while it turns",
     .parameters = {{.name = "velocity",
                     .unit = "m/s",
                     .default_value = "0.1",
                     .description = "Of the robot that drives on.",
                     .minimum = 0,
                     .maximum = 1000},
                    {.name = "threshold",
                     .default_value = "0.1",
                     .description = "Sum of the readings ahead, each by the cosine of its angle, that is ignored.",
                     .minimum = 0,
                     .maximum = 1e6}}})
