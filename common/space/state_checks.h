// What may enter the state: finite numbers, unit quaternions, slots that exist, poses within reach of the arena. Asked
// by the space server about all that it merges, by engine workers about what their engine gives, and by controller
// hosts about what their controllers command. Whole arrays in one pass without branches; only if that finds a
// mistake is it looked for. Any thread.
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

// Something that must not enter the state. what() names the entity and the value; who gave it and when is added by
// those who ask.
class StateError : public std::invalid_argument
{
public:
  using std::invalid_argument::invalid_argument;
};

// How far the squared norm of an orientation may be from 1.
inline constexpr double kNormTolerance = 1e-6;

bool AllFinite(std::span<const double> values);

// Throw StateError. Poses are structures of arrays over `entities`, as in EngineUpdate.
// As many numbers as there should be, all finite, orientations of norm 1.
void CheckPoses(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities, std::span<const double> poses);
// Which of them are in the arena by their presence, but farther outside than Experiment::limit_m: places in `entities`.
std::vector<std::size_t> FindBeyondLimit(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities,
                                         std::span<const double> poses);
// None of them is.
void CheckWithinLimit(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities,
                      std::span<const double> poses);
// What is to be the pose of an entity in the arena.
void CheckPose(const CSwarmanoidSpace& space, std::uint32_t entity, const Pose& pose);

// Slots of entities (none of the presence) with values of their kind.
void CheckAttributes(const CSwarmanoidSpace& space, const AttributeChanges& changes);
void CheckAttribute(const CSwarmanoidSpace& space, std::uint32_t slot, double value);

// Who holds whom after the changes of an engine, of which CheckAttributes finds nothing wrong: kinds that can grip and
// be gripped, one movable thing for each robot, no loops, and nobody but those that the engine moves (`owned`,
// ascending).
void CheckHolds(const CSwarmanoidSpace& space, std::span<const std::uint32_t> owned, const AttributeChanges& changes);
// Whether a slot says who is held: only engines tell that.
void CheckIsNoHold(const CSwarmanoidSpace& space, std::uint32_t slot);

// The entity that has a slot.
std::uint32_t EntityOfSlot(const CSwarmanoidSpace& space, std::uint32_t slot);

// A state that was saved: as many numbers as the space has, each as it must be. Throws StateError.
void CheckSnapshot(const CSwarmanoidSpace& space, const SpaceSnapshot& snapshot);

// All values of the channels finite; `what` says what they are: "commands" or "readings".
void CheckChannels(const CSwarmanoidSpace& space, std::span<const ChannelBlock> blocks, std::span<const double> values,
                   const char* what);

}  // namespace swarmanoid
