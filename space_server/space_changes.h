// These rules say how entities may be moved, added and removed from outside physics. Experiment functions (SpaceEditor)
// and users (RunControl) share them. SpaceServer::Move carries out the accepted changes.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/messages/tick_messages.h"
#include "common/space/entity.h"
#include "idl/control_request_message.h"
#include "space_server/space_server.h"

namespace swarmanoid
{

// All functions below throw std::invalid_argument that names the entity and the mistake.

// Returns an entity that can move and is in the arena.
const CSwarmanoidSpaceEntity& FindToMove(const CSwarmanoidSpace& space, std::string_view id);
// Returns an entity that can be added and is not in the arena: the one of that id, or the next one of the <reserve> of
// that id.
const CSwarmanoidSpaceEntity& FindToAdd(const CSwarmanoidSpace& space, std::string_view id);
// Returns an entity that can be removed and is in the arena.
const CSwarmanoidSpaceEntity& FindToRemove(const CSwarmanoidSpace& space, std::string_view id);

// Returns an entity in the arena whose body would overlap the entity's body at this pose, with one engine having both.
// nullptr means that the position is free. The check uses the plain bodies without terrain, as the reading of an
// experiment file does. `together` (ascending) are entities that move with it.
const CSwarmanoidSpaceEntity* FindInTheWay(const CSwarmanoidSpace& space, const CSwarmanoidSpaceEntity& entity,
                                           const Pose& pose, std::span<const std::uint32_t> together = {});
void RequireFree(const CSwarmanoidSpace& space, const CSwarmanoidSpaceEntity& entity, const Pose& pose,
                 std::span<const std::uint32_t> together = {});
// The entities of these moves (ascending) move together.
void RequireFree(const CSwarmanoidSpace& space, const std::vector<MoveRequest>& moves);

// Returns the moves that bring an entity to a pose, with all entities that are connected to it by grips, as one rigid
// body.
std::vector<MoveRequest> CompoundAt(const CSwarmanoidSpace& space, const CSwarmanoidSpaceEntity& entity,
                                    const Pose& pose);
// Returns the move that takes an entity out of the arena, to its waiting pose.
MoveRequest Removal(const CSwarmanoidSpaceEntity& entity);

// The changes that a user's request asks for. The orders must be without error (OrderError).
struct SpaceChange
{
  std::vector<MoveRequest> moves;
  std::string entity;  // its id; if a reserve was named, the one that was taken
  std::string done;    // "moved 'fb_0'"
};
SpaceChange ReadMove(const ControlOrder& order, const CSwarmanoidSpace& space);
SpaceChange ReadDetachment(const ControlOrder& order, const CSwarmanoidSpace& space);
SpaceChange ReadAddition(const ControlOrder& order, const CSwarmanoidSpace& space);
SpaceChange ReadRemoval(const ControlOrder& order, const CSwarmanoidSpace& space);

}  // namespace swarmanoid
