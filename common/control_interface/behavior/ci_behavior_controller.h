// CCI_BehaviorController: a controller that only holds a robot state and a root behaviour. A subclass makes both in
// Init and deletes them in Destroy; `swarmanoid new behavior-controller` writes it.
#pragma once

#include "common/control_interface/behavior/ci_behavior.h"
#include "common/control_interface/ci_controller.h"

namespace swarmanoid
{

// `RobotState` is CCI_FootBotState, CCI_HandBotState or CCI_EyeBotState.
template <class RobotState>
class CCI_BehaviorController : public CCI_Controller
{
public:
  // Reads the sensors once, lets the root behaviour decide, and writes the actuators once.
  void ControlStep() override
  {
    m_pcState->ReadSensors();
    m_pcRootBehavior->Step(*m_pcState);
    m_pcState->WriteActuators();
  }

  bool HasState() const override { return true; }
  void SaveState(std::ostream& state) const override { m_pcRootBehavior->SaveState(state); }
  void LoadState(std::istream& state) override { m_pcRootBehavior->LoadState(state); }
  std::string StatusText() const override { return m_pcRootBehavior == nullptr ? "" : m_pcRootBehavior->StatusText(); }
  std::string StateName() const override { return m_pcRootBehavior == nullptr ? "" : m_pcRootBehavior->StateName(); }

protected:
  RobotState* m_pcState = nullptr;
  CCI_Behavior<RobotState>* m_pcRootBehavior = nullptr;
};

}  // namespace swarmanoid

using swarmanoid::CCI_BehaviorController;
