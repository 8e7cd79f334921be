// The entities of an engine that change their engine when they leave its volume (common/experiment/engine_volumes.h).
// The space says which engine moves each of them. VolumeMembers tells the engine when that changed, and keeps what the
// engine computes about entities of other engines out of its update. Used by EngineWorker, in its thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine_worker/physics_engine.h"

namespace swarmanoid
{

// Returns the velocity at the end of a way of `seconds` along a helix, which is an arc on a plane.
EntityVelocity VelocityAfter(const Pose& from, const Pose& to, double seconds);

// Returns whether an engine moves an entity of another engine along in each tick, as a ghost: from its pose and
// velocity and by its drive, with its own mass. Robots at both sides of a border then push each other as in one engine.
// Ghosts are all entities within kGhostMargin_m of the volume that are not bound (IsBound). Others are mirrors.
inline constexpr double kGhostMargin_m = 0.5;
bool IsGhost(const CSwarmanoidSpace& space, const EngineVolume& volume, std::uint32_t entity);

class VolumeMembers
{
public:
  // The references outlive it.
  VolumeMembers(const CSwarmanoidSpace& space, const Assignment& assignment, std::uint32_t engine);

  // Hands over the entities that other engines move at the start. Called after CPhysicsEngine::Start.
  void Begin(CPhysicsEngine& engine);
  // Calls HandOver, then TakeOver, for all entities that changed their engine since the last call.
  void Follow(CPhysicsEngine& engine);
  // Returns the owned entities that another engine moves, ascending.
  std::span<const std::uint32_t> Elsewhere() const { return elsewhere_; }
  bool IsElsewhere(std::uint32_t entity) const;
  // Sets the commands of robots of other engines to 0, except those of their drive.
  void StopElsewhere(std::span<double> commands) const;
  // Gives entities of other engines their poses in the space, and drops what the engine reports about them.
  void LeaveOutElsewhere(EngineUpdate& update) const;
  // Adds the velocities of entities that left the volume.
  void TellVelocities(const CPhysicsEngine& engine, EngineUpdate& update) const;

  void SaveState(ByteWriter& state) const;
  // Brings the engine to the division of the saved state. Its own state must be loaded afterwards.
  void LoadState(ByteReader& state, CPhysicsEngine& engine);

private:
  std::uint32_t EntityOf(const VolumeMember& member) const { return layout_.owned[member.place]; }
  template <class IsMoved>
  void Divide(CPhysicsEngine& engine, const IsMoved& is_moved);
  EntityVelocity SavedVelocity(const VolumeMember& member) const;

  const CSwarmanoidSpace& space_;
  const EngineLayout& layout_;
  std::uint32_t engine_;
  std::vector<std::uint8_t> moves_;       // by member: whether the engine moves it
  std::vector<std::uint32_t> elsewhere_;  // ascending
};

}  // namespace swarmanoid
