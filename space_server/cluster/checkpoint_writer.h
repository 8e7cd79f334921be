// CheckpointWriter: decides when the processes of a cluster save their states, and puts checkpoints together from them.
// The server's own part comes from the thread that sends the state, the parts of engines and hosts from the bus; all go
// into the journal as they are, and the main thread of the space_server program writes the files of checkpoints while
// the run goes on.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/bus/membership/server_session.h"
#include "common/checkpoint/checkpoint.h"
#include "common/journal/journal_writer.h"
#include "common/threads/waiting.h"

namespace swarmanoid
{

class SpaceServer;

class CheckpointWriter
{
public:
  // `parts`: the processes that save one. `first_tick`: where the run starts or goes on. `saved`: ticks before of which
  // processes may say again what they saved. `changed`: a checkpoint is complete; called from any thread.
  CheckpointWriter(ServerSession& session, const Experiment& experiment, std::vector<std::string> parts,
                   std::uint64_t first_tick, std::set<std::uint64_t> saved, const std::string& folder,
                   JournalWriter* journal, std::function<void()> changed);

  // The state of the server's tick goes out now. Whether it asks for the states of all after its step. Throws
  // std::runtime_error if the server cannot be saved.
  bool Sending(const SpaceServer& server);
  // Whether all save their states before they step at the tick.
  bool IsWanted(std::uint64_t tick) const;
  // Main thread: writes what is complete. Throws std::runtime_error.
  void Work();
  // Ticks of checkpoints that the server gave its part of, and others not.
  std::vector<std::uint64_t> Incomplete() const;

private:
  using Clock = RunClock;

  void Save(const SpaceServer& server);
  void Arrived(const SavedStateMessage& message);
  // Whether the run takes a checkpoint at the tick.
  bool IsOfFile(std::uint64_t tick) const;
  bool IsComplete(const Checkpoint& checkpoint) const;

  std::uint64_t every_;
  std::uint64_t period_;  // of the ticks at which states can be saved
  std::uint64_t run_;
  std::uint64_t first_tick_;
  CheckpointOrigin origin_;
  std::vector<std::string> parts_;
  std::string folder_;
  JournalWriter* journal_;
  std::function<void()> changed_;
  mutable std::mutex mutex_;                        // of what follows
  std::map<std::uint64_t, Checkpoint> unfinished_;  // by tick
  std::set<std::uint64_t> wanted_;                  // ticks of which all shall save their states, the last ones
  Clock::time_point saved_;                         // when the server was last saved
  std::unique_ptr<Subscription<SavedStateMessage>> states_in_;
};

}  // namespace swarmanoid
