#include "space_server/cluster/checkpoint_writer.h"

#include <fmt/format.h>
#include <algorithm>

namespace swarmanoid
{

CheckpointWriter::CheckpointWriter(ServerSession& session, const Experiment& experiment, std::vector<std::string> parts,
                                   std::uint64_t first_tick, const std::string& folder, std::function<void()> changed)
    : every_(session.World().checkpoint_every),
      run_(session.World().run),
      origin_(OriginOf(experiment)),
      parts_(std::move(parts)),
      folder_(folder),
      changed_(std::move(changed)),
      sent_(first_tick)
{
  if (every_ == 0) return;
  states_in_ = std::make_unique<Subscription<SavedStateMessage>>(
      session.GetBus(), session.World().experiment, [this](const SavedStateMessage& message) { Arrived(message); });
}

void CheckpointWriter::Sending(const SpaceServer& server)
{
  SpaceSnapshot snapshot;
  server.WriteSnapshot(snapshot);
  ByteWriter state;
  server.SaveState(state);
  const std::lock_guard lock(mutex_);
  sent_ = snapshot.tick;
  Checkpoint& checkpoint = unfinished_[snapshot.tick];
  checkpoint.origin = origin_;
  checkpoint.snapshot = std::move(snapshot);
  checkpoint.parts.push_back({kServerPart, state.Bytes()});
  if (IsComplete(checkpoint)) changed_();
}

void CheckpointWriter::Arrived(const SavedStateMessage& message)
{
  if (message.run != run_) return;
  const std::lock_guard lock(mutex_);
  if (!IsDue(message.tick)) throw BadMessage(fmt::format("tick: {} is none of a checkpoint that is due", message.tick));
  if (std::find(parts_.begin(), parts_.end(), message.name) == parts_.end())
    throw BadMessage(fmt::format("name: no process '{}' has a part in checkpoints", message.name));
  Checkpoint& checkpoint = unfinished_[message.tick];
  for (const SavedPart& part : checkpoint.parts)
    if (part.name == message.name) throw BadMessage(fmt::format("name: the part of {} is here already", part.name));
  checkpoint.parts.push_back({message.name, message.state});
  if (IsComplete(checkpoint)) changed_();
}

// One that the server waits for, or the next one: nobody is more than one checkpoint ahead of the server.
bool CheckpointWriter::IsDue(std::uint64_t tick) const
{
  const std::uint64_t next = (sent_ / every_ + 1) * every_;
  return tick == next || (tick <= sent_ && unfinished_.contains(tick));
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
    // As in a run in one process: the server's part, then those of engines and hosts in their order.
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
    if (tick <= sent_) ticks.push_back(tick);
  return ticks;
}

}  // namespace swarmanoid
