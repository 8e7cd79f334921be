#include "orbit.h"

using namespace swarmanoid;

namespace
{

constexpr double kClimbGain = 1;  // 1/s: climb rate for each metre that is missing
constexpr std::uint32_t kGreen = 0x00ff00, kBlue = 0x0000ff;
constexpr double kNear = 0.05;  // m

}  // namespace

int COrbit::Init(const TConfigurationTree t_tree)
{
  propellers_ = &GetRobot()->Actuator<CCI_EyeBotPropellersActuator>("eyebot_propellers");
  leds_ = &GetRobot()->Actuator<CCI_LedRingActuator>("led_ring");
  altitude_ = &GetRobot()->Sensor<CCI_EyeBotAltitudeSensor>("eyebot_altitude");
  velocity_m_s_ = t_tree.GetNumber("velocity");
  radius_m_ = t_tree.GetNumber("radius");
  height_m_ = t_tree.GetNumber("height");
  return RETURN_OK;
}

void COrbit::ControlStep()
{
  const double missing = height_m_ - altitude_->GetAltitude();
  propellers_->SetVelocity(velocity_m_s_, 0, kClimbGain * missing, velocity_m_s_ / radius_m_);
  leds_->SetAllColours(missing < kNear && missing > -kNear ? kGreen : kBlue);
}

REGISTER_CONTROLLER(COrbit, {.label = "orbit",
                             .brief = "flies on a circle at a height; LEDs green at that height, blue elsewhere",
                             .parameters = {{.name = "velocity",
                                             .unit = "m/s",
                                             .default_value = "0.5",
                                             .description = "Along the circle.",
                                             .minimum = 0,
                                             .maximum = 1000},
                                            {.name = "radius",
                                             .unit = "m",
                                             .default_value = "1",
                                             .description = "Radius of the circle.",
                                             .minimum = 0.01,
                                             .maximum = 1e6},
                                            {.name = "height",
                                             .unit = "m",
                                             .default_value = "1",
                                             .description = "Height above what is below the robot.",
                                             .minimum = 0,
                                             .maximum = 1e6}}})
