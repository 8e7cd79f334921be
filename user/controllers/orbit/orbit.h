// Flies on a circle at a height, with all LEDs on. It works for any robot with propellers, an altitude sensor and LEDs,
// such as the Crazyflie of user/entities.
#pragma once

#include "ci_controller.h"
#include "ci_led_ring_actuator.h"
#include "eyebot/ci_eyebot_altitude_sensor.h"
#include "eyebot/ci_eyebot_propellers_actuator.h"

class COrbit : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override;
  void ControlStep() override;
  // Nothing is remembered between steps, so a run can be restored without saved data.
  bool HasState() const override { return true; }
  bool StepsInParallel() const override { return true; }

private:
  CCI_EyeBotPropellersActuator* propellers_ = nullptr;
  CCI_LedRingActuator* leds_ = nullptr;
  CCI_EyeBotAltitudeSensor* altitude_ = nullptr;
  double velocity_m_s_ = 0;
  double radius_m_ = 0;
  double height_m_ = 0;
};
