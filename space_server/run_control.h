// RunControl: executes what users ask of a running experiment, and decides when the next tick may start. The verbs are
// rows of common/messages/control_verbs.h; the table of their actions is in run_control.cpp. Changes of the experiment
// are written to the event log and can be repeated in another run. Requests come from any thread; everything else is
// called by the thread that paces the run, in a cluster the main thread of the space_server program.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/run/run_summary.h"
#include "idl/control_request_message.h"
#include "space_server/event_log.h"
#include "space_server/space_changes.h"
#include "space_server/space_server.h"
#include "space_server/worker_placement.h"

namespace swarmanoid
{

struct RunControlSetup
{
  bool paused = false;                  // whether the run starts paused
  double real_time_factor = 0;          // 0: as fast as possible
  std::string event_log;                // file for users' requests; empty: none
  std::vector<RecordedEvent> repeated;  // events of an earlier run that are repeated
  // The run resumes after its space server has died. `repeated` then has the changes of the dead server.
  bool goes_on = false;
  std::uint64_t asked_from = 0;                 // earlier ticks are computed again, without new requests
  std::uint64_t pause_at = 0;                   // 0: the run does not pause
  std::optional<ControlRequestMessage> step{};  // the step that ends there
  std::vector<RecordedFault> failed{};          // failures of controllers that the log of events has already
  WorkerPlacement places{};
  bool may_reset = false;  // the launcher starts the run again if a user asks for a reset
  // Replaces a worker by another process.
  std::function<void(const WorkerPlacement::Move&)> move{};
  // Starts all processes again, with controller hosts on these machines. Empty if that is not possible.
  std::function<void(const std::vector<std::string>& machines)> rebalance{};
};

class RunControl
{
public:
  using Clock = std::chrono::steady_clock;
  // The thread that paces the run calls it with the result of a request.
  using Answer =
      std::function<void(const ControlRequestMessage& request, bool done, std::uint64_t tick, const std::string& text)>;

  struct Decision
  {
    bool go = false;
    std::uint64_t until = 0;               // with go: hold before this tick is sent; 0: run on
    std::optional<Clock::time_point> due;  // without go: the time of the next tick, unless paused
  };

  RunControl(const Experiment& experiment, RunControlSetup setup, Answer answer);

  // Takes a request. Any thread may call it.
  void Ask(const ControlRequestMessage& request);
  // Writes a line of the event log for a request that was executed elsewhere, or for a note. Any thread may call it.
  void Note(const ControlRequestMessage& request);

  // Logs failed controllers of a run that goes on. Any thread may call it.
  void Failed(const std::vector<RecordedFault>& faults);

  // A process has replaced a worker, on that machine. It may be another machine than requested if the worker could not
  // start there.
  void Arrived(const WorkerPlacement::Move& worker, const std::string& process, std::uint64_t tick);

  // Allows the first tick to start.
  void Start(std::uint64_t tick, Clock::time_point now);
  // Returns true if the run must hold before the next state is sent, because of pending requests or a limited pace.
  bool WantsHold() const;
  // Carries out the requests while the server is between two ticks. Throws ConfigurationError if an event of an earlier
  // run cannot be repeated.
  void Work(SpaceServer& server);
  Decision Decide(std::uint64_t tick, Clock::time_point now);
  // Ends the run at its current tick. `who` is the sender of the request, for the log of events.
  void Stop(const std::string& who);
  // The run ends at `tick` already, because one of its visualisers asked for the end.
  void Stopped(std::uint64_t tick, const std::string& who);
  bool Paused() const { return paused_ && !stop_; }
  double Speed() const { return real_time_factor_; }
  // Returns "stopped by <who>", or an empty text if no user asked for the end.
  const std::string& WhyStopped() const { return why_stopped_; }
  // Returns the request to start the run again, if a user made one.
  const std::optional<ResetRequest>& Reset() const { return reset_; }
  // Replies to clients that still wait for the end of a step.
  void Ended(std::uint64_t tick);

private:
  // A request that is being executed between two ticks.
  struct Execution
  {
    const ControlRequestMessage& request;
    SpaceServer& server;
    std::uint64_t tick;
    bool logged = false;  // the event log has it already
  };
  // Throws std::invalid_argument with the reason if the request is refused.
  using Action = void (RunControl::*)(const Execution&);
  static Action ActionOf(const std::string& verb);

  void Repeat(SpaceServer& server);
  void Execute(const ControlRequestMessage& request, SpaceServer& server);
  // Writes the event and replies. `written` is the request as another run repeats it.
  void Done(const Execution& execution, const std::string& text);
  void Done(const Execution& execution, const ControlRequestMessage& written, const std::string& text);

  void Pause(const Execution& execution);
  void Resume(const Execution& execution);
  void Step(const Execution& execution);
  void SetSpeed(const Execution& execution);
  void StopRun(const Execution& execution);
  void ResetRun(const Execution& execution);
  template <SpaceChange (*Read)(const ControlOrder&, const CSwarmanoidSpace&)>
  void ChangeSpace(const Execution& execution);
  template <bool kPressed>
  void PressKey(const Execution& execution);
  void Select(const Execution& execution);
  template <std::vector<WorkerPlacement::Move> (WorkerPlacement::*Read)(const ControlOrder&) const>
  void MoveWorkers(const Execution& execution);
  void Rebalance(const Execution& execution);
  void ListMachines(const Execution& execution);
  void RequireNoMove() const;
  void WriteNotes(std::uint64_t tick);
  void WriteDeviceFaults(const CSwarmanoidSpace& space);
  void DropStep(std::uint64_t tick, const char* why);
  void SetPace(std::uint64_t tick, Clock::time_point now);

  const Experiment& experiment_;
  Answer answer_;
  EventLog event_log_;
  std::vector<RecordedEvent> repeated_;
  std::size_t next_repeated_ = 0;
  std::uint64_t asked_from_;
  mutable std::mutex mutex_;  // guards requests_, notes_ and faults_
  std::vector<ControlRequestMessage> requests_;
  std::vector<ControlRequestMessage> notes_;  // for the event log
  std::vector<RecordedFault> faults_;         // faults that are not logged yet

  std::vector<RecordedFault> logged_faults_;
  // The beginnings and ends of device faults, by tick.
  std::vector<std::pair<std::uint64_t, ControlRequestMessage>> device_faults_;
  std::size_t next_device_fault_ = 0;
  bool paused_;
  bool stop_ = false;
  std::optional<std::string> stop_unlogged_;  // the user who asked
  std::string why_stopped_;
  bool may_reset_;
  std::optional<ResetRequest> reset_;
  double real_time_factor_;
  std::uint64_t pause_at_ = 0;  // tick at which a step ends; 0: none
  std::optional<ControlRequestMessage> step_;
  WorkerPlacement places_;
  std::function<void(const WorkerPlacement::Move&)> move_;
  std::function<void(const std::vector<std::string>&)> rebalance_;
  std::optional<ControlRequestMessage> move_request_;
  std::set<std::string> moving_;  // workers that have not arrived yet
  std::string moved_;             // the workers that have arrived, for the reply
  bool pace_changed_ = false;
  std::uint64_t pace_tick_ = 0;
  Clock::time_point pace_start_;
};

}  // namespace swarmanoid
