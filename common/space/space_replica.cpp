// How a replica of the space follows the space server: it applies the state of each tick, or a snapshot.
#include "common/space/space.h"

namespace swarmanoid
{

void CSwarmanoidSpace::Apply(const SpaceState& state)
{
  // The first state of a run, and one that a snapshot has shown already, is of the tick of the space.
  if (state.tick != tick_) AdvanceFields();
  tick_ = state.tick;
  SetPoses(movable_, state.poses);
  SetAttributes(state.attributes);
  fields_.SetCells(state.fields);
  SetDrawing(state.drawing);
}

void CSwarmanoidSpace::Apply(const LocalState& state, std::vector<std::uint32_t>& near)
{
  tick_ = state.tick;
  if (near != state.near)
  {
    near = state.near;
    LeaveOut(near);
  }
  SetPoses(state.entities, state.poses);
  SetAttributes(state.attributes);
}

// In a local state, an entity that is not near counts as outside the arena and holds nothing. The message does not tell
// its grips.
void CSwarmanoidSpace::LeaveOut(const std::vector<std::uint32_t>& near)
{
  AttributeChanges changes;
  for (std::size_t k = 0; k < movable_.size(); ++k)
  {
    const std::uint32_t entity = movable_[k];
    if (IsNear(near, k) || !IsPresent(entity)) continue;
    for (std::uint32_t hand = 0; hand < Hands(entity).size(); ++hand) changes.Add(FirstHandSlot(entity) + hand, 0);
    changes.Add(PresenceSlot(entity), 0);
  }
  SetAttributes(changes);
}

void CSwarmanoidSpace::Apply(const SpaceSnapshot& snapshot)
{
  tick_ = snapshot.tick;
  SetPoses(movable_, snapshot.poses);
  for (std::size_t slot = 0; slot < snapshot.attributes.size(); ++slot)
    attributes_.Set(slot, snapshot.attributes[slot]);
  ++attribute_revision_;
  FindAbsent();
  structure_.FollowAll();
  fields_.Load(snapshot.fields);
  SetDrawing(snapshot.drawing);
}

}  // namespace swarmanoid
