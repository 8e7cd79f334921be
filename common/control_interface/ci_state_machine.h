// CCI_StateMachine: the interface of a finite state machine (fsm.h) for visualisers, independent of its type of inputs.
#pragma once

#include <string>

namespace swarmanoid
{

class CCI_StateMachine
{
public:
  virtual ~CCI_StateMachine() = default;
  // Returns false before the start state is set.
  virtual bool HasStarted() const = 0;
  // Returns the name of the current state. The machine must have started.
  virtual const std::string& GetStateName() const = 0;
};

// Returns an empty result for nullptr and for a machine that has not started.
inline std::string StateNameOf(const CCI_StateMachine* machine)
{
  return machine != nullptr && machine->HasStarted() ? machine->GetStateName() : std::string();
}

}  // namespace swarmanoid

using swarmanoid::CCI_StateMachine;
