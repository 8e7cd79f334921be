// Surroundings: what a controller host is told of a tick where states go over a network: of the entities that can move
// those alone that are near its robots. So what a host hears does not grow with the swarm, if robots that are near one
// another are of one host.
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

// Which poses have changed since they were told.
class SentPoses
{
public:
  explicit SentPoses(const CSwarmanoidSpace& space);
  // Of a movable entity, by its number among these: whether its pose is another one than when this was last asked.
  bool HasChanged(std::size_t movable);

private:
  const CSwarmanoidSpace& space_;
  std::vector<std::array<double, 7>> told_;
};

class Surroundings
{
public:
  // `robots`: those of the host. `reach_m`: who is farther away from all of them, in the plane, need not be told. The
  // space outlives it.
  Surroundings(const CSwarmanoidSpace& space, std::span<const std::uint32_t> robots, double reach_m);

  // The part of the state of the space's tick. To be called once for each tick, and all ticks; the first one has the
  // poses of all that are near. Valid until the next call.
  LocalState& Part(const SpaceState& state);

private:
  bool HaveLeftMargin() const;
  void Search(bool all);
  void AddAttributes(const SpaceState& state);

  const CSwarmanoidSpace& space_;
  std::span<const std::uint32_t> robots_;
  PlaneCells<double> cells_;                // as wide as reach and margin
  std::vector<char> is_near_;               // of each cell
  std::vector<char> is_told_;               // of each entity; always of those that cannot move
  std::vector<char> is_always_told_;        // of each that can
  std::vector<std::uint32_t> first_slots_;  // of each entity, and behind the last one that of their presence
  std::vector<double> x_, y_;               // of those that can move, where they were searched
  SentPoses told_poses_;
  bool holds_ = false;                  // there was a search
  std::vector<std::uint32_t> entered_;  // whom the message before had not
  LocalState part_;
};

// What an engine is told likewise: the state without the poses of those that it has moved itself.
class EngineNews
{
public:
  // `owned`: those that the engine moves, ascending. The space outlives it.
  EngineNews(const CSwarmanoidSpace& space, std::span<const std::uint32_t> owned);
  // As Surroundings::Part.
  LocalState& Part(const SpaceState& state);

private:
  const CSwarmanoidSpace& space_;
  std::span<const std::uint32_t> owned_;
  SentPoses told_poses_;
  LocalState part_;
};

}  // namespace swarmanoid
