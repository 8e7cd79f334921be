// Messages between the processes may be lost at any time, and each process may be replaced. Each task has an epoch and
// a number. A sender repeats its message, at growing intervals, until the answer has come. A process that has lost its
// state asks for a new epoch, which starts all regions with their whole state. docs/wire.md shows the messages.
//
// Invariants: a region takes a task of number n only after n - 1 of the same epoch, and a first task at any time. In
// one epoch, no region is more than one exchange ahead of another, so two slots for messages, by even and odd number,
// are enough. An answer belongs to the newest task, or it is dropped.
#include "common/bus/membership/region_links.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "common/bus/membership/tick_gate.h"
#include "common/bus/membership/worker_world.h"
#include "common/messages/assignment.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr std::uint32_t kFirstTask = 0;
constexpr std::uint32_t kEndOfRun = ~0U;
constexpr std::chrono::milliseconds kFirstWait = 100ms;  // until a message that may be lost is repeated
constexpr std::chrono::milliseconds kLastWait = 1s;
// Period of the check whether the engine has left, after the end of the run.
constexpr std::chrono::milliseconds kLook = 2ms;
constexpr std::chrono::milliseconds kLookBefore = 500ms;  // the same, before the end of the run
// How long a region stays after the end of the run if the engine, which asks every 0.1 s, is silent. The engine's Leave
// may be lost, and the bus takes a killed engine for living for a while.
constexpr std::chrono::milliseconds kLinger = 5s;
constexpr std::chrono::milliseconds kForEver = std::chrono::hours(24 * 365);

// Returns the scope of messages among the processes of one engine. ToRegion returns the scope of messages to one
// region.
HotScope AmongEngine(const WorkerSession& session, std::uint32_t engine, std::size_t capacity, unsigned writers)
{
  HotScope scope = session.Scope(capacity, writers);
  scope.listener = PartNameOfEngine(engine);
  return scope;
}

HotScope ToRegion(const WorkerSession& session, std::uint32_t region, std::size_t capacity)
{
  HotScope scope = session.Scope(capacity, 1);
  scope.listener = fmt::format("region {}", region);
  return scope;
}

void RequireParts(const RegionMessage& message, std::size_t parts)
{
  if (message.sizes.size() != parts) throw BadMessage("sizes: they are not as many as the regions");
}

std::span<const char> PartOf(const RegionMessage& message, std::size_t part)
{
  std::size_t begin = 0;
  for (std::size_t k = 0; k < part; ++k) begin += message.sizes[k];
  return std::span<const char>(message.bytes).subspan(begin, message.sizes[part]);
}

void Pack(std::span<const ByteWriter> parts, RegionMessage& message)
{
  message.sizes.clear();
  message.bytes.clear();
  for (const ByteWriter& part : parts)
  {
    message.sizes.push_back(static_cast<std::uint32_t>(part.Bytes().size()));
    message.bytes.insert(message.bytes.end(), part.Bytes().begin(), part.Bytes().end());
  }
}

// The interval between repetitions grows while no answer comes.
struct Patience
{
  std::chrono::milliseconds time = kFirstWait;
  void Grow() { time = std::min(2 * time, kLastWait); }
};

}  // namespace

RegionTeamLink::RegionTeamLink(WorkerSession& session, const Experiment& experiment, std::size_t engine,
                               const RegionLimits& limits)
    : session_(session),
      engine_(static_cast<std::uint32_t>(engine)),
      first_(RegionNumber(experiment, engine, 0)),
      // The messages of earlier workers have an earlier epoch.
      epoch_(session.Header(0, 0).incarnation << 16U),
      places_(RegionsOf(experiment.engines[engine])),
      results_(session.GetBus(), AmongEngine(session, engine_, limits.ResultBytes(), RegionCount()),
               {[this](const MessageHeader& header) -> RegionResultMessage*
                {
                  const bool is_of_ours = header.source >= first_ && header.source - first_ < places_.size();
                  return header.run == session_.World().run && is_of_ours ? &arriving_ : nullptr;
                },
                [this](const MessageHeader& header, RegionResultMessage& result) { Received(header, result); },
                [](const MessageHeader&, const RegionResultMessage& result) { RequireParts(result, 2); }})
{
  for (unsigned k = 0; k < places_.size(); ++k)
  {
    places_[k].name = RegionName(experiment, engine, k);
    places_[k].tasks = std::make_unique<HotPublisher<RegionTaskMessage>>(
        session.GetBus(), ToRegion(session, first_ + k, limits.TaskBytes()));
    session.Trust(places_[k].name);
  }
}

RegionTeamLink::~RegionTeamLink() = default;

unsigned RegionTeamLink::Missing() const
{
  const auto met = static_cast<unsigned>(
      std::ranges::count_if(places_, [](const Place& place) { return place.tasks->Readers() > 0; }));
  return RegionCount() - std::min({RegionCount(), met, results_.Writers()});
}

