// CheckpointWriter: puts the checkpoints of a cluster together. The server's own part comes from the thread that sends
// the state, the parts of engines and hosts from the bus; the main thread of the space_server program writes the files
// while the run goes on.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/server_session.h"
#include "common/checkpoint/checkpoint.h"
#include "space_server/space_server.h"

namespace swarmanoid
{

class CheckpointWriter
{
public:
  // `parts`: the processes that save one. `first_tick`: where the run starts. `changed`: a checkpoint is complete;
  // called from any thread.
  CheckpointWriter(ServerSession& session, const Experiment& experiment, std::vector<std::string> parts,
                   std::uint64_t first_tick, const std::string& folder, std::function<void()> changed);

  // The state of the server's tick goes out now. Throws std::runtime_error if it cannot be saved.
  void Sending(const SpaceServer& server);
  // Main thread: writes what is complete. Throws std::runtime_error.
  void Work();
  // Ticks of checkpoints that the server gave its part of, and others not.
  std::vector<std::uint64_t> Incomplete() const;

private:
  void Arrived(const SavedStateMessage& message);
  bool IsDue(std::uint64_t tick) const;
  bool IsComplete(const Checkpoint& checkpoint) const;

  std::uint64_t every_;
  std::uint64_t run_;
  CheckpointOrigin origin_;
  std::vector<std::string> parts_;
  std::string folder_;
  std::function<void()> changed_;
  mutable std::mutex mutex_;                        // of what follows
  std::map<std::uint64_t, Checkpoint> unfinished_;  // by tick
  std::uint64_t sent_;                              // the last tick of which the server gave its part, or the first
  std::unique_ptr<Subscription<SavedStateMessage>> states_in_;
};

}  // namespace swarmanoid
