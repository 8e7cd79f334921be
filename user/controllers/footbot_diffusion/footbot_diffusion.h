// Diffusion with obstacle avoidance: drives straight on, and turns away from obstacles that the proximity sensors see.
//
// The readings are added as vectors that point to the obstacles (Howard, Mataric and Sukhatme, "Mobile sensor network
// deployment using potential fields", 2002). If the sum points back, or is short and points aside, the robot goes on.
// Otherwise it turns away from the sum with one wheel standing.
//
// All robots step by one call. Readings and commands are tables with a row for each robot.
#pragma once

#include "ci_batch_controller.h"
#include "footbot/ci_footbot_proximity_sensor.h"
#include "footbot/ci_footbot_wheels_actuator.h"

class CFootBotDiffusion : public CCI_BatchController
{
public:
  int Init(const TConfigurationTree t_tree) override;
  void ControlSteps(CCI_Batch& robots) override;
  // Nothing is remembered between steps, so a run can be restored without saved data.
  bool HasState() const override { return true; }
  bool StepsInParallel() const override { return true; }

private:
  // Sets the two wheels (rad/s) by the 24 readings of a robot.
  void Steer(const double* readings, double* wheels) const;

  double speed_rad_s_ = 0;
  double tan_alpha_ = 0;
  double delta_ = 0;
};
