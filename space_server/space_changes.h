// Changes of the arena from outside physics: who may be moved, added and removed, and where to. Experiment functions
// (SpaceEditor) and users (RunControl) share these rules; what passes is carried out by SpaceServer::Move.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/messages/control_request.h"
#include "common/messages/tick_messages.h"
#include "common/space/entity.h"
#include "space_server/space_server.h"

namespace swarmanoid
{

// All of these throw std::invalid_argument that names the entity and what is wrong.

// An entity that can move and is in the arena.
const CSwarmanoidSpaceEntity& FindToMove(const CSwarmanoidSpace& space, std::string_view id);
// An entity that can come, and is not in the arena: the one of that id, or the next one of the <reserve> of that id.
const CSwarmanoidSpaceEntity& FindToAdd(const CSwarmanoidSpace& space, std::string_view id);
// An entity that can go, and is in the arena.
const CSwarmanoidSpaceEntity& FindToRemove(const CSwarmanoidSpace& space, std::string_view id);

// One that is in the arena and that the entity, at this pose, would stick in: their bodies overlap, and an engine has
// both. nullptr if the place is free. As when the experiment file is read: by the plain bodies, without terrain.
// `together` (ascending): entities that go elsewhere with it.
const CSwarmanoidSpaceEntity* FindInTheWay(const CSwarmanoidSpace& space, const CSwarmanoidSpaceEntity& entity,
                                           const Pose& pose, std::span<const std::uint32_t> together = {});
void RequireFree(const CSwarmanoidSpace& space, const CSwarmanoidSpaceEntity& entity, const Pose& pose,
                 std::span<const std::uint32_t> together = {});

// An entity goes to a pose, and all that holds it or is held with it, as one rigid body.
std::vector<MoveRequest> CompoundAt(const CSwarmanoidSpace& space, const CSwarmanoidSpaceEntity& entity,
                                    const Pose& pose);
// An entity goes to where it waits while it is not in the arena.
MoveRequest Removal(const CSwarmanoidSpaceEntity& entity);

// What requests of users ask for. Their orders are without error (OrderError).
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
