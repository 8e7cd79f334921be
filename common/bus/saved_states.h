// The workers' side of checkpoints: tells the server what a role remembers at the ticks that the run takes them. Used
// by engine_worker and controller_host in the threads of the bus that step the role.
#pragma once

#include <optional>
#include <string>

#include "common/bus/worker_session.h"
#include "common/serialisation/bytes.h"
#include "common/serialisation/trial.h"

namespace swarmanoid
{

class SavedStates
{
public:
  // Tries once whether the role can be saved: what cannot be is said before the first tick. Throws what its SaveState
  // throws.
  template <class Role>
  SavedStates(WorkerSession& session, const std::string& name, const Role& role)
      : session_(session), name_(name), every_(session.World().checkpoint_every)
  {
    if (every_ == 0) return;
    publisher_.emplace(session.GetBus(), session.World().experiment);
    TrySaving(role);
  }

  // Whether the server is there.
  bool Matched() const { return !publisher_ || publisher_->Readers() >= 1; }
  // The role has stepped and is about to step at `tick`.
  template <class Role>
  void Ready(std::uint64_t tick, const Role& role)
  {
    if (!publisher_ || tick % every_ != 0) return;
    ByteWriter state;
    role.SaveState(state);
    publisher_->Write({session_.World().run, tick, name_, state.Bytes()});
  }
  // Waits until the server has got all.
  void Flush()
  {
    if (publisher_) publisher_->WaitUntilRead(10);
  }

private:
  WorkerSession& session_;
  std::string name_;
  std::uint64_t every_;
  std::optional<Publisher<SavedStateMessage>> publisher_;
};

}  // namespace swarmanoid
