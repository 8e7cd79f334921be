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
  // A robot without one of them is refused before the run.
  GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
  GetRobot()->Sensor<CCI_FootBotProximitySensor>("footbot_proximity");
  speed_rad_s_ = t_tree.GetNumber("velocity") / CCI_FootBotWheelsActuator::WHEEL_RADIUS_M;
  delta_ = t_tree.GetNumber("delta");
  const SinCos alpha = SinCosOf(DegreesToRadians(t_tree.GetNumber("alpha")));
  tan_alpha_ = alpha.sin / alpha.cos;
  return RETURN_OK;
}

void CFootBotDiffusion::ControlSteps(CCI_Batch& robots)
{
  const CCI_Readings proximity = robots.Readings("footbot_proximity");
  const CCI_Commands wheels = robots.Commands("footbot_wheels");
  for (std::size_t k = 0; k < robots.Size(); ++k) Steer(proximity[k].data(), wheels[k].data());
}

void CFootBotDiffusion::Steer(const double* readings, double* wheels) const
{
  // Four partial sums let the compiler add four readings at a time.
  constexpr unsigned kLanes = 4;
  std::array<double, kLanes> xs{};
  std::array<double, kLanes> ys{};
  for (unsigned i = 0; i < CCI_FootBotProximitySensor::NUM_SENSORS; i += kLanes)
    for (unsigned lane = 0; lane < kLanes; ++lane) xs[lane] += readings[i + lane] * kDirections.cosines[i + lane];
  for (unsigned i = 0; i < CCI_FootBotProximitySensor::NUM_SENSORS; i += kLanes)
    for (unsigned lane = 0; lane < kLanes; ++lane) ys[lane] += readings[i + lane] * kDirections.sines[i + lane];
  const double x = ((xs[0] + xs[1]) + (xs[2] + xs[3])) / CCI_FootBotProximitySensor::NUM_SENSORS;
  const double y = ((ys[0] + ys[1]) + (ys[2] + ys[3])) / CCI_FootBotProximitySensor::NUM_SENSORS;

  const bool far_away = x * x + y * y <= delta_ * delta_;
  const bool beside = y > x * tan_alpha_ || y < -x * tan_alpha_;
  const bool goes_on = x <= 0 || (far_away && beside);
  wheels[0] = goes_on || y > 0 ? speed_rad_s_ : 0;
  wheels[1] = goes_on || y <= 0 ? speed_rad_s_ : 0;
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
