// Surroundings: the part of the state that a controller host gets over a network. It has only the movable entities near
// the robots of the host. So the message does not grow with the swarm, if robots near each other are of one host.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/math/cells.h"
#include "common/messages/tick_messages.h"
#include "common/space/pose_arrays.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

// Remembers the last sent pose of each movable entity.
class SentPoses
{
public:
  explicit SentPoses(const CSwarmanoidSpace& space);
  // Returns true if the pose of a movable entity differs from its pose at the last call. `movable` is its number among
  // the movable entities.
  bool HasChanged(std::size_t movable);

private:
  const CSwarmanoidSpace& space_;
  std::vector<std::array<double, 7>> told_;
};

class Surroundings
{
public:
  // `robots` are the robots of the host. Entities farther than `reach_m` from all of them, in the plane, may be left
  // out. The space outlives the object.
  Surroundings(const CSwarmanoidSpace& space, std::span<const std::uint32_t> robots, double reach_m);

  // Returns the part of the state of the space's tick. It must be called once for each tick, from the first one on. The
  // first result has the poses of all near entities. The result is valid until the next call.
  LocalState& Part(const SpaceState& state);

private:
  bool HaveLeftMargin() const;
  void Search(bool all);
  void AddAttributes(const SpaceState& state);

  const CSwarmanoidSpace& space_;
  std::span<const std::uint32_t> robots_;
  PlaneCells<double> cells_;                // cells as wide as reach and margin
  std::vector<char> is_near_;               // by cell
  std::vector<char> is_told_;               // by entity; always set for entities that cannot move
  std::vector<char> is_always_told_;        // by movable entity
  std::vector<std::uint32_t> first_slots_;  // by entity; at the end the first slot of their presence
  std::vector<double> x_, y_;               // positions of the movable entities at the last search
  SentPoses told_poses_;
  bool holds_ = false;                  // set if a search was made
  std::vector<std::uint32_t> entered_;  // entities that the last message did not have
  LocalState part_;
};

// The part of the state that an engine gets over a network: all but the poses that the engine computed itself.
class EngineNews
{
public:
  // `owned` are the entities that the engine alone moves, ascending. The space outlives the object.
  EngineNews(const CSwarmanoidSpace& space, std::vector<std::uint32_t> owned);
  // Returns the part of the state of the space's tick. It must be called once for each tick. The result is valid until
  // the next call.
  LocalState& Part(const SpaceState& state);

private:
  const CSwarmanoidSpace& space_;
  std::vector<std::uint32_t> owned_;
  SentPoses told_poses_;
  LocalState part_;
};

}  // namespace swarmanoid
