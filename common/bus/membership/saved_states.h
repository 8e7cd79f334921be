// The workers' side of checkpoints: sends the server the state of a role at the ticks of a checkpoint. engine_worker
// and controller_host use it, in the threads of the bus that step the role.
#pragma once

#include <optional>
#include <string>

#include "common/bus/membership/worker_session.h"
#include "common/serialisation/bytes.h"
#include "common/serialisation/save_check.h"

namespace swarmanoid
{

class SavedStates
{
public:
  // Tries once whether the role can be saved. If the run takes checkpoints, a failure throws the exception of the
  // role's SaveState. If it only keeps a journal, a replacement of this process starts at the beginning of the run.
  template <class Role>
  SavedStates(WorkerSession& session, const std::string& name, const Role& role) : session_(session), name_(name)
  {
    if (session.World().checkpoint_every == 0 && (!session.World().recorded || !CanSave(role))) return;
    TrySaving(role);
    publisher_.emplace(session.GetBus(), session.World().experiment);
  }

  // Returns whether the server's reader is matched.
  bool Matched() const { return !publisher_ || publisher_->Readers() >= 1; }
  // Saves the role, which is about to step at `tick`. `wanted`: MessageHeader::save of the step.
  template <class Role>
  void Ready(std::uint64_t tick, const Role& role, bool wanted)
  {
    if (!publisher_ || !wanted) return;
    ByteWriter state;
    role.SaveState(state);
    publisher_->Write({session_.World().run, tick, name_, state.Bytes()});
  }
  // Waits until the server has received all states.
  void Flush()
  {
    if (publisher_) publisher_->WaitUntilRead(10);
  }

private:
  template <class Role>
  static bool CanSave(const Role& role)
  {
    try
    {
      TrySaving(role);
      return true;
    }
    catch (const std::exception&)
    {
      return false;
    }
  }

  WorkerSession& session_;
  std::string name_;
  std::optional<Publisher<SavedStateMessage>> publisher_;
};

}  // namespace swarmanoid
