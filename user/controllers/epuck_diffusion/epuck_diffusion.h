// Drives straight on and turns away from obstacles that the proximity sensors see, with its LEDs on. It works for any
// robot with wheels, proximity sensors and LEDs, such as the e-puck of user/entities.
#pragma once

#include "ci_controller.h"
#include "ci_led_ring_actuator.h"
#include "ci_proximity_sensor.h"
#include "ci_wheels_actuator.h"

class CEPuckDiffusion : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override;
  void ControlStep() override;
  // Nothing is remembered between steps, so a run can be restored without saved data.
  bool HasState() const override { return true; }
  bool StepsInParallel() const override { return true; }

private:
  CCI_WheelsActuator* wheels_ = nullptr;
  CCI_LedRingActuator* leds_ = nullptr;
  CCI_ProximitySensor* proximity_ = nullptr;
  double velocity_m_s_ = 0;
  double threshold_ = 0;
};
