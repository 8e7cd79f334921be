// A robot of a convoy. All robots have red LEDs at their backs, which are visible only from behind. A robot that sees
// red follows the robot ahead of it. The robot that sees none leads. A depth camera keeps the distance.
#pragma once

#include "ci_controller.h"
#include "ci_depth_camera_sensor.h"
#include "ci_directional_leds_actuator.h"
#include "footbot/ci_footbot_omnidirectional_camera_sensor.h"
#include "footbot/ci_footbot_wheels_actuator.h"

class CConvoy : public swarmanoid::CCI_Controller
{
public:
  int Init(swarmanoid::TConfigurationTree t_tree) override;
  void ControlStep() override;
  bool HasState() const override { return true; }
  void SaveState(std::ostream& state) const override;
  void LoadState(std::istream& state) override;
  std::string StatusText() const override { return follows_ ? "follows" : "leads"; }

private:
  // Returns the least depth of obstacles ahead, in m.
  double FreeAhead() const;

  swarmanoid::CCI_FootBotWheelsActuator* wheels_ = nullptr;
  swarmanoid::CCI_DirectionalLedsActuator* leds_ = nullptr;
  const swarmanoid::CCI_FootBotOmnidirectionalCameraSensor* camera_ = nullptr;
  const swarmanoid::CCI_DepthCameraSensor* depth_ = nullptr;
  double velocity_m_s_ = 0;
  double distance_m_ = 0;
  bool follows_ = false;
};
