// CheckpointWriter: decides when the processes of a cluster save their states, and puts checkpoints together from them.
// The thread that sends the state gives the server's own part; the bus delivers the parts of engines and hosts. All
// parts go into the journal unchanged. The main thread of the space_server program writes checkpoint files during the
// run.
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
  // `parts`: the processes that save a part. `first_tick`: the tick at which the run starts or resumes. `saved`:
  // earlier ticks, whose states processes may send again. `changed`: called in any thread when a checkpoint is
  // complete.
  CheckpointWriter(ServerSession& session, const Experiment& experiment, std::vector<std::string> parts,
                   std::uint64_t first_tick, std::set<std::uint64_t> saved, const std::string& folder,
                   JournalWriter* journal, std::function<void()> changed);

  // The state of the server's tick is about to be sent. Saves the server's part if it is due, and returns whether the
  // state asks all processes to save theirs after its step. Throws std::runtime_error if the server cannot be saved.
  bool Sending(const SpaceServer& server);
  // Returns whether all save their states before they step at the tick.
  bool IsWanted(std::uint64_t tick) const;
  // Writes the complete checkpoints, in the main thread. Throws std::runtime_error.
  void Work();
  // Returns the ticks of checkpoints that lack the part of a process other than the server.
  std::vector<std::uint64_t> Incomplete() const;

private:
  using Clock = RunClock;

  void Save(const SpaceServer& server);
  void Arrived(const SavedStateMessage& message);
  // Returns whether the run takes a checkpoint at the tick.
  bool IsOfFile(std::uint64_t tick) const;
  bool IsComplete(const Checkpoint& checkpoint) const;

  std::uint64_t every_;
  std::uint64_t period_;  // period in ticks at which states can be saved
  std::uint64_t run_;
  std::uint64_t first_tick_;
  CheckpointOrigin origin_;
  std::vector<std::string> parts_;
  std::string folder_;
  JournalWriter* journal_;
  std::function<void()> changed_;
  mutable std::mutex mutex_;                        // guards the members below
  std::map<std::uint64_t, Checkpoint> unfinished_;  // by tick
  std::set<std::uint64_t> wanted_;                  // the last ticks at which all processes save their states
  Clock::time_point saved_;                         // time of the last saved state of the server
  std::unique_ptr<Subscription<SavedStateMessage>> states_in_;
};

}  // namespace swarmanoid