void RegionTeamLink::Begin(std::mutex& role) { role_ = &role; }

std::string RegionTeamLink::Awaited() const
{
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const Place& place : places_)
    if (is_at_work_ && !place.is_here) names.push_back(place.name);
  return Joined(names);
}

void RegionTeamLink::Received(const MessageHeader& header, RegionResultMessage& result)
{
  const std::lock_guard lock(mutex_);
  Place& place = places_[header.source - first_];
  if (result.epoch == 0)
  {
    begins_again_ = true;
    place.is_here = false;
  }
  else if (result.epoch == epoch_ && result.number == number_ && !place.is_here)
  {
    std::swap(place.result, result);
    place.is_here = true;
  }
  changed_.notify_all();
}

void RegionTeamLink::MakeTask(std::uint32_t epoch, std::uint32_t number, std::span<const ByteWriter> parts)
{
  const std::lock_guard lock(mutex_);
  epoch_ = epoch;
  number_ = number;
  is_at_work_ = true;
  for (std::size_t k = 0; k < places_.size(); ++k)
  {
    Place& place = places_[k];
    place.task.epoch = epoch;
    place.task.number = number;
    Pack(parts.subspan(k, 1), place.task);
    place.is_here = false;
  }
}

void RegionTeamLink::Send()
{
  for (Place& place : places_)
  {
    {
      const std::lock_guard lock(mutex_);
      if (place.is_here) continue;
    }
    place.tasks->Write(session_.Header(tick_, engine_), place.task);
  }
}

bool RegionTeamLink::Wait(std::chrono::milliseconds most)
{
  const auto until = RunClock::now() + most;
  Patience patience;
  std::unique_lock lock(mutex_);
  const auto all_here = [this] { return std::ranges::all_of(places_, &Place::is_here); };
  while (!changed_.wait_for(lock, patience.time, [&] { return all_here() || begins_again_; }))
  {
    if (RunClock::now() > until) return false;
    lock.unlock();
    Send();
    patience.Grow();
    lock.lock();
  }
  return all_here();
}

void RegionTeamLink::Work(bool all_data, const WriteTasks& write, std::span<std::vector<char>> results,
                          const std::function<void()>& meanwhile)
{
  struct Unlocked
  {
    explicit Unlocked(std::mutex& of) : mutex(of) { mutex.unlock(); }
    ~Unlocked() { mutex.lock(); }
    std::mutex& mutex;
  };
  bool is_first = true;
  parts_.resize(places_.size());
  for (bool done = false; !done; all_data = true)
  {
    {
      const std::lock_guard lock(mutex_);
      all_data |= std::exchange(begins_again_, false);
    }
    for (ByteWriter& part : parts_) part.Clear();
    write(all_data, parts_);
    all_data ? MakeTask(epoch_ + 1, kFirstTask, parts_) : MakeTask(epoch_, number_ + 1, parts_);
    {
      const Unlocked unlocked(*role_);
      Send();
    }
    if (std::exchange(is_first, false)) meanwhile();
    const Unlocked unlocked(*role_);
    done = Wait(kForEver);
  }
  const std::lock_guard lock(mutex_);
  is_at_work_ = false;
  for (std::size_t k = 0; k < places_.size(); ++k)
  {
    const std::span<const char> error = PartOf(places_[k].result, 1);
    if (!error.empty()) throw std::runtime_error(std::string(error.begin(), error.end()));
    // The result is the message's only part.
    results[k].swap(places_[k].result.bytes);
  }
}

void RegionTeamLink::End()
{
  // The end of the run has an epoch of its own. There may have been no task, and regions that begin again have epoch 0.
  MakeTask(epoch_ + 1, kEndOfRun, std::vector<ByteWriter>(places_.size()));
  session_.WaitUntil(
      [this]
      {
        {
          // A region that has just started may have asked for a new begin. It is told the end at once instead.
          const std::lock_guard lock(mutex_);
          begins_again_ = false;
        }
        Send();
        if (Wait(0ms)) return true;
        const std::lock_guard lock(mutex_);
        return std::ranges::all_of(
            places_, [this](const Place& place) { return place.is_here || session_.HasLeft(place.name, 0); });
      },
      [this] { return Awaited(); });
}

