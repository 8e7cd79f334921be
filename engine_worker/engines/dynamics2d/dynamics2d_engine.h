// CDynamics2dEngine, the engine `dynamics2d`: rigid bodies with masses, friction and joints on a plane of the space.
// Runs in the engine worker's thread; one thread at a time.
#pragma once

#include <memory>
#include <vector>

#include "engine_worker/engines/dynamics2d/body_models.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_parameters.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_world.h"
#include "engine_worker/engines/plane_robots.h"
#include "engine_worker/physics_engine.h"

namespace swarmanoid
{

class CDynamics2dEngine : public CPhysicsEngine, private PlaneGrips
{
public:
  void Init(const EngineSetup& setup) override;
  void AddEntity(const CSwarmanoidSpaceEntity& entity, EBinding binding) override;
  void Start() override;

  void Update(const EngineCommands& commands, EngineUpdate& update, std::span<double> sensors) override;
  void EntityMoved(std::uint32_t entity) override;
  void TakeOver(std::uint32_t entity, const EntityVelocity& velocity) override;
  void HandOver(std::uint32_t entity) override;
  std::optional<EntityVelocity> VelocityOf(std::uint32_t entity) const override;
  void MirrorMoved(std::uint32_t entity) override;

  void SaveState(ByteWriter& state) const override;
  void LoadState(ByteReader& state) override;
  void Canonicalise() override;
  void BeginAgain() override;
  std::unique_ptr<EngineRegion> MakeRegion(unsigned region, RegionExchange& exchange) override;
  std::string StatusText() const override;

  // Gives an owned entity a velocity in the plane, for tests.
  void SetVelocity(std::uint32_t entity, const dynamics2d::PlaneVelocity& velocity);

private:
  // An entity that this engine moves.
  struct Owned
  {
    const CSwarmanoidSpaceEntity* entity;
    int body;
    PlaneStance stance, first_stance;
    PlanePose first_pose;
  };
  // A body that another engine moves.
  struct Mirror
  {
    const CSwarmanoidSpaceEntity* entity;
    int body;
    bool seen = false;   // `previous` is from the tick before
    PlanePose previous;  // where the space had it
  };
  struct Footbot
  {
    const CSwarmanoidSpaceEntity* entity;
    int body;
    bool has_gripper = false;  // there are commands for it
    double gripper = 0;        // command: 0 open … 1 closed
    std::uint32_t aperture_slot, gripped_slot, turret_slot;
    dynamics2d::PlaneVelocity velocity;  // at the start of the tick
  };

  bool Hold(std::uint32_t robot, std::uint32_t object) override;
  void LetGo(std::uint32_t robot) override { world_->Release(BodyOf(robot)); }
  bool Holds(std::uint32_t robot) const override { return world_->GrippedBy(BodyOf(robot)) != dynamics2d::kNoBody; }

  int BodyOf(std::uint32_t entity) const;
  Footbot& FootbotOf(std::uint32_t entity);
  PlanePose StandingPose(const CSwarmanoidSpaceEntity& entity, PlaneStance& stance) const;
  void ReadCommands(const EngineCommands& commands);
  void ReadWheels(const ChannelBlock& block, std::span<const double> values);
  void CheckFinite(const ChannelBlock& block, std::span<const double> values) const;
  void FollowMirrors();
  bool IsElsewhere(std::uint32_t entity) const;
  void ApplyGrippers();
  void WritePoses(EngineUpdate& update) const;
  void ReportAttributes(EngineUpdate& update) const;
  void WriteSensors(std::span<double> sensors) const;

  const CSwarmanoidSpace* space_ = nullptr;
  const EngineLayout* layout_ = nullptr;
  const EngineConfiguration* configuration_ = nullptr;
  dynamics2d::Dynamics2dParameters parameters_;
  PlaneFrame plane_{PlaneAxis::kZ, 0};
  std::unique_ptr<dynamics2d::Dynamics2dWorld> world_;
  PlaneRobots robots_;
  int steps_ = 4;  // in each tick
  bool reads_accelerometers_ = false;
  std::vector<Owned> owned_;
  std::vector<Mirror> mirrors_;
  std::vector<std::uint32_t> elsewhere_;  // owned entities that other engines move, ascending
  std::vector<Footbot> footbots_;
  std::vector<std::uint32_t> turret_robots_;  // with a motor for their turret
  std::vector<int> body_of_entity_;           // kNoBody if it has none
  std::vector<std::uint32_t> entity_of_body_;
  std::vector<std::uint32_t> footbot_of_entity_;
};

// Makes an engine. The processes that need it find it by its name (register_engines.cpp).
extern "C" CPhysicsEngine* MakeDynamics2d();

}  // namespace swarmanoid
