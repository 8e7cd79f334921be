#include "space_server/run_control.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "space_server/space_changes.h"

namespace swarmanoid
{

RunControl::RunControl(const Experiment& experiment, RunControlSetup setup, Answer answer)
    : experiment_(experiment),
      answer_(std::move(answer)),
      event_log_(std::move(setup.event_log), setup.goes_on),
      repeated_(std::move(setup.repeated)),
      logged_faults_(std::move(setup.failed)),
      paused_(setup.paused),
      real_time_factor_(setup.real_time_factor),
      pause_at_(setup.pause_at),
      step_(std::move(setup.step))
{
  for (const RecordedEvent& event : repeated_)
    if (event.logged) asked_from_ = event.tick;
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

void RunControl::Failed(const std::vector<KnownFault>& faults)
{
  const std::lock_guard lock(mutex_);
  faults_.insert(faults_.end(), faults.begin(), faults.end());
}

void RunControl::WriteFaults()
{
  std::vector<KnownFault> faults;
  {
    const std::lock_guard lock(mutex_);
    faults.swap(faults_);
  }
  for (const KnownFault& fault : faults)
  {
    // Of a tick that is done again.
    if (std::find(logged_faults_.begin(), logged_faults_.end(), fault) != logged_faults_.end()) continue;
    const EntityConfiguration& entity = experiment_.entities[fault.robot];
    ControlRequestMessage event;
    event.verb = kFailedController;
    event.entity = entity.id;
    event.client = fmt::format("controller '{}' {}", entity.controller, FaultText(fault.kind));
    event_log_.Write(fault.tick, event);
    answer_(event, false, fault.tick, fmt::format("'{}': its {} at tick {}", entity.id, event.client, fault.tick));
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
  if (stop_ || paused_) return true;
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
    try
    {
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

void RunControl::Carry(const ControlRequestMessage& request, SpaceServer& server)
{
  const std::uint64_t tick = server.Space().GetTick();
  const auto reply = [&](bool done, const std::string& text)
  {
    if (done) event_log_.Write(tick, request);
    answer_(request, done, tick, text);
  };
  const double number = request.numbers.empty() ? std::nan("") : request.numbers[0];

  if (request.verb == kRefused) return event_log_.Write(tick, request);
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
  else if (IsSpaceChange(request.verb))
  {
    try
    {
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
  if (paused_) return decision;
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
  if (step_) answer_(*step_, true, tick, fmt::format("the run ended at tick {}", tick));
  const std::lock_guard lock(mutex_);
  for (const ControlRequestMessage& request : requests_)
    if (request.verb == kRefused)
      event_log_.Write(tick, request);
    else
      answer_(request, false, tick, fmt::format("the run ended at tick {}", tick));
  requests_.clear();
}

}  // namespace swarmanoid
