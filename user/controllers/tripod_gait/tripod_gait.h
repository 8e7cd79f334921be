// Walks with the tripod gait on six legs: three legs stand and push the robot forward while the other three are lifted
// and swing forward, then they change. Each leg has a joint that swings it (positive: forward) and one that lifts it.
#pragma once

#include <array>

#include "ci_controller.h"
#include "ci_joints_actuator.h"
#include "ci_joints_sensor.h"

class CTripodGait : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override;
  void ControlStep() override;
  // The gait follows from the clock, so a run can be restored without saved data.
  bool HasState() const override { return true; }
  bool StepsInParallel() const override { return true; }

private:
  struct Leg
  {
    unsigned swing = 0, lift = 0;  // numbers of its joints
    bool is_left = false;
    bool is_first = false;  // of the three legs that stand first
  };

  void MoveTo(unsigned joint, double position);

  CCI_JointsActuator* joints_ = nullptr;
  CCI_JointsSensor* positions_ = nullptr;
  std::array<Leg, 6> legs_;
  double period_s_ = 0;
  double stride_rad_ = 0;
  double lift_rad_ = 0;
  double turn_ = 0;
};
