// A tick is complete when the messages of all parts are here (TickGate). The thread of the bus that brings the last one
// computes the next state and sends it at once. Waking another thread would cost time at each tick. The journal is
// written after the state is sent, while the workers compute.
//
// A worker that is replaced is withdrawn: the tick waits for its successor, which repeats the present tick. Hosts whose
// commands go to engines alone are no part of the gate, so away_ has the replaced ones.
//
// Invariants: ticks change under mutex_ only; all messages are checked before the space changes; the state on the bus
// is the one in the journal.
#include "space_server/cluster/lockstep.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/activity/failure_report.h"
#include "common/bus/membership/worker_world.h"
#include "common/space/space.h"
#include "space_server/space_server.h"

namespace swarmanoid
{

namespace
{

std::vector<std::uint32_t> HostsHeard(const Assignment& assignment)
{
  std::vector<std::uint32_t> hosts;
  for (std::uint32_t h = 0; h < assignment.hosts.size(); ++h)
    if (ServerHears(assignment.hosts[h])) hosts.push_back(h);
  return hosts;
}

std::vector<SensorFrame> FirstFrames(const RestartPoint* restart_point)
{
  if (restart_point == nullptr || !restart_point->Record()) return {};
  return restart_point->Record()->frames;
}

std::size_t PlaceIn(const std::vector<std::uint32_t>& numbers, std::uint32_t number)
{
  return static_cast<std::size_t>(std::find(numbers.begin(), numbers.end(), number) - numbers.begin());
}

std::vector<TickGate::Part> Parts(const Experiment& experiment, const std::vector<std::uint32_t>& hosts,
                                  std::size_t visualisers)
{
  std::vector<TickGate::Part> parts;
  for (std::size_t e = 0; e < experiment.engines.size(); ++e) parts.push_back({EngineName(experiment, e)});
  // Commands that act a tick later are sent a tick early.
  for (const std::uint32_t host : hosts) parts.push_back({HostName(host), experiment.ahead > 0});
  for (std::size_t v = 0; v < visualisers; ++v) parts.push_back({VisualiserName(experiment.visualisations[v])});
  return parts;
}

}  // namespace

Lockstep::Lockstep(ServerSession& session, SpaceServer& server, const Assignment& assignment, bool visualisations,
                   const std::string& hash_log, std::function<void(SpaceServer&)> watch, CheckpointWriter& checkpoints,
                   JournalWriter* journal, const RestartPoint* restart_point, std::function<void()> stopped)
    : session_(session),
      server_(server),
      checkpoints_(checkpoints),
      journal_(journal),
      assignment_(assignment),
      limits_(server.Space(), assignment, journal != nullptr),
      first_tick_(server.Space().GetTick()),
      watch_(std::move(watch)),
      stopped_(std::move(stopped)),
      engines_(assignment.engines.size()),
      hosts_(HostsHeard(assignment)),
      visualisers_(visualisations ? server.Space().GetExperiment().visualisations.size() : 0),
      workers_(static_cast<unsigned>(engines_ + assignment.hosts.size() + visualisers_)),
      gate_(Parts(server.Space().GetExperiment(), hosts_, visualisers_), first_tick_),
      updates_(engines_),
      commands_here_(hosts_.size()),
      drawn_(visualisers_),
      first_frames_(FirstFrames(restart_point)),
      frames_(journal == nullptr ? 0 : engines_),
      hash_log_(hash_log, restart_point != nullptr ? std::optional(first_tick_) : std::nullopt),
      states_(session.GetBus(), session.Scope(limits_.StateBytes(), 1)),
      local_states_(session, server.Space(), assignment, limits_)
{
  if (visualisers_ > 0) server_.SetDrawsIntoStates();
  for (const EngineUpdate& update : updates_) updates_here_.push_back(&update);
  for (auto& commands : commands_)
    for (const HostLayout& host : assignment.hosts) commands.emplace_back().values.resize(host.command_size);
  for (std::size_t e = 0; e < frames_.size(); ++e) frames_[e].values.resize(assignment.engines[e].sensor_size);

  Bus& bus = session.GetBus();
  if (engines_ > 0)
    updates_in_.emplace(
        bus, session.Scope(limits_.UpdateBytes(), static_cast<unsigned>(engines_)),
        HotSubscription<EngineUpdate>::Handler{
            [this](const MessageHeader& header) -> EngineUpdate*
            {
              TickLimits::CheckSource(header, engines_);
              if (header.tick == 0) throw BadMessage("an update cannot lead to tick 0");
              return PlaceOf(header, header.tick - 1, header.source, updates_[header.source]);
            },
            [this](const MessageHeader& header, EngineUpdate&) { Arrived(header, header.source, header.tick - 1); },
            [this](const MessageHeader& header, const EngineUpdate& update) { limits_.Check(header, update); }});
  if (!hosts_.empty())
    commands_in_.emplace(
        bus, session.Scope(limits_.CommandBytes(), static_cast<unsigned>(assignment.hosts.size())),
        HotSubscription<ControlCommands>::Handler{
            [this](const MessageHeader& header) -> ControlCommands*
            {
              limits_.CheckSource<ControlCommands>(header);
              const std::size_t k = PlaceIn(hosts_, header.source);
              if (k == hosts_.size()) return nullptr;
              return PlaceOf(header, header.tick, engines_ + k, commands_[header.tick % 2][header.source]);
            },
            [this](const MessageHeader& header, ControlCommands&)
            { Arrived(header, engines_ + PlaceIn(hosts_, header.source), header.tick); },
            [this](const MessageHeader& header, const ControlCommands& commands) { limits_.Check(header, commands); }});
  if (visualisers_ > 0)
    drawn_in_.emplace(bus, session.Scope(TickLimits::DrawnBytes(), static_cast<unsigned>(visualisers_)),
                      HotSubscription<DrawnMessage>::Handler{
                          [this](const MessageHeader& header) -> DrawnMessage*
                          {
                            TickLimits::CheckSource(header, visualisers_);
                            return PlaceOf(header, header.tick, engines_ + hosts_.size() + header.source,
                                           drawn_[header.source]);
                          },
                          [this](const MessageHeader& header, DrawnMessage&)
                          { Arrived(header, engines_ + hosts_.size() + header.source, header.tick); }});
}

Lockstep::~Lockstep()
{
  drawn_in_.reset();
  commands_in_.reset();
  updates_in_.reset();
}

bool Lockstep::AllMatched() const
{
  return states_.Readers() + local_states_.Readers() >= workers_ &&
         (!updates_in_ || updates_in_->Writers() >= engines_) &&
         (!commands_in_ || commands_in_->Writers() >= hosts_.size()) &&
         (!drawn_in_ || drawn_in_->Writers() >= visualisers_);
}

template <class Message>
Message* Lockstep::PlaceOf(const MessageHeader& header, std::uint64_t tick, std::optional<std::size_t> part,
                           Message& place)
{
  if (header.run != session_.World().run) return nullptr;
  const std::lock_guard lock(mutex_);
  if ((held_ && !gate_.MayLead(*part)) || gate_.IsReplaced(*part, header.incarnation)) return nullptr;
  return gate_.Offer(*part, tick) == TickGate::Verdict::kExpected ? &place : nullptr;
}

void Lockstep::Arrived(const MessageHeader& header, std::size_t part, std::uint64_t tick)
{
  const std::lock_guard lock(mutex_);
  if (gate_.IsReplaced(part, header.incarnation)) return;
  if (gate_.Arrived(part, tick) && !held_) GoOn();
}

void Lockstep::GoOn()
{
  if (!away_.empty() || finished_ || failure_) return;
  try
  {
    Complete();
  }
  catch (const std::exception& error)
  {
    const bool complete = dynamic_cast<const ActivityError*>(&error) != nullptr;
    NoteEnd(EndReason::kFailed, gate_.Tick(),
            complete ? error.what() : fmt::format("space server failed at tick {}: {}", gate_.Tick(), error.what()),
            complete);
    failure_ = error.what();
    stopped_();
  }
}

void Lockstep::Complete()
{
  const auto terminating =
      std::find_if(drawn_.begin(), drawn_.end(), [](const DrawnMessage& drawn) { return drawn.terminate; });
  if (terminating != drawn_.end())
  {
    const auto visualiser = static_cast<std::size_t>(terminating - drawn_.begin());
    terminator_ = VisualiserName(server_.Space().GetExperiment().visualisations[visualiser]);
    // The tick that was drawn is the last one: its state is sent again, marked as the last.
    server_.Finish();
    Send(true);
    return;
  }
  for (std::size_t k = 0; k < hosts_.size(); ++k) commands_here_[k] = &commands_[gate_.Tick() % 2][hosts_[k]];
  for (const ControlCommands* commands : commands_here_) server_.Check(*commands);
  for (const EngineUpdate& update : updates_) server_.Check(update);
  bool kept = journal_ == nullptr;
  const auto keep = [&, &state = *sent_, saves = saves_, frames = Frames()]
  {
    if (!std::exchange(kept, true)) Record(state, saves, frames);
  };
  const bool holds = hold_ || watch_ || gate_.Tick() + 1 == until_;
  bool goes_on = false;
  try
  {
    server_.Advance(updates_here_, commands_here_);
    gate_.Next();
    goes_on = !holds && !server_.IsLast();
    if (goes_on) Send(false);
    // The journal is written while the workers compute the next tick. Their answers wait until this tick ends.
    keep();
  }
  catch (...)
  {
    keep();
    throw;
  }
  if (holds)
  {
    held_ = true;
    stopped_();
  }
  else if (!goes_on)
    Send(false);
}

void Lockstep::Send(bool repeated)
{
  const std::uint64_t tick = server_.Space().GetTick();
  // A run restored from the checkpoint calls the watcher for this tick again.
  if (!repeated)
  {
    // The hash log on disk must have the lines of all ticks before the checkpoint.
    if (checkpoints_.IsWanted(tick)) hash_log_.Flush();
    before_ = sent_;
    before_saves_ = saves_;
    saves_ = checkpoints_.Sending(server_);
  }
  if (watch_ && !repeated) RunCodeOf({Actor::kWatcher}, ActivityStep::kWatch, tick, [&] { watch_(server_); });
  if (visualisers_ > 0 && !repeated) server_.Draw();
  const SpaceState& state = server_.State();
  sent_ = &state;
  if (hash_log_.IsOpen() && !repeated) hash_log_.Write(state.tick, server_.Space().Hash());
  held_ = false;
  const MessageHeader header{session_.World().run, state.tick, 0, repeated, 0, saves_};
  // If every process gets its local state, the whole state may have no readers.
  if (local_states_.IsEmpty() || states_.Readers() > 0)
  {
    // The run does not wait for commands that act a tick later, so a controller host may lack the state before this
    // one.
    if (repeated && before_ != nullptr && server_.Space().GetExperiment().ahead > 0)
      states_.Write({session_.World().run, before_->tick, 0, true, 0, before_saves_}, *before_);
    states_.Write(header, state);
  }
  local_states_.Write(header, state);
  if (!state.last) return;
  // Readers of the journal need the last state. It has no commands, since no process computes a step from it.
  if (journal_ != nullptr && !finished_) journal_->AddTick(state, saves_, Frames(), {});
  finished_ = true;
  stopped_();
}

void Lockstep::Record(const SpaceState& state, bool saves, std::span<const SensorFrame> frames)
{
  std::vector<ControlCommands>& commands = commands_[state.tick % 2];
  for (std::size_t e = 0; e < engines_; ++e)
    for (const ValueCopy& copy : assignment_.engines[e].command_copies)
    {
      if (ServerHears(assignment_.hosts[copy.source])) continue;
      std::copy_n(updates_[e].recorded.begin() + static_cast<std::ptrdiff_t>(copy.to), copy.count,
                  commands[copy.source].values.begin() + static_cast<std::ptrdiff_t>(copy.from));
    }
  journal_->AddTick(state, saves, frames, commands);
  for (std::size_t e = 0; e < engines_; ++e)
    std::copy(updates_[e].recorded.begin() + static_cast<std::ptrdiff_t>(assignment_.engines[e].command_size),
              updates_[e].recorded.end(), frames_[e].values.begin());
}

// Returns the sensor frames of the tick. The frames of the first tick come from the start of the run, not from
// messages.
std::span<const SensorFrame> Lockstep::Frames() const
{
  if (gate_.Tick() == first_tick_) return first_frames_;
  return frames_;
}

Lockstep::Present Lockstep::Withdraw(const std::string& name, std::uint32_t incarnation)
{
  const std::lock_guard lock(mutex_);
  gate_.Withdraw(name, incarnation);
  Present present;
  if (IsUnheard(name)) away_[name] = incarnation;
  present.is_done = MayBeDone(name) && !held_ && !finished_;
  if (present.is_done) present.record.state = *sent_;
  present.record.state.tick = gate_.Tick();
  present.record.save = saves_;
  const std::span<const SensorFrame> frames = Frames();
  present.record.frames.assign(frames.begin(), frames.end());
  return present;
}

void Lockstep::Return(const std::string& name, std::uint32_t incarnation)
{
  const std::lock_guard lock(mutex_);
  const auto found = away_.find(name);
  if (found == away_.end() || found->second > incarnation) return;
  away_.erase(found);
  if (gate_.Complete() && !held_) GoOn();
}

// Engines may have what a dead host answered to this tick, and go on with it although the server withdraws it: the
// answer of a host that the server does not hear, and commands for the next tick. Frames that they make of it are too
// early for a replacement that begins with this tick.
bool Lockstep::MayBeDone(const std::string& name) const
{
  if (IsUnheard(name)) return true;
  for (std::size_t h = 0; h < assignment_.hosts.size(); ++h)
    if (name == HostName(h)) return server_.Space().GetExperiment().ahead > 0;
  return false;
}

bool Lockstep::IsUnheard(const std::string& name) const
{
  for (std::size_t h = 0; h < assignment_.hosts.size(); ++h)
    if (name == HostName(h)) return !ServerHears(assignment_.hosts[h]);
  return false;
}

bool Lockstep::Held() const
{
  const std::lock_guard lock(mutex_);
  return held_;
}

std::uint64_t Lockstep::Tick() const
{
  const std::lock_guard lock(mutex_);
  return gate_.Tick();
}

void Lockstep::Go(std::uint64_t until)
{
  const std::lock_guard lock(mutex_);
  hold_ = false;
  until_ = until;
  if (!held_) return;
  Send(false);
  // An experiment without engines, hosts and visualisers has no answers to wait for.
  while (gate_.Complete() && !finished_ && !held_) Complete();
}

void Lockstep::Hold()
{
  const std::lock_guard lock(mutex_);
  hold_ = true;
}

void Lockstep::Repeat()
{
  const std::lock_guard lock(mutex_);
  if (!held_) Send(true);
}

bool Lockstep::Finished() const
{
  const std::lock_guard lock(mutex_);
  return finished_;
}

std::optional<std::string> Lockstep::Terminator() const
{
  const std::lock_guard lock(mutex_);
  return terminator_;
}

std::optional<std::string> Lockstep::Failure() const
{
  const std::lock_guard lock(mutex_);
  return failure_;
}

void Lockstep::CloseHashLog()
{
  const std::lock_guard lock(mutex_);
  hash_log_.Close();
}

std::vector<std::string> Lockstep::Missing() const
{
  const std::lock_guard lock(mutex_);
  if (held_) return {};
  std::vector<std::string> names = gate_.Missing();
  for (const auto& [name, incarnation] : away_) names.push_back(name);
  return names;
}

}  // namespace swarmanoid
