#include "space_server/space_server.h"

#include <algorithm>

namespace swarmanoid
{

SpaceServer::SpaceServer(const Experiment& experiment, const Assignment& assignment)
    : experiment_(experiment), assignment_(assignment), space_(experiment)
{
}

const SpaceState& SpaceServer::State()
{
  state_.tick = space_.GetTick();
  state_.last = IsLast();
  space_.WritePoses(state_.poses);
  std::sort(changed_slots_.begin(), changed_slots_.end());
  changed_slots_.erase(std::unique(changed_slots_.begin(), changed_slots_.end()), changed_slots_.end());
  state_.attributes.Clear();
  for (const std::uint32_t slot : changed_slots_) state_.attributes.Add(slot, space_.Attributes()[slot]);
  std::sort(moved_.begin(), moved_.end());
  moved_.erase(std::unique(moved_.begin(), moved_.end()), moved_.end());
  state_.moved = moved_;
  return state_;
}

void SpaceServer::WriteSnapshot(SpaceSnapshot& snapshot) const
{
  snapshot.tick = space_.GetTick();
  snapshot.last = IsLast();
  space_.WritePoses(snapshot.poses);
  snapshot.attributes.assign(space_.Attributes().begin(), space_.Attributes().end());
}

void SpaceServer::Advance(std::span<const EngineUpdate* const> updates,
                          std::span<const ControlCommands* const> commands)
{
  changed_slots_.clear();
  moved_.clear();
  for (const ControlCommands* command : commands) Merge(command->attributes);
  for (const EngineUpdate* update : updates)
  {
    space_.SetPoses(assignment_.engines[update->engine].owned, update->poses);
    Merge(update->attributes);
  }
  space_.SetTick(space_.GetTick() + 1);
}

void SpaceServer::Move(const MoveRequest& request)
{
  space_.SetPose(request.entity, request.pose);
  moved_.push_back(request.entity);
}

void SpaceServer::Merge(const AttributeChanges& changes)
{
  for (std::size_t k = 0; k < changes.slots.size(); ++k)
  {
    const std::uint32_t slot = changes.slots[k];
    if (space_.Attributes()[slot] == changes.values[k]) continue;
    space_.SetAttribute(slot, changes.values[k]);
    changed_slots_.push_back(slot);
  }
}

}  // namespace swarmanoid
