// CCI_Behavior: a building block of controllers. It reads sensors from a robot state and writes actuator values into
// it. It never touches the robot itself, so behaviours can be combined: one after the other (later ones override), or
// each on a copy of the state.
#pragma once

#include <iosfwd>
#include <string>
#include <utility>

#include "common/control_interface/ci_state_machine.h"

namespace swarmanoid
{

template <class RobotState>
class CCI_Behavior
{
public:
  explicit CCI_Behavior(std::string name = "behavior") : name_(std::move(name)) {}
  virtual ~CCI_Behavior() = default;
  CCI_Behavior(const CCI_Behavior&) = delete;
  CCI_Behavior& operator=(const CCI_Behavior&) = delete;

  // The controller calls it once, before the first step.
  virtual void Init() {}
  // Decides for one tick: reads `cRobotState` and writes actuator values into it.
  virtual void Step(RobotState& cRobotState) = 0;
  // The controller calls it once, after the last step.
  virtual void Destroy() {}

  // Saves the state between ticks, with that of sub-behaviours. Only runs with checkpoints need it.
  virtual void SaveState(std::ostream&) const {}
  // Loads what SaveState has saved.
  virtual void LoadState(std::istream&) {}
  // Returns a few words for visualisers, such as the current state.
  virtual std::string StatusText() const { return name_; }
  // Returns the current state of a behaviour that is a state machine. A combiner may return that of the active
  // behaviour.
  virtual std::string StateName() const { return StateNameOf(dynamic_cast<const CCI_StateMachine*>(this)); }

  const std::string& GetName() const { return name_; }

private:
  std::string name_;
};

}  // namespace swarmanoid

using swarmanoid::CCI_Behavior;
