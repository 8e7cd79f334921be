// The rule of the diffusion of ARGoS3's examples (argos3-examples, controllers/footbot_diffusion at 604f97be): a robot
// drives straight on only while the mean of the readings, as vectors, points ahead and is short. So a body behind makes
// a robot turn, too.
#include <cmath>
#include <numbers>

#include "ci_controller.h"
#include "footbot/ci_footbot_proximity_sensor.h"
#include "footbot/ci_footbot_wheels_actuator.h"

using namespace swarmanoid;

class CArgos3Diffusion : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override
  {
    velocity_ = t_tree.GetNumber("velocity");
    delta_ = t_tree.GetNumber("delta");
    return RETURN_OK;
  }

  void ControlStep() override
  {
    const auto readings = GetRobot()->Sensor<CCI_FootBotProximitySensor>("footbot_proximity").GetAllSensorReadings();
    double x = 0;
    double y = 0;
    for (unsigned i = 0; i < readings.size(); ++i)
    {
      x += readings[i] * std::cos(CCI_FootBotProximitySensor::AngleOf(i)) / 24;
      y += readings[i] * std::sin(CCI_FootBotProximitySensor::AngleOf(i)) / 24;
    }
    auto& wheels = GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
    const double angle = std::atan2(y, x);
    if (std::abs(angle) <= kAlpha && std::hypot(x, y) < delta_)
      wheels.SetFootBotWheelsLinearVelocity(velocity_, velocity_);
    else if (angle > 0)
      wheels.SetFootBotWheelsLinearVelocity(velocity_, 0);
    else
      wheels.SetFootBotWheelsLinearVelocity(0, velocity_);
  }

private:
  static constexpr double kAlpha = 7.5 * std::numbers::pi / 180;
  double velocity_ = 0;
  double delta_ = 0;
};

REGISTER_CONTROLLER(
    CArgos3Diffusion,
    {.label = "argos3_diffusion",
     .brief = "diffuses by the rule of ARGoS3's examples",
     .parameters = {
         {.name = "velocity", .unit = "m/s", .default_value = "0.05", .description = "Of the robot that drives on."},
         {.name = "delta",
          .default_value = "0.1",
          .description = "Longest mean of the readings, as vectors, at which it drives on.",
          .minimum = 0}}})