RegionLink::RegionLink(WorkerSession& session, const Experiment& experiment, std::size_t engine, unsigned region,
                       const RegionLimits& limits)
    : session_(session),
      engine_(static_cast<std::uint32_t>(engine)),
      engine_name_(EngineName(experiment, engine)),
      first_(RegionNumber(experiment, engine, 0)),
      own_(region),
      regions_(RegionsOf(experiment.engines[engine])),
      heard_(regions_),
      halos_out_(session.GetBus(), AmongEngine(session, engine_, limits.HaloBytes(), regions_)),
      results_(session.GetBus(), AmongEngine(session, engine_, limits.ResultBytes(), regions_)),
      halos_in_(session.GetBus(), AmongEngine(session, engine_, limits.HaloBytes(), regions_),
                {[this](const MessageHeader& header) -> RegionHaloMessage*
                 {
                   const bool is_of_ours = header.source >= first_ && header.source - first_ < regions_;
                   return header.run == session_.World().run && is_of_ours && header.source != first_ + own_
                              ? &arriving_halo_
                              : nullptr;
                 },
                 [this](const MessageHeader& header, RegionHaloMessage& halo) { HaloReceived(header, halo); },
                 [this](const MessageHeader&, const RegionHaloMessage& halo) { RequireParts(halo, regions_); }}),
      tasks_(session.GetBus(), ToRegion(session, first_ + own_, limits.TaskBytes()),
             {[this](const MessageHeader& header) -> RegionTaskMessage*
              { return header.run == session_.World().run && header.source == engine_ ? &arriving_task_ : nullptr; },
              [this](const MessageHeader& header, RegionTaskMessage& task) { TaskReceived(header, task); },
              [](const MessageHeader&, const RegionTaskMessage& task) { RequireParts(task, 1); }})
{
  session.Trust(engine_name_);
  for (unsigned k = 0; k < regions_; ++k)
    if (k != region) session.Trust(RegionName(experiment, engine, k));
}

RegionLink::~RegionLink() = default;

unsigned RegionLink::Missing() const
{
  // The process's own reader and writer match each other, too.
  const unsigned others = regions_ - std::min({regions_, halos_out_.Readers(), halos_in_.Writers()});
  return others + 1 - std::min({1U, results_.Readers(), tasks_.Writers()});
}

void RegionLink::TaskReceived(const MessageHeader& header, RegionTaskMessage& task)
{
  const std::lock_guard lock(mutex_);
  // A task older than the newest one is a late repetition.
  if (std::tie(task.epoch, task.number) < std::tie(epoch_, number_)) return;
  const bool is_known = task.epoch == epoch_ && task.number == number_;
  const bool builds_upon = task.number != kFirstTask && task.number != kEndOfRun;
  if (task.epoch == missed_epoch_)
    is_lost_ = true;
  else if (is_known)
    is_asked_again_ = state_ == TaskState::kAnswered;
  else if (builds_upon && (task.epoch != epoch_ || task.number != number_ + 1))
    is_lost_ = true;
  else
  {
    epoch_ = task.epoch;
    number_ = task.number;
    next_tick_ = header.tick;
    state_ = TaskState::kArrived;
    std::swap(next_, task);
  }
  changed_.notify_all();
}

void RegionLink::HaloReceived(const MessageHeader& header, RegionHaloMessage& halo)
{
  const std::lock_guard lock(mutex_);
  RegionHaloMessage& heard = heard_[header.source - first_][halo.number % 2];
  if (header.repeated && heard.epoch == halo.epoch && heard.number == halo.number) is_halo_missed_ = true;
  std::swap(heard, halo);
  changed_.notify_all();
}

void RegionLink::Swap(std::span<const ByteWriter> out, std::span<std::vector<char>> in)
{
  ++exchanges_;
  RegionHaloMessage& said = said_[exchanges_ % 2];
  said.epoch = task_.epoch;
  said.number = exchanges_;
  Pack(out, said);
  WriteHalo(said);
  const auto is_here = [&](std::size_t region)
  {
    const RegionHaloMessage& halo = heard_[region][exchanges_ % 2];
    return region == own_ || (halo.epoch == task_.epoch && halo.number == exchanges_);
  };
  const auto all_here = [&]
  {
    for (std::size_t region = 0; region < regions_; ++region)
      if (!is_here(region)) return false;
    return true;
  };
  // The other regions are at most one exchange ahead of this one. They are further ahead only if they exchanged with
  // its predecessor. Then they do not repeat what this process lacks.
  const auto is_left_behind = [&]
  {
    return std::ranges::any_of(heard_,
                               [&](const Halos& halos)
                               {
                                 return std::ranges::any_of(
                                     halos, [&](const RegionHaloMessage& halo)
                                     { return halo.epoch == task_.epoch && halo.number > exchanges_ + 1; });
                               });
  };
  Patience patience;
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, patience.time,
                            [&]
                            { return all_here() || state_ == TaskState::kArrived || is_closed_ || is_left_behind(); }))
  {
    lock.unlock();
    WriteHalosAgain(true);
    patience.Grow();
    lock.lock();
  }
  if (!all_here())
  {
    // This process asks the engine for a new epoch when the engine repeats the task.
    if (is_left_behind()) missed_epoch_ = task_.epoch;
    throw RegionsBeginAgain();
  }
  for (std::size_t region = 0; region < regions_; ++region)
  {
    if (region == own_) continue;
    const std::span<const char> part = PartOf(heard_[region][exchanges_ % 2], own_);
    in[region].assign(part.begin(), part.end());
  }
}

