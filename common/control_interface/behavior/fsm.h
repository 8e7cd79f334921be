// FSM and State: finite state machines for behaviours. A state lists its transitions by input; inputs are values of
// type T, often std::string ("preyFound"). The machine owns its states and remembers only the current one.
//
//   m_pcSearch = initializeState(this, SEARCH, "[SEARCH]");
//   m_pcApproach = initializeState(this, APPROACH, "[APPROACH]");
//   m_pcSearch->addTransition("found", m_pcApproach);
//   setStartState(m_pcSearch);
//   …
//   input("found");
#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/control_interface/ci_state_machine.h"

namespace swarmanoid
{

template <class T>
class FSM;

template <class T>
class State
{
public:
  State(FSM<T>* fsm, unsigned int id, std::string name) : fsm_(fsm), id_(id), name_(std::move(name)) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  // Adds a transition to `target` on this input. Throws std::logic_error if the input already leads to another state,
  // or if the target belongs to another machine.
  void addTransition(const T& on, State* target)
  {
    if (target == nullptr || target->fsm_ != fsm_)
      throw std::logic_error("state " + name_ + ": a transition must lead to a state of the same machine");
    const auto [place, added] = transitions_.emplace(on, target);
    if (!added && place->second != target)
      throw std::logic_error("state " + name_ + ": one input leads to " + place->second->name_ + " and to " +
                             target->name_);
  }

  unsigned int GetID() const { return id_; }
  const std::string& GetName() const { return name_; }
  // Returns the state that an input leads to, or this state if it has no transition for the input.
  State* Next(const T& on)
  {
    const auto found = transitions_.find(on);
    return found == transitions_.end() ? this : found->second;
  }

private:
  FSM<T>* fsm_;
  unsigned int id_;
  std::string name_;
  std::map<T, State*> transitions_;
};

template <class T>
class FSM : public CCI_StateMachine
{
public:
  FSM() = default;
  FSM(const FSM&) = delete;
  FSM& operator=(const FSM&) = delete;

  // Returns the id and name of the current state. Throws std::logic_error before setStartState.
  unsigned int GetStateID() const { return Current().GetID(); }
  const std::string& GetStateName() const override { return Current().GetName(); }
  bool HasStarted() const override { return current_ != nullptr; }
  // Puts the machine into a state by its id, for example when a saved run continues. Throws std::out_of_range if the
  // machine has no such state.
  void RestoreState(unsigned int id)
  {
    for (const auto& state : states_)
      if (state->GetID() == id)
      {
        current_ = state.get();
        return;
      }
    throw std::out_of_range("the state machine has no state " + std::to_string(id));
  }

protected:
  // Makes a new state of `fsm`, which must be this machine. Throws std::logic_error if the id is taken.
  State<T>* initializeState(FSM* fsm, unsigned int id, const std::string& name)
  {
    for (const auto& state : fsm->states_)
      if (state->GetID() == id)
        throw std::logic_error("state " + name + ": its id is that of state " + state->GetName());
    fsm->states_.push_back(std::make_unique<State<T>>(fsm, id, name));
    return fsm->states_.back().get();
  }

  void setStartState(State<T>* state) { current_ = state; }

  // Takes the transition of the current state for this input. Inputs without a transition, such as the empty string,
  // change nothing. Returns whether the state changed.
  bool input(const T& value)
  {
    Current();
    State<T>* next = current_->Next(value);
    const bool changed = next != current_;
    current_ = next;
    return changed;
  }

private:
  const State<T>& Current() const
  {
    if (current_ == nullptr) throw std::logic_error("the state machine has no start state: call setStartState first");
    return *current_;
  }

  std::vector<std::unique_ptr<State<T>>> states_;
  State<T>* current_ = nullptr;
};

}  // namespace swarmanoid

using swarmanoid::FSM;
using swarmanoid::State;
