// Drives towards the widest gap that its range scanner sees. It works for any robot with wheels.
#pragma once

#include "ci_controller.h"
#include "ci_range_scanner_sensor.h"
#include "ci_wheels_actuator.h"

class CGapFollower : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override;
  void ControlStep() override;
  // Nothing is remembered between steps, so a run can be restored without saved data.
  bool HasState() const override { return true; }
  bool StepsInParallel() const override { return true; }

private:
  // Returns the direction (rad) of the middle of the widest gap, or half a turn if there is none.
  double DirectionOfGap() const;

  CCI_WheelsActuator* wheels_ = nullptr;
  CCI_RangeScannerSensor* scanner_ = nullptr;
  double velocity_m_s_ = 0;
  double clear_m_ = 0;
};
