// Lockstep: the space server's side of the ticks. It sends the state of a tick, collects what engines, hosts and
// visualisers answer, and lets the role make the next state. It runs in the threads of the bus and stops before a tick
// where the main thread asks for it (pause, pace, commands). Used by the space_server program alone.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/membership/server_session.h"
#include "common/bus/membership/tick_gate.h"
#include "common/bus/membership/tick_limits.h"
#include "common/journal/journal_writer.h"
#include "common/run/hash_log.h"
#include "space_server/cluster/checkpoint_writer.h"
#include "space_server/cluster/local_states.h"
#include "space_server/cluster/restart_point.h"

namespace swarmanoid
{

class SpaceServer;

class Lockstep
{
public:
  // `watch`, if there is one: called in the main thread before the state of a tick goes out.
  // `journal`, if there is one: gets all that the processes of a tick took in.
  // `restart_point`, if there is one: the run goes on there.
  // `stopped`: called in a thread of the bus when the main thread has to act: the tick is held, or the run failed.
  Lockstep(ServerSession& session, SpaceServer& server, const Assignment& assignment, bool visualisations,
           const std::string& hash_log, std::function<void(SpaceServer&)> watch, CheckpointWriter& checkpoints,
           JournalWriter* journal, const RestartPoint* restart_point, std::function<void()> stopped);
  ~Lockstep();

  // Returns true once the topics of all workers have matched those of the server.
  bool AllMatched() const;

  // The main thread calls the functions below.

  // Between two ticks: the state of Tick() is made, but not sent.
  bool Held() const;
  std::uint64_t Tick() const;
  // Sends the state that is held and runs on until tick `until`, or without end if `until` is 0.
  void Go(std::uint64_t until);
  // Asks the run to hold before the next state is sent.
  void Hold();
  // An answer is late: sends the last state again.
  void Repeat();
  // The last state has gone out.
  bool Finished() const;
  // The name of the visualiser that asked for the end, if one did.
  std::optional<std::string> Terminator() const;
  std::optional<std::string> Failure() const;
  // After the last state. Throws if lines of it are lost.
  void CloseHashLog();
  // Returns the names of the processes whose answer to the current tick is missing.
  std::vector<std::string> Missing() const;
  struct Present
  {
    TickRecord record;     // of the tick that the run waits at, as far as it is known: no commands
    bool is_done = false;  // it has gone out to a process that the server does not hear, and may have been answered
  };
  // Another process, of that incarnation, takes the place of `name`. The run does not go on to the next tick without
  // its answer or, if the server does not hear it, before Return.
  Present Withdraw(const std::string& name, std::uint32_t incarnation);
  void Return(const std::string& name, std::uint32_t incarnation);
  // Calls `use` with the server between two steps.
  template <class Use>
  void WithServer(const Use& use)
  {
    const std::lock_guard lock(mutex_);
    use(server_);
  }

private:
  void Send(bool repeated);
  void Complete();
  std::span<const SensorFrame> Frames() const;
  // Writes a tick into the journal. The engines report the commands that the server did not receive itself. Afterwards
  // frames_ has the frames of the next tick.
  void Record(const SpaceState& state, bool saves, std::span<const SensorFrame> frames);
  template <class Message>
  Message* PlaceOf(const MessageHeader& header, std::uint64_t tick, std::optional<std::size_t> part, Message& place);
  void Arrived(const MessageHeader& header, std::size_t part, std::uint64_t tick);
  bool IsUnheard(const std::string& name) const;
  // If all is here.
  void GoOn();

  ServerSession& session_;
  mutable std::mutex mutex_;  // guards the members below
  SpaceServer& server_;
  CheckpointWriter& checkpoints_;
  JournalWriter* journal_;
  const Assignment& assignment_;
  TickLimits limits_;
  std::uint64_t first_tick_;
  std::function<void(SpaceServer&)> watch_;
  std::function<void()> stopped_;
  std::size_t engines_ = 0;
  std::vector<std::uint32_t> hosts_;  // that the server hears
  std::size_t visualisers_ = 0;
  unsigned workers_ = 0;
  TickGate gate_;
  std::map<std::string, std::uint32_t> away_;  // processes without contact, with the incarnations of their replacements
  std::vector<UpdateMessage> updates_;
  std::vector<const EngineUpdate*> updates_here_;
  std::array<std::vector<ControlCommands>, 2> commands_;  // of all hosts, at even and odd ticks
  std::vector<const ControlCommands*> commands_here_;
  std::vector<DrawnMessage> drawn_;
  std::vector<SensorFrame> first_frames_;  // of the first tick: none, unless the run goes on
  std::vector<SensorFrame> frames_;        // of all engines, for the tick
  const SpaceState* sent_ = nullptr;
  bool saves_ = false;  // the state asks for saved states
  bool held_ = true;
  bool hold_ = false;
  std::uint64_t until_ = 0;
  bool finished_ = false;
  std::optional<std::string> terminator_;
  std::optional<std::string> failure_;
  HashLog hash_log_;
  HotPublisher<SpaceState> states_;
  LocalStates local_states_;
  std::optional<HotSubscription<UpdateMessage>> updates_in_;
  std::optional<HotSubscription<ControlCommands>> commands_in_;
  std::optional<HotSubscription<DrawnMessage>> drawn_in_;
};

}  // namespace swarmanoid
