// The 3D dynamic engine (<dynamics3d>): rigid bodies solved by ODE. Maps entities, commands, sensors and poses between
// the space and the models; bodies and contacts are the world's. Runs in its engine worker's thread.
#pragma once

#include <memory>
#include <vector>

#include "engine_worker/engines/dynamics3d/dynamics3d_parameters.h"
#include "engine_worker/engines/dynamics3d/model.h"
#include "engine_worker/engines/dynamics3d/objects.h"
#include "engine_worker/engines/dynamics3d/solver_groups.h"
#include "engine_worker/engines/dynamics3d/terrain_shape.h"
#include "engine_worker/physics_engine.h"

namespace swarmanoid
{

class CDynamics3dEngine : public CPhysicsEngine
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
  void SaveState(ByteWriter& state) const override;
  void LoadState(ByteReader& state) override;
  // The engine has no hidden state: each step makes all contacts again, in an order that follows from the entities.
  void Canonicalise() override {}
  void BeginAgain() override;
  bool IsAlwaysCanonical() const override { return true; }
  std::unique_ptr<EngineRegion> MakeRegion(unsigned region, RegionExchange& exchange) override;
  bool RegionsKnowEntities() const override { return true; }
  std::string StatusText() const override;

  // Returns nullptr for entities without a body.
  const dynamics3d::Model* ModelForTest(std::uint32_t entity) const { return scene_->models[entity]; }
  dynamics3d::OdeWorld& WorldForTest() { return *world_; }
  std::size_t GroupCount() const { return groups_->GroupCount(); }
  // Returns into how many parts a step of the last tick was cut at most.
  int MostParts() const { return groups_->MostParts(); }
  // Returns the number of robots that the solver did not move in the last step.
  std::size_t FreeRobotCount() const { return groups_->FreeRobots().Count(); }

private:
  void AddGround();
  void AddHoles();
  void AddTerrain(const CSwarmanoidSpaceEntity& entity);
  void AddArenaWalls();
  void ApplyCommands(const EngineCommands& commands);
  void WritePoses(std::vector<double>& poses) const;
  void WriteSensors(std::span<double> sensors) const;
  std::unique_ptr<dynamics3d::Model> MakeModel(const CSwarmanoidSpaceEntity& entity);
  double CeilingHeight() const;
  dynamics3d::MirrorModel& MirrorOf(std::uint32_t entity);
  void FollowElsewhere();
  void Park(dynamics3d::Model& model);
  void FindActive();

  const CSwarmanoidSpace* space_ = nullptr;
  const EngineLayout* layout_ = nullptr;
  const EngineConfiguration* configuration_ = nullptr;
  dynamics3d::Settings settings_;
  int steps_ = 20;  // of a tick
  double step_seconds_ = 0.005;

  // The world goes before the terrain that its geoms refer to; joints go before the worlds.
  std::vector<std::unique_ptr<dynamics3d::TerrainShape>> terrains_;
  std::unique_ptr<dynamics3d::OdeWorld> world_;
  std::unique_ptr<dynamics3d::SolverGroups> groups_;
  std::unique_ptr<dynamics3d::LinkTable> links_;
  std::unique_ptr<dynamics3d::Scene> scene_;
  std::vector<std::unique_ptr<dynamics3d::Model>> models_;  // in entity order
  std::vector<dynamics3d::Model*> owned_;
  std::vector<dynamics3d::Model*> active_;  // those of them that are not left out
  std::vector<std::uint32_t> elsewhere_;    // their entities that other engines move, ascending
  std::vector<dynamics3d::MirrorModel*> mirrors_;
  std::vector<const CSwarmanoidSpaceEntity*> holes_;
};

// Makes an engine. The processes that need it find it by its name (register_engines.cpp).
extern "C" CPhysicsEngine* MakeDynamics3d();

}  // namespace swarmanoid
