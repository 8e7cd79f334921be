// Lockstep: the space server's side of the ticks. It sends the state of a tick, collects what engines, hosts and
// visualisers answer, and lets the role make the next state. It runs in the threads of the bus and stops before a tick
// where the main thread asks for it (pause, pace, commands). Only the space_server program uses it.
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
  // `watch`, if given, is called in the main thread before the state of a tick is sent. `journal`, if given, gets all
  // inputs of the processes at a tick. `restart_point`, if given, is the point at which the run resumes. `stopped` is
  // called in a thread of the bus when the main thread must act: the tick is held, or the run failed.
  Lockstep(ServerSession& session, SpaceServer& server, const Assignment& assignment, bool visualisations,
           const std::string& hash_log, std::function<void(SpaceServer&)> watch, CheckpointWriter& checkpoints,
           JournalWriter* journal, const RestartPoint* restart_point, std::function<void()> stopped);
  ~Lockstep();

  // Returns true once the topics of all workers have matched those of the server.
  bool AllMatched() const;

  // The main thread calls the functions below.

  // Returns whether the run is held between two ticks: the state of Tick() is made, but not sent.
  bool Held() const;
  std::uint64_t Tick() const;
  // Sends the state that is held and runs on until tick `until`, or without end if `until` is 0.
  void Go(std::uint64_t until);
  // Asks the run to hold before the next state is sent.
  void Hold();
  // Sends the last state again, because an answer is late, and the state before if a process may lack it.
  void Repeat();
  // Returns whether the last state has been sent.
  bool Finished() const;
  // Returns the name of the visualiser that asked for the end, if one did.
  std::optional<std::string> Terminator() const;
  std::optional<std::string> Failure() const;
  // Closes the hash log after the last state. Throws if lines of it are lost.
  void CloseHashLog();
  // Returns the names of the processes whose answer to the current tick is missing.
  std::vector<std::string> Missing() const;
  struct Present
  {
    TickRecord record;     // the tick that the run waits at, without its commands
    bool is_done = false;  // engines may use the dead host's answer to it, so the new host computes it before it joins
  };
  // Another process, of that incarnation, replaces `name`. The run does not continue to the next tick without its
  // answer or, if the server does not hear it, before Return.
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
  bool MayBeDone(const std::string& name) const;
  bool IsUnheard(const std::string& name) const;
  // Continues if the answers to the tick are complete.
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
  std::vector<std::uint32_t> hosts_;  // numbers of the hosts that the server hears
  std::size_t visualisers_ = 0;
  unsigned workers_ = 0;
  TickGate gate_;
  // Replaced hosts that the server does not hear, with the incarnations of their replacements.
  std::map<std::string, std::uint32_t> away_;
  std::vector<EngineUpdate> updates_;
  std::vector<const EngineUpdate*> updates_here_;
  std::array<std::vector<ControlCommands>, 2> commands_;  // commands of all hosts, for even and odd ticks
  std::vector<const ControlCommands*> commands_here_;
  std::vector<DrawnMessage> drawn_;
  std::vector<SensorFrame> first_frames_;  // frames of the first tick; empty unless the run resumes
  std::vector<SensorFrame> frames_;        // frames of all engines, for the current tick
  const SpaceState* sent_ = nullptr;
  bool saves_ = false;                  // the sent state asks the processes to save their states
  const SpaceState* before_ = nullptr;  // the state of the tick before
  bool before_saves_ = false;
  bool held_ = true;
  bool hold_ = false;
  std::uint64_t until_ = 0;
  bool finished_ = false;
  std::optional<std::string> terminator_;
  std::optional<std::string> failure_;
  HashLog hash_log_;
  HotPublisher<SpaceState> states_;
  LocalStates local_states_;
  std::optional<HotSubscription<EngineUpdate>> updates_in_;
  std::optional<HotSubscription<ControlCommands>> commands_in_;
  std::optional<HotSubscription<DrawnMessage>> drawn_in_;
};

}  // namespace swarmanoid
