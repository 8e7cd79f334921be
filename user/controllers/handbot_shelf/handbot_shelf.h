// Fetches an object from a shelf. The robot climbs the rope with spread arms, grips the object with its left hand,
// moves the arm aside, descends, and puts the object down.
#pragma once

#include "ci_controller.h"
#include "handbot/ci_handbot_arms_actuator.h"
#include "handbot/ci_handbot_hands_actuator.h"
#include "handbot/ci_handbot_joints_sensor.h"
#include "handbot/ci_handbot_rope_actuator.h"

class CHandBotShelf : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override;
  void ControlStep() override;
  bool HasState() const override { return true; }
  void SaveState(std::ostream& state) const override;
  void LoadState(std::istream& state) override;

private:
  enum Phase
  {
    kLaunch,
    kClimb,
    kReach,
    kLift,
    kSwing,
    kDescend,
    kPutDown,
    kDone
  };

  void Next(Phase phase);

  CCI_HandBotArmsActuator* arms_ = nullptr;
  CCI_HandBotHandsActuator* hands_ = nullptr;
  CCI_HandBotRopeActuator* rope_ = nullptr;
  CCI_HandBotJointsSensor* joints_ = nullptr;
  double climb_m_ = 1;
  double winch_m_s_ = 0.1;

  int phase_ = kLaunch;
  double rope_at_floor_m_ = 0;
};
