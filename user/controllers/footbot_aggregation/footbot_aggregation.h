// Aggregation without computation: one bit, whether another robot is in front, chooses one of two pairs of wheel
// speeds. Gauci, Chen, Li, Dodd, Gross, "Self-organized aggregation without computation", International Journal of
// Robotics Research 33 (2014), https://doi.org/10.1177/0278364914525244.
#pragma once

#include "ci_controller.h"
#include "footbot/ci_footbot_beacon_actuator.h"
#include "footbot/ci_footbot_omnidirectional_camera_sensor.h"
#include "footbot/ci_footbot_wheels_actuator.h"

class CFootBotAggregation : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override;
  void ControlStep() override;
  // Nothing is remembered between steps, so a run can be restored without saved data.
  bool HasState() const override { return true; }

private:
  bool SeesRobot() const;

  CCI_FootBotWheelsActuator* wheels_ = nullptr;
  CCI_FootBotBeaconActuator* beacon_ = nullptr;
  CCI_FootBotOmnidirectionalCameraSensor* camera_ = nullptr;
  double radius_m_ = 0;
  swarmanoid::Vector2 free_m_s_, seen_m_s_;  // m/s of the left and right wheel
};
