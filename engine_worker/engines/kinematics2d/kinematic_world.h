// A closed 2D world of rigid outlines that move as they are told (first order: velocities, no masses), bounce off each
// other elastically and without friction, and grip preys. It knows nothing of the simulator. The kinematic engine calls
// it in its worker's thread. Lengths are in metres, angles in radians, times in seconds.
//
// The world is the interface to a PlaneState; plane_step.h lists the stages that move it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/messages/regions.h"
#include "common/serialisation/bytes.h"
#include "engine_worker/engines/kinematics2d/plane_step.h"

namespace swarmanoid::kinematics2d
{

class RegionTasks;

class KinematicWorld
{
public:
  // With an elasticity of 1 a collision gives the whole approach back, with 0 none of it.
  explicit KinematicWorld(double elasticity = 1);
  ~KinematicWorld();
  KinematicWorld(KinematicWorld&&) noexcept;
  KinematicWorld& operator=(KinematicWorld&&) noexcept;

  // A world is built in this order: models, bodies (numbered from 0) and static shapes, Start.
  std::uint32_t AddModel(CollisionModel model);
  // Only followers may have this model. It must stay within the circle that the first outline filled.
  void ReplaceModel(std::uint32_t model, CollisionModel outline);
  // A follower is moved from outside (Follow) and pushes without being pushed.
  std::uint32_t AddBody(std::uint32_t model, const Pose2& pose, bool follower = false);
  void AddStatic(CollisionModel shape);  // in the coordinates of the plane
  // `area` is where most bodies will be. `threads` work together, those of `pool` if there is one; their number changes
  // no bit of the results.
  void Start(Bounds area, unsigned threads = 1, WorkerPool* pool = nullptr);

  // A body keeps its twist until it gets another one.
  void SetTwist(std::uint32_t body, const Twist& twist) { plane_.bodies.twists.Set(body, twist); }
  // The turret turns against the body at this rate (rad/s); while its body grips, it is locked.
  void SetTurretRate(std::uint32_t body, double rate) { plane_.bodies.SetTurretRate(body, rate); }
  void SetTurretAngle(std::uint32_t body, double angle) { plane_.bodies.SetTurretAngle(body, angle); }
  // Bodies that are not present touch nothing. All are at first.
  void SetPresent(std::uint32_t body, bool present);
  // Says where a follower is, where it will be at the end of the next Advance, and whether it is in the plane at all.
  void Follow(std::uint32_t body, const Pose2& from, const Pose2& goal, bool present);
  // Puts a body elsewhere at once. Its grips stay: the caller also puts those bodies there that it grips or that grip
  // it.
  void Place(std::uint32_t body, const Pose2& pose);
  // Moves everything by `seconds`, in at least `steps` equal steps. Fast bodies make it use more, so that nothing
  // passes through anything. No two parts of outlines overlap deeper afterwards than AllowedOverlapForTest, or than
  // they did before. Only followers may come into a body that has no room to give way.
  // Throws std::runtime_error for speeds that would need too many steps.
  void Advance(double seconds, int steps);

  // The prey must be a free body or the prey of other grips; the body must not be gripping or gripped.
  void AddGrip(std::uint32_t body, std::uint32_t prey);
  void RemoveGrip(std::uint32_t body);
  // Ends the grips for which `ends(grip)` is true.
  template <class Ends>
  void RemoveGripsIf(const Ends& ends)
  {
    if (std::erase_if(plane_.groups.grips, ends) > 0) plane_.groups.Rebuild(plane_.bodies);
  }
  const Grip* FindGrip(std::uint32_t body) const { return plane_.groups.FindGrip(body); }
  const std::vector<Grip>& Grips() const { return plane_.groups.grips; }

  std::size_t BodyCount() const { return plane_.bodies.count; }
  const PoseStore& Poses() const { return plane_.bodies.now; }
  Twist TwistOf(std::uint32_t body) const { return plane_.bodies.twists.Get(body); }
  Pose2 PoseOf(std::uint32_t body) const { return plane_.bodies.now.Get(body); }
  double TurretAngle(std::uint32_t body) const { return plane_.bodies.turret_angle[body]; }
  const CollisionModel& ModelOf(std::uint32_t body) const { return plane_.bodies.ModelOf(body); }
  Placed PlacedAt(std::uint32_t body) const { return plane_.bodies.PlacedNow(body); }
  // Returns the deepest overlap of two bodies, or of a body and the static shapes.
  double OverlapForTest(std::uint32_t a, std::uint32_t b) const;
  double StaticOverlapForTest(std::uint32_t body) const;
  // The arc that the body's centre drove forward (m) and its turn (rad) in the last Advance, collisions included.
  // They are kept only after KeepTravel().
  void KeepTravel() { plane_.bodies.keeps_travel = true; }
  double TravelForward(std::uint32_t body) const { return plane_.bodies.travel_forward[body]; }
  double TravelTurn(std::uint32_t body) const { return plane_.bodies.travel_turn[body]; }
  const WorldStatistics& Statistics() const { return plane_.statistics; }
  double AllowedOverlapForTest() const { return plane_.lengths.allowed; }

  // Splits the world after Start: the regions of the team do the work of Advance from now on. Each computes some blocks
  // of the plane (MoveCuts; at first region 0 has all). All bodies go bit by bit as before, wherever the cuts are.
  // `team` outlives the world.
  void Split(RegionTeam& team);
  // The blocks of cells are numbered row by row; a plane can be cut along their borders.
  std::uint32_t BlockColumns() const { return plane_.contacts.broad.BlockColumns(); }
  std::uint32_t BlockCount() const { return plane_.contacts.broad.BlockCount(); }
  std::vector<std::uint32_t> BodiesInBlocks() const;
  // Sets new cuts: region_of_block[k] has block k, from the next Advance on. Throws std::runtime_error for invalid
  // cuts.
  void MoveCuts(std::span<const std::uint8_t> region_of_block);

  // The state has poses, turrets and grips. Twists and followers' goals are commands and not part of it.
  void SaveState(ByteWriter& state) const;
  void LoadState(ByteReader& state);

private:
  PlaneState plane_;
  std::unique_ptr<RegionTasks> regions_;  // nullptr if the world does all by itself
};

}  // namespace swarmanoid::kinematics2d
