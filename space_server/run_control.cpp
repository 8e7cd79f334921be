#include "space_server/run_control.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/configuration/configuration_tree.h"
#include "common/messages/request_limits.h"
#include "common/space/space.h"
#include "space_server/space_changes.h"

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
      share_out_(std::move(setup.share_out))
{
}

void RunControl::Ask(const ControlRequestMessage& request)
{
  const std::lock_guard lock(mutex_);
  requests_.push_back(request);
}

void RunControl::Refused(const std::string& topic, const std::string& sender)
{
  ControlRequestMessage refused;
  refused.verb = kRefused;
  refused.entity = topic;
  refused.client = sender;
  Ask(refused);
}

void RunControl::Note(const ControlRequestMessage& request) { Ask(request); }

void RunControl::Failed(const std::vector<RecordedFault>& faults)
{
  const std::lock_guard lock(mutex_);
  faults_.insert(faults_.end(), faults.begin(), faults.end());
}

void RunControl::WriteFaults()
{
  std::vector<RecordedFault> faults;
  {
    const std::lock_guard lock(mutex_);
    faults.swap(faults_);
  }
  for (const RecordedFault& fault : faults)
  {
    // Of a tick that is done again.
    if (std::find(logged_faults_.begin(), logged_faults_.end(), fault) != logged_faults_.end()) continue;
    const EntityConfiguration& entity = experiment_.entities[fault.robot];
    ControlRequestMessage event;
    event.verb = kFailedController;
    event.entity = entity.id;
    event.client = fmt::format("controller '{}' {}{}{}", entity.controller, FaultText(fault.kind),
                               fault.text.empty() ? "" : ": ", fault.text);
    event_log_.Write(fault.tick, event);
    answer_(event, false, fault.tick, fmt::format("'{}' at tick {}: its {}", entity.id, fault.tick, event.client));
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
  return !requests_.empty() || !faults_.empty();
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
  WriteFaults();
  ControlRequestMessage request;
  request.verb = "stop";
  request.client = who;
  event_log_.Write(tick, request);
}

void RunControl::Work(SpaceServer& server)
{
  WriteFaults();
  const std::uint64_t tick = server.Space().GetTick();
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
  for (const ControlRequestMessage& request : requests) Carry(request, server);
  if (!stop_) return;
  if (stop_unlogged_ && !server.IsLast()) Stopped(tick, *stop_unlogged_);
  stop_unlogged_.reset();
  server.Finish();
}

// Before what users of this run ask at the same tick.
void RunControl::Repeat(SpaceServer& server)
{
  const std::uint64_t tick = server.Space().GetTick();
  for (; next_repeated_ < repeated_.size() && repeated_[next_repeated_].tick <= tick; ++next_repeated_)
  {
    const RecordedEvent& event = repeated_[next_repeated_];
    if (event.tick < tick) continue;
    if (event.request.verb == "stop")
    {
      Stop(event.request.client);
      if (event.logged) stop_unlogged_.reset();
      continue;
    }
    if (event.request.verb == "reset")
    {
      // Another run was reset there: this one has come as far as that one did.
      if (!event.logged)
        Stop(event.request.client);
      else
        BeginAgain(event.request, tick, true);
      continue;
    }
    try
    {
      if (IsInput(event.request.verb))
        HandOver(event.request, server, event.logged);
      else
        Change(event.request, server, event.logged);
    }
    catch (const std::invalid_argument& error)
    {
      throw ConfigurationError(event.location, error.what());
    }
  }
}

void RunControl::Change(const ControlRequestMessage& request, SpaceServer& server, bool logged)
{
  const std::uint64_t tick = server.Space().GetTick();
  const SpaceChange change = ReadSpaceChange(request, server.Space());
  server.Move(change.moves);
  // Of a reserve, the one that was taken: so a repetition does not depend on who waits.
  ControlRequestMessage done = request;
  done.entity = change.entity;
  if (!logged) event_log_.Write(tick, done);
  answer_(request, true, tick, fmt::format("{} at tick {}", change.done, tick));
}

void RunControl::HandOver(const ControlRequestMessage& request, SpaceServer& server, bool logged)
{
  const std::uint64_t tick = server.Space().GetTick();
  std::string done;
  if (request.verb == "select" || request.verb == "deselect")
  {
    const bool selects = request.verb == "select";
    if (selects && request.entity.empty()) throw std::invalid_argument("select needs an entity");
    server.Select(selects ? request.entity : std::string());
    done = selects ? fmt::format("selected '{}'", request.entity) : std::string("selected none");
  }
  else
  {
    server.PressKey(request.entity, request.verb == "press");
    done = fmt::format("key {} {}", request.entity, request.verb == "press" ? "pressed" : "released");
  }
  if (!logged) event_log_.Write(tick, request);
  answer_(request, true, tick, fmt::format("{} at tick {}", done, tick));
}

void RunControl::Carry(const ControlRequestMessage& request, SpaceServer& server)
{
  const std::uint64_t tick = server.Space().GetTick();
  const auto reply = [&](bool done, const std::string& text)
  {
    if (done) event_log_.Write(tick, request);
    answer_(request, done, tick, text);
  };
  const double number = request.numbers.empty() ? std::nan("") : request.numbers[0];

  if (IsOnlyNoted(request)) return event_log_.Write(tick, request);
  if (const std::string error = RequestLimitError(request); !error.empty()) return reply(false, error);
  if (request.verb == "pause")
  {
    DropStep(tick, "a pause was asked for");
    paused_ = true;
    pause_at_ = 0;
    reply(true, fmt::format("paused at tick {}", tick));
  }
  else if (request.verb == "resume")
  {
    DropStep(tick, "to go on was asked for");
    paused_ = false;
    pause_at_ = 0;
    pace_changed_ = true;
    reply(true, fmt::format("resumed at tick {}", tick));
  }
  else if (request.verb == "step")
  {
    const double count = request.numbers.empty() ? 1 : number;
    if (!(count >= 1 && count <= 1e15 && count == std::floor(count)))
      return reply(false, "step: the number of ticks must be a whole number from 1 on");
    DropStep(tick, "another step was asked for");
    step_ = request;
    event_log_.Write(tick, request);
    pause_at_ = tick + static_cast<std::uint64_t>(count);
    paused_ = false;
    pace_changed_ = true;
  }
  else if (request.verb == "speed")
  {
    if (!(number >= 0 && number <= 1e9))
      return reply(false, "speed: the factor must be 0 (as fast as possible) or more");
    real_time_factor_ = number;
    pace_changed_ = true;
    reply(true, number == 0 ? std::string("as fast as possible") : fmt::format("{:g} times real time", number));
  }
  else if (request.verb == "stop")
  {
    stop_ = true;
    why_stopped_ = request.client.empty() ? "stopped" : "stopped by " + AskerOf(request);
    reply(true, fmt::format("stopped at tick {}", tick));
  }
  else if (request.verb == "reset")
  {
    try
    {
      BeginAgain(request, tick);
    }
    catch (const std::invalid_argument& error)
    {
      reply(false, error.what());
    }
  }
  else if (request.verb == "machines")
  {
    try
    {
      answer_(request, true, tick, places_.Text());
    }
    catch (const std::invalid_argument& error)
    {
      answer_(request, false, tick, error.what());
    }
  }
  else if (IsWorkerMove(request.verb))
  {
    try
    {
      if (request.verb == "hosts")
        ShareOut(request, tick);
      else
        MoveWorkers(request, tick);
    }
    catch (const std::invalid_argument& error)
    {
      reply(false, error.what());
    }
  }
  else if (IsSpaceChange(request.verb) || IsInput(request.verb))
  {
    try
    {
      if (IsInput(request.verb))
        HandOver(request, server);
      else
        Change(request, server);
    }
    catch (const std::invalid_argument& error)
    {
      reply(false, error.what());
    }
  }
  else
    reply(false, fmt::format("unknown request '{}'; known: {}", request.verb, fmt::join(kControlVerbs, ", ")));
}

void RunControl::BeginAgain(const ControlRequestMessage& request, std::uint64_t tick, bool logged)
{
  if (!may_reset_)
    throw std::invalid_argument(
        "reset: nobody would start this run again; `swarmanoid run` does, for runs without a program of the user's own "
        "around them");
  const std::optional<long long> seed =
      request.entity.empty() ? static_cast<long long>(experiment_.seed) : ParseInteger(request.entity);
  if (!seed || *seed < 0)
    throw std::invalid_argument(
        fmt::format("reset: {} is no seed; a seed is a whole number from 0 on", request.entity));
  stop_ = true;
  why_stopped_ = fmt::format("reset by {}", AskerOf(request));
  reset_ = ResetRequest{static_cast<std::uint64_t>(*seed), paused_ || pause_at_ != 0, real_time_factor_};
  ControlRequestMessage done = request;
  done.entity = std::to_string(*seed);
  if (!logged) event_log_.Write(tick, done);
  answer_(request, true, tick, fmt::format("reset at tick {}: it begins again with seed {}", tick, *seed));
}

void RunControl::MoveWorkers(const ControlRequestMessage& request, std::uint64_t tick)
{
  if (!moving_.empty())
    throw std::invalid_argument(
        fmt::format("{} is on the way already; ask again when it has arrived", *moving_.begin()));
  const std::vector<WorkerPlacement::Move> moves = places_.Read(request);
  event_log_.Write(tick, request);
  if (moves.empty()) return answer_(request, true, tick, "no worker is at " + request.entity);
  move_request_ = request;
  moved_.clear();
  for (const WorkerPlacement::Move& move : moves) moving_.insert(move.worker);
  for (const WorkerPlacement::Move& move : moves) move_(move);
}

void RunControl::ShareOut(const ControlRequestMessage& request, std::uint64_t tick)
{
  if (!moving_.empty())
    throw std::invalid_argument(
        fmt::format("{} is on the way already; ask again when it has arrived", *moving_.begin()));
  constexpr std::ptrdiff_t kMostHosts = 1000;
  const auto robots = std::count_if(experiment_.entities.begin(), experiment_.entities.end(),
                                    [](const EntityConfiguration& entity) { return !entity.controller.empty(); });
  const std::vector<std::string> machines =
      places_.ReadHosts(request, static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(robots, 1, kMostHosts)));
  if (!share_out_)
    throw std::invalid_argument(
        "hosts: all processes start again for it, and the space server cannot: it is in the process of a user");
  event_log_.Write(tick, request);
  move_request_ = request;
  moving_.insert("every process");
  share_out_(machines);
}

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
    if (next_repeated_ < repeated_.size())
    {
      const std::uint64_t event = repeated_[next_repeated_].tick;
      decision.until = decision.until == 0 ? event : std::min(decision.until, event);
    }
  }
  decision.go = true;
  return decision;
}

void RunControl::Ended(std::uint64_t tick)
{
  WriteFaults();
  if (step_) answer_(*step_, true, tick, RunEndedText(tick));
  if (move_request_) answer_(*move_request_, false, tick, RunEndedText(tick));
  const std::lock_guard lock(mutex_);
  for (const ControlRequestMessage& request : requests_)
    if (request.verb == kRefused)
      event_log_.Write(tick, request);
    else
      answer_(request, false, tick, RunEndedText(tick));
  requests_.clear();
}

}  // namespace swarmanoid
