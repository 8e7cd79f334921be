// The 3D dynamic engine (<dynamics3d>): rigid bodies solved by ODE. Maps entities, commands, sensors and poses between
// the space and the models; bodies and contacts are the world's. Runs in its engine worker's thread.
#pragma once

#include <memory>
#include <vector>

#include "engine_worker/engines/dynamics3d/contact_free_set.h"
#include "engine_worker/engines/dynamics3d/dynamics3d_parameters.h"
#include "engine_worker/engines/dynamics3d/model.h"
#include "engine_worker/engines/dynamics3d/objects.h"
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
  void SaveState(ByteWriter& state) const override;
  void LoadState(ByteReader& state) override;
  // The engine has no hidden state: each step makes all contacts again, in an order that follows from the entities.
  void Canonicalise() override {}
  bool IsAlwaysCanonical() const override { return true; }
  std::string StatusText() const override;

  // Returns nullptr for entities without a body.
  const dynamics3d::Model* ModelForTest(std::uint32_t entity) const { return scene_->models[entity]; }
  dynamics3d::OdeWorld& WorldForTest() { return *world_; }
  // Returns the number of robots that the solver did not move in the last step.
  std::size_t FreeRobotCount() const { return free_robots_ ? free_robots_->Count() : 0; }

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

  const CSwarmanoidSpace* space_ = nullptr;
  const EngineLayout* layout_ = nullptr;
  const EngineConfiguration* configuration_ = nullptr;
  dynamics3d::Settings settings_;
  int steps_ = 20;  // of a tick
  double step_seconds_ = 0.005;

  // The world goes before the terrain that its geoms refer to; joints go before the world.
  std::vector<std::unique_ptr<dynamics3d::TerrainShape>> terrains_;
  std::unique_ptr<dynamics3d::OdeWorld> world_;
  std::unique_ptr<dynamics3d::LinkTable> links_;
  std::unique_ptr<dynamics3d::Scene> scene_;
  std::unique_ptr<dynamics3d::ContactFreeSet> free_robots_;  // nullptr: all are solved
  std::vector<std::unique_ptr<dynamics3d::Model>> models_;   // in entity order
  std::vector<dynamics3d::Model*> owned_;
  std::vector<dynamics3d::MirrorModel*> mirrors_;
  std::vector<const CSwarmanoidSpaceEntity*> holes_;
};

}  // namespace swarmanoid
