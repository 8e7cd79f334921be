// Requests come from any thread and wait in a queue. The thread that paces the run asks WantsHold, stops before the
// next tick, and carries them out there (Work). So each takes effect at one tick, and can be repeated from the log of
// events. The pace counts from the last change of it: tick n is due at its simulated time since then, divided by the
// real-time factor.
//
// Invariants: each request is answered, at the latest when the run ends, or by the next server if all processes start
// again; a change is in the log before its answer is sent; events of a repeated log come before new requests of the
// same tick.
#include "space_server/run_control.h"

#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <stdexcept>

#include "common/configuration/configuration_tree.h"
#include "common/messages/control_verbs.h"
#include "common/space/space.h"

namespace swarmanoid
{

RunControl::RunControl(const Experiment& experiment, RunControlSetup setup, Answer answer)
    : experiment_(experiment),
      answer_(std::move(answer)),
      event_log_(std::move(setup.event_log), setup.goes_on),
      repeated_(std::move(setup.repeated)),
      asked_from_(setup.asked_from),
      logged_faults_(std::move(setup.failed)),
      paused_(setup.paused),
      may_reset_(setup.may_reset),
      real_time_factor_(setup.real_time_factor),
      pause_at_(setup.pause_at),
      step_(std::move(setup.step)),
      places_(std::move(setup.places)),
      move_(std::move(setup.move)),
      rebalance_(std::move(setup.rebalance))
{
  for (const FaultConfiguration& fault : experiment.faults)
  {
    const auto add = [&](std::uint64_t tick, const char* what)
    {
      const std::string text = fmt::format("{}: {} of {}; robots: {}", what, fault.kind_name,
                                           fault.device.empty() ? "all" : fault.device, fault.entities.size());
      device_faults_.emplace_back(tick, NoteOf(kDeviceFault, fault.id, text));
    };
    add(fault.from, "begins");
    if (fault.to != 0) add(fault.to, "ends");
  }
  std::ranges::stable_sort(device_faults_, {}, [](const auto& event) { return event.first; });
}

void RunControl::Ask(const ControlRequestMessage& request)
{
  const std::lock_guard lock(mutex_);
  requests_.push_back(request);
}

void RunControl::Note(const ControlRequestMessage& request)
{
  const std::lock_guard lock(mutex_);
  notes_.push_back(request);
}

void RunControl::Failed(const std::vector<RecordedFault>& faults)
{
  const std::lock_guard lock(mutex_);
  faults_.insert(faults_.end(), faults.begin(), faults.end());
}

void RunControl::WriteNotes(std::uint64_t tick)
{
  std::vector<RecordedFault> faults;
  std::vector<ControlRequestMessage> notes;
  {
    const std::lock_guard lock(mutex_);
    faults.swap(faults_);
    // Ticks before are computed again, and their lines are in the log already.
    if (tick >= asked_from_) notes.swap(notes_);
  }
  for (const RecordedFault& fault : faults)
  {
    // The tick is computed again: the fault is in the log.
    if (std::find(logged_faults_.begin(), logged_faults_.end(), fault) != logged_faults_.end()) continue;
    const EntityConfiguration& entity = experiment_.entities[fault.robot];
    const ControlRequestMessage event =
        NoteOf(kFailedController, entity.id,
               fmt::format("controller '{}' {}{}{}", entity.controller, FaultText(fault.kind),
                           fault.text.empty() ? "" : ": ", fault.text));
    event_log_.Write(fault.tick, event);
    answer_(event, false, fault.tick, fmt::format("'{}' at tick {}: its {}", entity.id, fault.tick, event.client));
  }
  for (const ControlRequestMessage& note : notes) event_log_.Write(tick, note);
}

// After BeginAgain, ticks of faults are no longer those of the run.
void RunControl::WriteDeviceFaults(const CSwarmanoidSpace& space)
{
  const std::uint64_t tick = space.GetTick();
  for (; next_device_fault_ < device_faults_.size(); ++next_device_fault_)
  {
    const auto& [at, event] = device_faults_[next_device_fault_];
    if (at > tick) return;
    if (at == tick && tick >= asked_from_ && space.FirstTick() == 0) event_log_.Write(tick, event);
  }
}

void RunControl::Start(std::uint64_t tick, Clock::time_point now) { SetPace(tick, now); }

void RunControl::SetPace(std::uint64_t tick, Clock::time_point now)
{
  pace_tick_ = tick;
  pace_start_ = now;
  pace_changed_ = false;
}

bool RunControl::WantsHold() const
{
  if (stop_ || paused_ || !moving_.empty()) return true;
  const std::lock_guard lock(mutex_);
  return !requests_.empty() || !faults_.empty() || !notes_.empty();
}

void RunControl::Stop(const std::string& who)
{
  if (stop_) return;
  stop_ = true;
  stop_unlogged_ = who;
  why_stopped_ = who.empty() ? "stopped" : "stopped by " + who;
}

void RunControl::Stopped(std::uint64_t tick, const std::string& who)
{
  WriteNotes(tick);
  event_log_.Write(tick, NoteOf("stop", "", who));
}

void RunControl::Work(SpaceServer& server)
{
  const std::uint64_t tick = server.Space().GetTick();
  WriteNotes(tick);
  WriteDeviceFaults(server.Space());
  if (pause_at_ != 0 && tick >= pause_at_)
  {
    pause_at_ = 0;
    paused_ = true;
    if (step_) answer_(*step_, true, tick, fmt::format("paused at tick {}", tick));
    step_.reset();
  }
  Repeat(server);
  std::vector<ControlRequestMessage> requests;
  if (tick >= asked_from_)
  {
    const std::lock_guard lock(mutex_);
    requests.swap(requests_);
  }
  for (const ControlRequestMessage& request : requests) Execute(request, server);
  if (!stop_) return;
  if (stop_unlogged_ && !server.IsLast()) Stopped(tick, *stop_unlogged_);
  stop_unlogged_.reset();
  server.Finish();
}

// Repeats events before requests of this run at the same tick.
void RunControl::Repeat(SpaceServer& server)
{
  const std::uint64_t tick = server.Space().GetTick();
  for (; next_repeated_ < repeated_.size() && repeated_[next_repeated_].tick <= tick; ++next_repeated_)
  {
    const RecordedEvent& event = repeated_[next_repeated_];
    if (event.tick < tick) continue;
    const bool ends = FindControlVerb(event.request.verb)->effect == Effect::kEnd;
    if (ends && !event.logged)
    {
      // Another run ended there, or was reset: this one has come as far as that one.
      Stop(event.request.client);
      continue;
    }
    try
    {
      (this->*ActionOf(event.request.verb))({event.request, server, tick, event.logged});
    }
    catch (const std::invalid_argument& error)
    {
      throw ConfigurationError(event.location, fmt::format("{}: {}", event.request.verb, error.what()));
    }
  }
}

void RunControl::Execute(const ControlRequestMessage& request, SpaceServer& server)
{
  const std::uint64_t tick = server.Space().GetTick();
  std::string error = OrderError(request, Asker::kMember);
  try
  {
    if (error.empty()) return (this->*ActionOf(request.verb))({request, server, tick});
  }
  catch (const std::invalid_argument& refusal)
  {
    error = fmt::format("{}: {}", request.verb, refusal.what());
  }
  answer_(request, false, tick, error);
}

void RunControl::Done(const Execution& execution, const std::string& text) { Done(execution, execution.request, text); }

void RunControl::Done(const Execution& execution, const ControlRequestMessage& written, const std::string& text)
{
  const bool changes = FindControlVerb(written.verb)->effect != Effect::kQuery;
  if (changes && !execution.logged) event_log_.Write(execution.tick, written);
  answer_(execution.request, true, execution.tick, text);
}

// ---- The actions, and the table of them. ----

RunControl::Action RunControl::ActionOf(const std::string& verb)
{
  static const std::map<std::string_view, Action> actions{
      {"pause", &RunControl::Pause},
      {"resume", &RunControl::Resume},
      {"step", &RunControl::Step},
      {"speed", &RunControl::SetSpeed},
      {"stop", &RunControl::StopRun},
      {"reset", &RunControl::ResetRun},
      {"move", &RunControl::ChangeSpace<ReadMove>},
      {"detach", &RunControl::ChangeSpace<ReadDetachment>},
      {"add", &RunControl::ChangeSpace<ReadAddition>},
      {"remove", &RunControl::ChangeSpace<ReadRemoval>},
      {"press", &RunControl::PressKey<true>},
      {"release", &RunControl::PressKey<false>},
      {"select", &RunControl::Select},
      {"deselect", &RunControl::Select},
      {"move-host", &RunControl::MoveWorkers<&WorkerPlacement::ReadHostMove>},
      {"move-engine", &RunControl::MoveWorkers<&WorkerPlacement::ReadEngineMove>},
      {"drain", &RunControl::MoveWorkers<&WorkerPlacement::ReadDrain>},
      {"hosts", &RunControl::Rebalance},
      {"machines", &RunControl::ListMachines}};
  return actions.at(verb);
}

void RunControl::Pause(const Execution& execution)
{
  DropStep(execution.tick, "a pause was asked for");
  paused_ = true;
  pause_at_ = 0;
  Done(execution, fmt::format("paused at tick {}", execution.tick));
}

void RunControl::Resume(const Execution& execution)
{
  DropStep(execution.tick, "to go on was asked for");
  paused_ = false;
  pause_at_ = 0;
  pace_changed_ = true;
  Done(execution, fmt::format("resumed at tick {}", execution.tick));
}

// Replies at the end of the step.
void RunControl::Step(const Execution& execution)
{
  const auto ticks = execution.request.Get<std::int64_t>("ticks", 1);
  DropStep(execution.tick, "another step was asked for");
  step_ = execution.request;
  event_log_.Write(execution.tick, execution.request);
  pause_at_ = execution.tick + static_cast<std::uint64_t>(ticks);
  paused_ = false;
  pace_changed_ = true;
}

void RunControl::SetSpeed(const Execution& execution)
{
  real_time_factor_ = execution.request.Get<double>("factor");
  pace_changed_ = true;
  Done(execution, real_time_factor_ == 0 ? std::string("as fast as possible")
                                         : fmt::format("{:g} times real time", real_time_factor_));
}

void RunControl::StopRun(const Execution& execution)
{
  stop_ = true;
  why_stopped_ = execution.request.client.empty() ? "stopped" : "stopped by " + AskerOf(execution.request);
  Done(execution, fmt::format("stopped at tick {}", execution.tick));
}

void RunControl::ResetRun(const Execution& execution)
{
  if (!may_reset_)
    throw std::invalid_argument(
        "nothing would start this run again; `swarmanoid run` does, for runs without a program of the user's own "
        "around them");
  ControlRequestMessage written = execution.request;
  const auto seed = written.Get<std::int64_t>("seed", static_cast<std::int64_t>(experiment_.seed));
  written.Set("seed", seed);
  stop_ = true;
  why_stopped_ = fmt::format("reset by {}", AskerOf(written));
  reset_ = ResetRequest{static_cast<std::uint64_t>(seed), paused_ || pause_at_ != 0, real_time_factor_};
  Done(execution, written, fmt::format("reset at tick {}: it begins again with seed {}", execution.tick, seed));
}

template <SpaceChange (*Read)(const ControlOrder&, const CSwarmanoidSpace&)>
void RunControl::ChangeSpace(const Execution& execution)
{
  const SpaceChange change = Read(execution.request, execution.server.Space());
  execution.server.Move(change.moves);
  // The event names the entity that was taken from a reserve, so that a repetition takes the same one.
  ControlRequestMessage written = execution.request;
  written.Set("entity", change.entity);
  Done(execution, written, fmt::format("{} at tick {}", change.done, execution.tick));
}

template <bool kPressed>
void RunControl::PressKey(const Execution& execution)
{
  const auto key = execution.request.Get<std::string>("key");
  execution.server.PressKey(key, kPressed);
  Done(execution, fmt::format("key {} {} at tick {}", key, kPressed ? "pressed" : "released", execution.tick));
}

// Without an entity nothing is selected.
void RunControl::Select(const Execution& execution)
{
  const auto entity = execution.request.Get<std::string>("entity");
  execution.server.Select(entity);
  Done(execution, fmt::format("selected {} at tick {}", entity.empty() ? "none" : "'" + entity + "'", execution.tick));
}

void RunControl::RequireNoMove() const
{
  if (moving_.empty()) return;
  throw std::invalid_argument(fmt::format("{} is on the way already; ask again when it has arrived", *moving_.begin()));
}

// Replies when all workers have arrived; the run holds until then.
template <std::vector<WorkerPlacement::Move> (WorkerPlacement::*Read)(const ControlOrder&) const>
void RunControl::MoveWorkers(const Execution& execution)
{
  RequireNoMove();
  const std::vector<WorkerPlacement::Move> moves = (places_.*Read)(execution.request);
  if (moves.empty()) return Done(execution, "no worker is at " + execution.request.Get<std::string>("machine"));
  event_log_.Write(execution.tick, execution.request);
  move_request_ = execution.request;
  moved_.clear();
  for (const WorkerPlacement::Move& move : moves) moving_.insert(move.worker);
  for (const WorkerPlacement::Move& move : moves) move_(move);
}

// All processes start again, this one too: the next server replies.
void RunControl::Rebalance(const Execution& execution)
{
  RequireNoMove();
  constexpr std::ptrdiff_t kMostHosts = 1000;
  const auto robots = std::count_if(experiment_.entities.begin(), experiment_.entities.end(),
                                    [](const EntityConfiguration& entity) { return !entity.controller.empty(); });
  const std::vector<std::string> machines =
      places_.ReadHosts(execution.request, static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(robots, 1, kMostHosts)));
  if (!rebalance_)
    throw std::invalid_argument(
        "all processes start again for it, and the space server cannot: it is in the process of a user");
  event_log_.Write(execution.tick, execution.request);
  move_request_ = execution.request;
  moving_.insert("every process");
  rebalance_(machines);
}