void RegionLink::WriteHalo(const RegionHaloMessage& halo, bool lacks_others)
{
  MessageHeader header = session_.Header(tick_, first_ + own_);
  header.repeated = lacks_others;
  halos_out_.Write(header, halo);
}

// Writes the last two messages again, because a region that lags behind lacks the first of them.
void RegionLink::WriteHalosAgain(bool lacks_others)
{
  for (const std::uint32_t number : {exchanges_ - 1, exchanges_})
    if (const RegionHaloMessage& said = said_[number % 2];
        number != 0 && said.epoch == task_.epoch && said.number == number)
      WriteHalo(said, lacks_others);
}

void RegionLink::Answer(std::uint32_t epoch, std::uint32_t number, std::span<const char> result,
                        const std::string& error)
{
  answer_.epoch = epoch;
  answer_.number = number;
  answer_.sizes = {static_cast<std::uint32_t>(error.empty() ? result.size() : 0),
                   static_cast<std::uint32_t>(error.size())};
  if (error.empty())
    answer_.bytes.assign(result.begin(), result.end());
  else
    answer_.bytes.assign(error.begin(), error.end());
  WriteAnswer();
}

void RegionLink::WriteAnswer()
{
  answered_ = RunClock::now();
  results_.Write(session_.Header(tick_, first_ + own_), answer_);
}

// A region stays as long as the engine asks, because its last answer may be lost. An engine that leaves in good order
// has done the last tick, even if this region was not told so.
bool RegionLink::EngineHasLeft() const
{
  if (!is_over_) return session_.HasLeft(engine_name_, tick_ + 1);
  return tasks_.Writers() == 0 || session_.HasLeft(engine_name_, tick_) || RunClock::now() - answered_ > kLinger;
}

RegionLink::Next RegionLink::WaitForNext()
{
  std::unique_lock lock(mutex_);
  const auto is_due = [this]
  { return state_ == TaskState::kArrived || is_asked_again_ || is_halo_missed_ || is_lost_ || is_closed_; };
  while (!changed_.wait_for(lock, is_over_ ? kLook : kLookBefore, is_due))
  {
    // The bus calls back while it holds its own locks, and EngineHasLeft needs those locks.
    lock.unlock();
    if (EngineHasLeft())
    {
      is_over_ = true;
      return Next::kEnd;
    }
    lock.lock();
    // No task has come. The engine may hold the predecessor's result, and the first answer of this process may be lost.
    if (epoch_ == 0) return Next::kAskForAll;
  }
  if (is_closed_) return Next::kEnd;
  if (state_ == TaskState::kArrived)
  {
    state_ = TaskState::kInWork;
    std::swap(task_, next_);
    tick_ = next_tick_;
    is_asked_again_ = is_halo_missed_ = is_lost_ = false;
    return Next::kTask;
  }
  if (std::exchange(is_halo_missed_, false)) return Next::kHalosAgain;
  if (std::exchange(is_asked_again_, false)) return Next::kAnswerAgain;
  is_lost_ = false;
  return Next::kAskForAll;
}

void RegionLink::Serve(EngineRegion& region)
{
  // The engine may know an earlier process of this region, so this one announces itself.
  Answer(0, 0, {}, "");
  ByteWriter result;
  for (Next next = WaitForNext(); next != Next::kEnd; next = WaitForNext())
  {
    if (next == Next::kHalosAgain) WriteHalosAgain(false);
    if (next == Next::kAnswerAgain) WriteAnswer();
    if (next == Next::kAskForAll) Answer(0, 0, {}, "");
    if (next != Next::kTask) continue;
    result.Clear();
    std::string error;
    try
    {
      if (task_.number == kFirstTask) exchanges_ = 0;
      if (task_.number != kEndOfRun) region.Work(PartOf(task_, 0), result);
    }
    catch (const RegionsBeginAgain&)
    {
      continue;
    }
    catch (const BusError&)
    {
      throw;
    }
    catch (const std::exception& failure)
    {
      error = failure.what();
    }
    Answer(task_.epoch, task_.number, result.Bytes(), error);
    {
      const std::lock_guard lock(mutex_);
      if (state_ == TaskState::kInWork) state_ = TaskState::kAnswered;
    }
    is_over_ = task_.number == kEndOfRun;
  }
  if (is_over_) session_.Finish(tick_);
}

void RegionLink::Close()
{
  const std::lock_guard lock(mutex_);
  is_closed_ = true;
  changed_.notify_all();
}

}  // namespace swarmanoid
