// A robot of a convoy. All show red LEDs at their backs, which are seen from behind only; so each robot that sees red
// follows the one ahead of it, and the one that sees none leads. A depth camera keeps the distance.
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
  // The least depth of what stands up ahead, m.
  double FreeAhead() const;

  swarmanoid::CCI_FootBotWheelsActuator* wheels_ = nullptr;
  swarmanoid::CCI_DirectionalLedsActuator* leds_ = nullptr;
  const swarmanoid::CCI_FootBotOmnidirectionalCameraSensor* camera_ = nullptr;
  const swarmanoid::CCI_DepthCameraSensor* depth_ = nullptr;
  double velocity_m_s_ = 0;
  double distance_m_ = 0;
  bool follows_ = false;
};
