#include "footbot_diffusion.h"

#include <array>

#include "common/math/elementary.h"

using namespace swarmanoid;

namespace
{

// The unit vectors of the sensors in the frame of the robot. All robots share one table, so that it fits the cache.
struct Directions
{
  std::array<double, CCI_FootBotProximitySensor::NUM_SENSORS> cosines{};
  std::array<double, CCI_FootBotProximitySensor::NUM_SENSORS> sines{};

  Directions()
  {
    for (unsigned i = 0; i < CCI_FootBotProximitySensor::NUM_SENSORS; ++i)
    {
      const SinCos direction = SinCosOf(CCI_FootBotProximitySensor::AngleOf(i));
      cosines[i] = direction.cos;
      sines[i] = direction.sin;
    }
  }
};
const Directions kDirections;

}  // namespace

int CFootBotDiffusion::Init(const TConfigurationTree t_tree)
{
  wheels_ = &GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
  proximity_ = &GetRobot()->Sensor<CCI_FootBotProximitySensor>("footbot_proximity");
  velocity_m_s_ = t_tree.GetNumber("velocity");
  delta_ = t_tree.GetNumber("delta");
  const SinCos alpha = SinCosOf(DegreesToRadians(t_tree.GetNumber("alpha")));
  tan_alpha_ = alpha.sin / alpha.cos;
  return RETURN_OK;
}

void CFootBotDiffusion::ControlStep()
{
  // Four partial sums let the compiler add four readings at a time.
  constexpr unsigned kLanes = 4;
  std::array<double, kLanes> xs{};
  std::array<double, kLanes> ys{};
  const auto readings = proximity_->GetAllSensorReadings();
  for (unsigned i = 0; i < CCI_FootBotProximitySensor::NUM_SENSORS; i += kLanes)
    for (unsigned lane = 0; lane < kLanes; ++lane) xs[lane] += readings[i + lane] * kDirections.cosines[i + lane];
  for (unsigned i = 0; i < CCI_FootBotProximitySensor::NUM_SENSORS; i += kLanes)
    for (unsigned lane = 0; lane < kLanes; ++lane) ys[lane] += readings[i + lane] * kDirections.sines[i + lane];
  const double x = ((xs[0] + xs[1]) + (xs[2] + xs[3])) / CCI_FootBotProximitySensor::NUM_SENSORS;
  const double y = ((ys[0] + ys[1]) + (ys[2] + ys[3])) / CCI_FootBotProximitySensor::NUM_SENSORS;

  const bool far_away = x * x + y * y <= delta_ * delta_;
  const bool beside = y > x * tan_alpha_ || y < -x * tan_alpha_;
  if (x <= 0 || (far_away && beside))
    wheels_->SetFootBotWheelsLinearVelocity(velocity_m_s_, velocity_m_s_);
  else if (y > 0)
    wheels_->SetFootBotWheelsLinearVelocity(velocity_m_s_, 0);
  else
    wheels_->SetFootBotWheelsLinearVelocity(0, velocity_m_s_);
}

REGISTER_CONTROLLER(
    CFootBotDiffusion,
    {.label = "footbot_diffusion",
     .brief = "drives straight on and turns away from what its proximity sensors see",
     .parameters = {
         {.name = "velocity",
          .unit = "m/s",
          .default_value = "0.05",
          .description = "Of the robot that drives on.",
          .minimum = 0,
          .maximum = 1000},
         {.name = "alpha",
          .unit = "degrees",
          .default_value = "7.5",
          .description = "Half the cone ahead that must be free for the robot to drive on.",
          .minimum = 0,
          .maximum = 89},
         {.name = "delta",
          .default_value = "0.1",
          .description = "Longest sum of the readings, as vectors that point to the obstacles, that is ignored.",
          .minimum = 0,
          .maximum = 1e6}}})
