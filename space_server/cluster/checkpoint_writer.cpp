// Saving costs each process time, so the server asks for it: the state of a tick tells the workers to save theirs after
// the step. The period in the journal is a time, and that of checkpoint files a number of ticks. Ticks are saved only
// where engines are canonical, so that a restored run has the same bits (docs/determinism.md).
//
// Invariant: a checkpoint is written only if it has all parts; parts are in the order of a run in one process, so both
// write the same bytes.
#include "space_server/cluster/checkpoint_writer.h"
#include "space_server/space_server.h"

#include <fmt/format.h>
#include <algorithm>
#include "common/space/space.h"

namespace swarmanoid
{

namespace
{

using namespace std::chrono_literals;

// The journal gets saved states at intervals of this time. A process that replaces another one computes about this much
// again.
constexpr auto kSavePeriod = 500ms;
constexpr std::size_t kWantedKept = 64;

}  // namespace

CheckpointWriter::CheckpointWriter(ServerSession& session, const Experiment& experiment, std::vector<std::string> parts,
                                   std::uint64_t first_tick, std::set<std::uint64_t> saved, const std::string& folder,
                                   JournalWriter* journal, std::function<void()> changed)
    : every_(session.World().checkpoint_every),
      period_(experiment.canonical_period),
      run_(session.World().run),
      first_tick_(first_tick),
      origin_(OriginOf(experiment)),
      parts_(std::move(parts)),
      folder_(folder),
      journal_(journal),
      changed_(std::move(changed)),
      wanted_(std::move(saved)),
      saved_(Clock::now())
{
  if (every_ == 0 && journal_ == nullptr) return;
  states_in_ = std::make_unique<Subscription<SavedStateMessage>>(
      session.GetBus(), session.World().experiment, [this](const SavedStateMessage& message) { Arrived(message); });
}

bool CheckpointWriter::Sending(const SpaceServer& server)
{
  const std::uint64_t tick = server.Space().GetTick();
  if (tick > first_tick_ && (IsOfFile(tick) || (journal_ != nullptr && IsWanted(tick)))) Save(server);
  const std::uint64_t next = tick + 1;
  const bool due = journal_ != nullptr && next % period_ == 0 && Clock::now() - saved_ >= kSavePeriod;
  if (!due && !IsOfFile(next)) return false;
  saved_ = Clock::now();
  const std::lock_guard lock(mutex_);
  wanted_.insert(next);
  while (wanted_.size() > kWantedKept) wanted_.erase(wanted_.begin());
  return true;
}

void CheckpointWriter::Save(const SpaceServer& server)
{
  SpaceSnapshot snapshot;
  server.WriteSnapshot(snapshot);
  const bool of_file = IsOfFile(snapshot.tick);
  // A run that resumes from a finished state would end at once, so the last saved state before the end is used.
  const bool of_journal = journal_ != nullptr && !server.IsFinished();
  if (!of_file && !of_journal) return;
  if (of_journal) journal_->Add(snapshot);
  ByteWriter state;
  try
  {
    server.SaveState(state);
  }
  catch (const std::exception&)
  {
    if (of_file) throw;
    return;
  }
  if (of_journal) journal_->Add(snapshot.tick, {kServerPart, state.Bytes()});
  if (!of_file) return;
  const std::lock_guard lock(mutex_);
  Checkpoint& checkpoint = unfinished_[snapshot.tick];
  checkpoint.origin = origin_;
  checkpoint.snapshot = std::move(snapshot);
  checkpoint.parts.push_back({kServerPart, state.Bytes()});
  if (IsComplete(checkpoint)) changed_();
}

void CheckpointWriter::Arrived(const SavedStateMessage& message)
{
  if (message.run != run_) return;
  if (!IsWanted(message.tick))
    throw BadMessage(fmt::format("tick: {} is none at which states are saved", message.tick));
  if (std::find(parts_.begin(), parts_.end(), message.name) == parts_.end())
    throw BadMessage(fmt::format("name: no process '{}' has a part in checkpoints", message.name));
  if (journal_ != nullptr) journal_->Add(message.tick, {message.name, message.state});
  if (!IsOfFile(message.tick)) return;
  const std::lock_guard lock(mutex_);
  Checkpoint& checkpoint = unfinished_[message.tick];
  // A process that replaces another one may send the same part again.
  for (const SavedPart& part : checkpoint.parts)
    if (part.name == message.name) return;
  checkpoint.parts.push_back({message.name, message.state});
  if (IsComplete(checkpoint)) changed_();
}

bool CheckpointWriter::IsOfFile(std::uint64_t tick) const { return every_ != 0 && tick % every_ == 0; }

bool CheckpointWriter::IsWanted(std::uint64_t tick) const
{
  const std::lock_guard lock(mutex_);
  return wanted_.contains(tick);
}

bool CheckpointWriter::IsComplete(const Checkpoint& checkpoint) const
{
  return checkpoint.parts.size() == parts_.size() + 1;
}

void CheckpointWriter::Work()
{
  while (true)
  {
    Checkpoint checkpoint;
    {
      const std::lock_guard lock(mutex_);
      const auto found = std::find_if(unfinished_.begin(), unfinished_.end(),
                                      [this](const auto& entry) { return IsComplete(entry.second); });
      if (found == unfinished_.end()) return;
      checkpoint = std::move(found->second);
      unfinished_.erase(found);
    }
    // The order is that of a run in one process: the server's part, then those of engines and hosts in their order.
    const auto place = [this](const SavedPart& part)
    { return part.name == kServerPart ? -1 : std::find(parts_.begin(), parts_.end(), part.name) - parts_.begin(); };
    std::sort(checkpoint.parts.begin(), checkpoint.parts.end(),
              [&](const SavedPart& a, const SavedPart& b) { return place(a) < place(b); });
    WriteCheckpoint(folder_ + "/" + CheckpointName(checkpoint.snapshot.tick), checkpoint);
  }
}

std::vector<std::uint64_t> CheckpointWriter::Incomplete() const
{
  std::vector<std::uint64_t> ticks;
  const std::lock_guard lock(mutex_);
  for (const auto& [tick, checkpoint] : unfinished_)
    if (checkpoint.snapshot.tick == tick) ticks.push_back(tick);
  return ticks;
}

}  // namespace swarmanoid
