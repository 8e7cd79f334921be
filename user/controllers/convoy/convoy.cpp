#include "convoy.h"

#include <algorithm>
#include <istream>
#include <limits>
#include <ostream>

#include "common/math/elementary.h"

using namespace swarmanoid;

namespace
{

constexpr std::uint32_t kBack = CCI_Colour::RED;
constexpr double kClear = 0.8;   // m: the leader turns left if an obstacle is nearer
constexpr double kBend = 0.4;    // m: radius of its bends
constexpr double kGain = 1.5;    // gain of the steering
constexpr double kSlowDown = 4;  // 1/s: change of speed for each metre of distance error

}  // namespace

int CConvoy::Init(const TConfigurationTree t_tree)
{
  CCI_Robot& robot = *GetRobot();
  wheels_ = &robot.Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
  leds_ = &robot.Actuator<CCI_DirectionalLedsActuator>("directional_leds");
  camera_ = &robot.Sensor<CCI_FootBotOmnidirectionalCameraSensor>("footbot_omnidirectional_camera");
  depth_ = &robot.Sensor<CCI_DepthCameraSensor>("depth_camera");
  velocity_m_s_ = t_tree.GetNumber("velocity");
  distance_m_ = t_tree.GetNumber("distance");
  return RETURN_OK;
}

double CConvoy::FreeAhead() const
{
  double free = std::numeric_limits<double>::infinity();
  // Only pixels above the horizon count, since the floor is below it.
  for (const auto& pixel : depth_->GetAllPixels().first(depth_->GetAllPixels().size() / 2))
    free = std::min(free, pixel.depth_m);
  return free;
}

void CConvoy::ControlStep()
{
  // The two LEDs at the back are red.
  leds_->SetAllColours(CCI_Colour::BLACK);
  leds_->SetColour(5, kBack);
  leds_->SetColour(6, kBack);

  const double free = FreeAhead();
  const CCI_ColourBlob* ahead = camera_->GetNearestBlob(kBack);
  follows_ = ahead != nullptr;
  double speed = velocity_m_s_;
  double turn = 0;
  if (follows_)
  {
    turn = kGain * ahead->angle_rad;
    speed = std::clamp(kSlowDown * (free - distance_m_), 0.0, 1.5 * velocity_m_s_);
  }
  else if (free < kClear)
    turn = velocity_m_s_ / kBend;
  const double wheel = std::clamp(turn * CCI_FootBotWheelsActuator::INTERWHEEL_DISTANCE_M / 2, -0.1, 0.1);
  wheels_->SetFootBotWheelsLinearVelocity(speed - wheel, speed + wheel);
}

void CConvoy::SaveState(std::ostream& state) const { state << follows_; }

void CConvoy::LoadState(std::istream& state) { state >> follows_; }

REGISTER_CONTROLLER(CConvoy, {.label = "convoy",
                              .brief = "follows the red LEDs of the robot ahead, or leads",
                              .parameters = {{.name = "velocity",
                                              .unit = "m/s",
                                              .default_value = "0.1",
                                              .description = "Of the robot that leads.",
                                              .minimum = 0,
                                              .maximum = 1000},
                                             {.name = "distance",
                                              .unit = "m",
                                              .default_value = "0.25",
                                              .description = "From the axis of a robot to the one ahead.",
                                              .minimum = 0,
                                              .maximum = 1e6}}})
