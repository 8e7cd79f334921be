#include "footbot_diffusion.h"

#include "common/math/elementary.h"

using namespace swarmanoid;

int CFootBotDiffusion::Init(const TConfigurationTree t_tree)
{
  wheels_ = &GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
  proximity_ = &GetRobot()->Sensor<CCI_FootBotProximitySensor>("footbot_proximity");
  velocity_m_s_ = t_tree.GetNumber("velocity", 0.05);
  delta_ = t_tree.GetNumber("delta", 0.1);
  const SinCos alpha = SinCosOf(DegreesToRadians(t_tree.GetNumber("alpha", 7.5)));
  tan_alpha_ = alpha.sin / alpha.cos;
  for (unsigned i = 0; i < CCI_FootBotProximitySensor::NUM_SENSORS; ++i)
  {
    const SinCos direction = SinCosOf(CCI_FootBotProximitySensor::AngleOf(i));
    cosines_[i] = direction.cos;
    sines_[i] = direction.sin;
  }
  return RETURN_OK;
}

void CFootBotDiffusion::ControlStep()
{
  double x = 0;
  double y = 0;
  const auto readings = proximity_->GetAllSensorReadings();
  for (unsigned i = 0; i < CCI_FootBotProximitySensor::NUM_SENSORS; ++i)
  {
    x += readings[i] * cosines_[i];
    y += readings[i] * sines_[i];
  }
  x /= CCI_FootBotProximitySensor::NUM_SENSORS;
  y /= CCI_FootBotProximitySensor::NUM_SENSORS;

  const bool far_away = x * x + y * y <= delta_ * delta_;
  const bool beside = y > x * tan_alpha_ || y < -x * tan_alpha_;
  if (x <= 0 || (far_away && beside))
    wheels_->SetFootBotWheelsLinearVelocity(velocity_m_s_, velocity_m_s_);
  else if (y > 0)
    wheels_->SetFootBotWheelsLinearVelocity(velocity_m_s_, 0);
  else
    wheels_->SetFootBotWheelsLinearVelocity(0, velocity_m_s_);
}

REGISTER_CONTROLLER(CFootBotDiffusion, "footbot_diffusion")
