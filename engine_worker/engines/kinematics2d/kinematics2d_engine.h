// The 2D kinematic engine (<dummy_engine>, <kinematics2d>): puts a KinematicWorld on a plane of the space. Maps
// entities, commands, sensors and poses; the motion itself is the world's. Runs in its engine worker's thread.
#pragma once

#include <optional>
#include <vector>

#include "common/threads/worker_pool.h"
#include "engine_worker/engines/kinematics2d/kinematic_world.h"
#include "engine_worker/engines/kinematics2d/plane_writer.h"
#include "engine_worker/engines/near_objects.h"
#include "engine_worker/engines/plane_frame.h"
#include "engine_worker/engines/plane_robots.h"
#include "engine_worker/physics_engine.h"

namespace swarmanoid
{

class Kinematics2dEngine : public CPhysicsEngine, private PlaneGrips
{
public:
  void Init(const EngineSetup& setup) override;
  void AddEntity(const CSwarmanoidSpaceEntity& entity, EBinding binding) override;
  void Start() override;
  void Update(const EngineCommands& commands, EngineUpdate& update, std::span<double> sensors) override;
  void EntityMoved(std::uint32_t entity) override;
  void TakeOver(std::uint32_t entity, const EntityVelocity& velocity) override;
  void HandOver(std::uint32_t entity) override;
  void MirrorMoved(std::uint32_t entity) override;
  void SaveState(ByteWriter& state) const override;
  void LoadState(ByteReader& state) override;
  // The engine has nothing hidden: each step starts from the saved state alone.
  void Canonicalise() override {}
  void BeginAgain() override;
  bool IsAlwaysCanonical() const override { return true; }
  std::unique_ptr<EngineRegion> MakeRegion(unsigned region, RegionExchange& exchange) override;
  std::string StatusText() const override;

  const kinematics2d::KinematicWorld& WorldForTest() const { return world_; }

private:
  struct Mirror
  {
    const CSwarmanoidSpaceEntity* entity = nullptr;
    std::uint32_t body = 0;
    std::uint32_t model = 0;
    std::uint32_t own = kinematics2d::kNobody;  // the body that this engine moves, if the entity changes its engine
    kinematics2d::Pose2 previous{};             // in the tick before
    std::uint8_t is_known = 0;                  // `previous` says how it moves
  };
  struct Footbot
  {
    std::uint32_t body = 0;
    std::uint32_t aperture_slot, gripped_slot, turret_slot;
    std::optional<double> aperture;  // as commanded
  };

  struct Wheels
  {
    double radius = 0;        // m
    double inverse_axle = 0;  // 1/m
  };

  std::uint32_t BodyOf(std::uint32_t entity) const;
  kinematics2d::Pose2 PlanePoseOf(const Pose& pose) const;
  kinematics2d::CollisionModel ModelOf(const CSwarmanoidSpaceEntity& entity) const;
  // Returns the friction of an entity with others: its own, or that of the engine for its kind.
  double FrictionOf(const CSwarmanoidSpaceEntity& entity) const;
  // Returns the outline in which the plane cuts a block, in the frame of the block's plane pose; without polygons if it
  // does not.
  kinematics2d::CollisionModel Outline(const CSwarmanoidSpaceEntity& block, const Pose& at) const;

  bool Hold(std::uint32_t robot, std::uint32_t object) override;
  void LetGo(std::uint32_t robot) override { world_.RemoveGrip(BodyOf(robot)); }
  bool Holds(std::uint32_t robot) const override { return world_.FindGrip(BodyOf(robot)) != nullptr; }

  void AddFixed(const CSwarmanoidSpaceEntity& entity);
  void AddStatic(kinematics2d::CollisionModel shape, double friction);
  void BalanceRegions();
  void FollowMirrors();
  // Puts the body of an entity of another engine where the space has it.
  void FollowGhost(std::uint32_t body, const Pose& pose, bool present);
  // Takes the turret's angle from the space, and forgets the commanded aperture.
  void FollowAttributes(Footbot& footbot);
  void ApplyCommands(const EngineCommands& commands, WorkerPool* pool);
  void DriveWheels(const ChannelBlock& block, std::span<const double> values, WorkerPool* pool);
  void DrivePropellers(const ChannelBlock& block, std::span<const double> values);
  void TurnTurrets(const ChannelBlock& block, std::span<const double> values);
  void UseGrippers(const ChannelBlock& block, std::span<const double> values);
  double GapTo(std::uint32_t body, double x, double y) const;
  void GripNearest(std::uint32_t body);
  void ReportFootbots(AttributeChanges& changes);
  void ReadEncoders(const ChannelBlock& block, std::span<double> values) const;
  void ReadTurretTorques(const ChannelBlock& block, std::span<double> values) const;
  bool IsFootbot(std::uint32_t body) const;
  Footbot& FootbotOf(std::uint32_t body);
  const Footbot& FootbotOf(std::uint32_t body) const;
  void CheckCommand(double sum, std::uint32_t entity, const ChannelBlock& block) const;
  double TickSeconds() const;

  const CSwarmanoidSpace* space_ = nullptr;
  const EngineLayout* layout_ = nullptr;
  const EngineConfiguration* configuration_ = nullptr;
  PlaneFrame frame_{PlaneAxis::kZ, 0};
  int subclock_ = 1;
  unsigned threads_ = 1;
  double friction_ = 0, wall_friction_ = 0;  // of bodies that move, and of those that never do
  WorkerPool* pool_ = nullptr;               // of the process
  RegionTeam* team_ = nullptr;
  std::uint64_t updates_ = 0;
  kinematics2d::KinematicWorld world_;
  PlaneWriter writer_;
  PlaneRobots robots_;

  std::vector<const CSwarmanoidSpaceEntity*> owned_;  // body k is owned_[k]; until the start
  std::vector<Mirror> mirrors_;
  std::vector<std::uint8_t> is_elsewhere_;  // by owned body: another engine moves its entity
  std::vector<const CSwarmanoidSpaceEntity*> fixed_;
  std::vector<Wheels> wheels_;                   // by body; 0 for those without
  std::vector<std::uint32_t> preys_;             // bodies
  NearObjects near_preys_;                       // by place in preys_
  std::vector<Footbot> footbots_;                // owned, by body
  std::vector<kinematics2d::Pose2> tick_start_;  // of each of them, if their traction is sensed
  bool footbots_change_ = false;                 // their turrets or grippers are commanded, in some tick
  std::uint64_t reported_ = 0;  // CSwarmanoidSpace::AttributeRevision when they last had nothing to report
};

}  // namespace swarmanoid
