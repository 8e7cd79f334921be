// Checks of values that enter the state: finite numbers, unit quaternions, slots that exist, poses within the limit of
// the arena. The space server checks all that it merges. Engine workers check the results of their engine, and
// controller hosts the commands of their controllers. Whole arrays are checked in one pass without branches. Only if
// that finds a mistake is its place searched. Any thread may call these functions.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/math/pose.h"
#include "common/messages/assignment.h"
#include "common/messages/tick_messages.h"

namespace swarmanoid
{

class CSwarmanoidSpace;
class WorkerPool;

// A value must not enter the state. what() names the entity and the value. The caller adds the source and the tick.
class StateError : public std::invalid_argument
{
public:
  using std::invalid_argument::invalid_argument;
};

// The squared norm of an orientation may differ from 1 by this much.
inline constexpr double kNormTolerance = 1e-6;

// The checks throw StateError. Poses are structures of arrays over `entities`, as in EngineUpdate. CheckPoses requires
// the right count of numbers, all finite, and orientations of norm 1. The threads of a pool share the work.
void CheckPoses(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities, std::span<const double> poses,
                WorkerPool* pool = nullptr);
// Returns the entities that are present but farther outside the arena than Experiment::limit_m, as indices into
// `entities`.
std::vector<std::size_t> FindBeyondLimit(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities,
                                         std::span<const double> poses, WorkerPool* pool = nullptr);
// Throws unless all entities are within the limit.
void CheckWithinLimit(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities,
                      std::span<const double> poses, WorkerPool* pool = nullptr);
// Throws if an entity that `engine` moves left the volumes of all engines that can move it. `poses` are of
// layout.owned.
void CheckInVolumes(const CSwarmanoidSpace& space, std::uint32_t engine, const EngineLayout& layout,
                    std::span<const double> poses);
// Puts the pose that the owned entity at `place` has in the space into `poses` of layout.owned.
void PutPose(const CSwarmanoidSpace& space, const EngineLayout& layout, std::size_t place, std::span<double> poses);
// Checks the new pose of an entity in the arena.
void CheckPose(const CSwarmanoidSpace& space, std::uint32_t entity, const Pose& pose);

// Checks that the slots belong to entities (not to the presence), and that the values are of their kind.
void CheckAttributes(const CSwarmanoidSpace& space, const AttributeChanges& changes);
void CheckAttribute(const CSwarmanoidSpace& space, std::uint32_t slot, double value);

// Checks the grips after the changes of an engine, which CheckAttributes has accepted. Only kinds that can grip and be
// gripped, one movable entity for each robot, and no loops are allowed. Only entities that the engine moves (`owned`,
// ascending) may change.
void CheckHolds(const CSwarmanoidSpace& space, std::span<const std::uint32_t> owned, const AttributeChanges& changes);
// Throws if the slot is one of "gripped", which only engines may set.
void CheckIsNoHold(const CSwarmanoidSpace& space, std::uint32_t slot);

// Returns the entity that has a slot.
std::uint32_t EntityOfSlot(const CSwarmanoidSpace& space, std::uint32_t slot);

// Checks a saved state: it must have as many numbers as the space, and each number must be valid. Throws StateError.
void CheckSnapshot(const CSwarmanoidSpace& space, const SpaceSnapshot& snapshot);

// Checks that all values of the channels are finite. `what` names them in messages: "commands" or "readings".
void CheckChannels(const CSwarmanoidSpace& space, std::span<const ChannelBlock> blocks, std::span<const double> values,
                   const char* what);

}  // namespace swarmanoid