void RunControl::ListMachines(const Execution& execution) { Done(execution, places_.Text()); }

void RunControl::Arrived(const WorkerPlacement::Move& worker, const std::string& process, std::uint64_t tick)
{
  places_.Put(worker);
  if (moving_.erase(worker.worker) == 0) return;
  moved_ += fmt::format("{}{} is process {} now", moved_.empty() ? "" : ", ", worker.worker, process);
  if (!moving_.empty()) return;
  answer_(*move_request_, true, tick, fmt::format("{}, at tick {}", moved_, tick));
  move_request_.reset();
  pace_changed_ = true;
}

void RunControl::DropStep(std::uint64_t tick, const char* why)
{
  if (step_) answer_(*step_, false, tick, fmt::format("the step ended at tick {}: {}", tick, why));
  step_.reset();
}

RunControl::Decision RunControl::Decide(std::uint64_t tick, Clock::time_point now)
{
  Decision decision;
  if (stop_)
  {
    decision.go = true;
    return decision;
  }
  if (paused_ || !moving_.empty()) return decision;
  if (pace_changed_) SetPace(tick, now);
  if (real_time_factor_ > 0)
  {
    const double due_s = static_cast<double>(tick - pace_tick_) * experiment_.TickSeconds() / real_time_factor_;
    const auto due = pace_start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due_s));
    if (due > now)
    {
      decision.due = due;
      return decision;
    }
    decision.until = tick + 1;
  }
  else
  {
    decision.until = pause_at_;
    const auto hold_at = [&](std::uint64_t event)
    { decision.until = decision.until == 0 ? event : std::min(decision.until, event); };
    if (next_repeated_ < repeated_.size()) hold_at(repeated_[next_repeated_].tick);
    if (next_device_fault_ < device_faults_.size()) hold_at(device_faults_[next_device_fault_].first);
  }
  decision.go = true;
  return decision;
}

void RunControl::Ended(std::uint64_t tick)
{
  WriteNotes(tick);
  if (step_) answer_(*step_, true, tick, RunEndedText(tick));
  if (move_request_) answer_(*move_request_, false, tick, RunEndedText(tick));
  const std::lock_guard lock(mutex_);
  for (const ControlRequestMessage& request : requests_) answer_(request, false, tick, RunEndedText(tick));
  requests_.clear();
}

}  // namespace swarmanoid
