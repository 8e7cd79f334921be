// A kinematic engine in its own space, made without files: entities, one engine, channels.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/math/elementary.h"
#include "common/threads/worker_pool.h"
#include "engine_worker/engine_worker.h"
#include "engine_worker/engines/kinematics2d/kinematics2d_engine.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{

class EngineFixture
{
public:
  explicit EngineFixture(WorkerPool* pool = nullptr) : pool_(pool)
  {
    RegisterBuiltinEngines();
    experiment_.arena_size = Vector3(10, 10, 3);
    engine_configuration_.tag = "dummy_engine";
    engine_configuration_.id = "plane";
  }

  void Parameter(const std::string& name, const std::string& value) { node_->attributes.push_back({name, value, {}}); }
  EngineConfiguration& Configuration() { return engine_configuration_; }
  // Before the start.
  Experiment& GetExperiment() { return experiment_; }

  std::uint32_t Add(EntityKind kind, const Vector3& position, const EulerAngles& angles = {},
                    const Vector3& size = Vector3::Zero(), bool movable = true)
  {
    EntityConfiguration entity;
    entity.kind = kind;
    entity.id = "e" + std::to_string(experiment_.entities.size());
    entity.pose = {position, QuaternionFromEuler(angles)};
    entity.movable = movable;
    entity.size = IsRobot(kind) ? DescriptionOf(kind).size : size;
    experiment_.entities.push_back(entity);
    return static_cast<std::uint32_t>(experiment_.entities.size() - 1);
  }
  // Adds a terrain from a map with an absolute path, at the origin.
  void AddTerrain(const std::string& octomap)
  {
    experiment_.entities[Add(EntityKind::kTerrain, Vector3::Zero(), {}, Vector3::Zero(), false)].tree =
        test::TerrainTree("octomap", {{"file", octomap}});
  }
  std::uint32_t AddMirror(EntityKind kind, const Vector3& position, const Vector3& size = Vector3::Zero())
  {
    const std::uint32_t entity = Add(kind, position, {}, size);
    mirrors_.push_back(entity);
    return entity;
  }

  void AddCommands(const std::string& channel, int width, std::vector<std::uint32_t> robots)
  {
    layout_.commands.push_back({channel, width, std::move(robots), layout_.command_size});
    layout_.command_size += layout_.commands.back().entities.size() * static_cast<std::size_t>(width);
  }
  void AddSensors(const std::string& channel, int width, std::vector<std::uint32_t> robots)
  {
    layout_.sensors.push_back({channel, width, std::move(robots), layout_.sensor_size});
    layout_.sensor_size += layout_.sensors.back().entities.size() * static_cast<std::size_t>(width);
  }

  void Start()
  {
    engine_configuration_.tree = TConfigurationTree(node_);
    space_ = std::make_unique<CSwarmanoidSpace>(experiment_);
    for (std::uint32_t k = 0; k < experiment_.entities.size(); ++k)
      if (!experiment_.entities[k].movable)
        layout_.fixed.push_back(k);
      else if (std::find(mirrors_.begin(), mirrors_.end(), k) != mirrors_.end())
        layout_.mirrored.push_back(k);
      else
        layout_.owned.push_back(k);
    engine_ = MakeEngine();
    commands_.assign(layout_.command_size, 0);
    sensors_.assign(layout_.sensor_size, 0);
    update_.poses.resize(7 * layout_.owned.size());
  }

  // Makes a second engine of the same experiment, as a restored process does.
  std::unique_ptr<CPhysicsEngine> MakeEngine()
  {
    const auto* entry = PluginRegistry<CPhysicsEngine>::Instance().Find(engine_configuration_.tag);
    std::unique_ptr<CPhysicsEngine> engine = entry->create();
    engine->Init({engine_configuration_, Parameters(engine_configuration_.tree, entry->description.parameters), *space_,
                  layout_, nullptr, pool_ == nullptr ? 1 : pool_->Threads(), pool_});
    for (std::uint32_t k = 0; k < space_->Size(); ++k)
    {
      const bool mirror = std::find(mirrors_.begin(), mirrors_.end(), k) != mirrors_.end();
      engine->AddEntity(space_->GetEntity(k), !experiment_.entities[k].movable ? EBinding::kFixed
                                              : mirror                         ? EBinding::kMirror
                                                                               : EBinding::kOwned);
    }
    engine->Start();
    return engine;
  }

  // The first command, tick or look at the space or the engine starts it, too.
  double& Command(std::size_t value)
  {
    EnsureStarted();
    return commands_[value];
  }
  double Sensor(std::size_t value) const { return sensors_[value]; }

  // Advances the engine and the space by one tick.
  void Tick()
  {
    EnsureStarted();
    update_.attributes.Clear();
    engine_->Update({layout_.commands, commands_}, update_, sensors_);
    space_->SetPoses(layout_.owned, update_.poses);
    space_->SetAttributes(update_.attributes);
    space_->SetTick(space_->GetTick() + 1);
  }
  void Ticks(int count)
  {
    for (int k = 0; k < count; ++k) Tick();
  }

  Pose PoseOf(std::uint32_t entity) { return Space().GetPose(entity); }
  CSwarmanoidSpace& Space()
  {
    EnsureStarted();
    return *space_;
  }
  CPhysicsEngine& Engine()
  {
    EnsureStarted();
    return *engine_;
  }
  std::unique_ptr<CPhysicsEngine>& EnginePointer() { return engine_; }
  const EngineUpdate& LastUpdate() const { return update_; }

private:
  void EnsureStarted()
  {
    if (engine_ == nullptr) Start();
  }

  WorkerPool* pool_;
  Experiment experiment_;
  EngineConfiguration engine_configuration_;
  std::shared_ptr<ConfigurationNode> node_ = std::make_shared<ConfigurationNode>();
  std::vector<std::uint32_t> mirrors_;
  EngineLayout layout_;
  std::unique_ptr<CSwarmanoidSpace> space_;
  std::unique_ptr<CPhysicsEngine> engine_;
  std::vector<double> commands_, sensors_;
  EngineUpdate update_;
};

// Returns the angular velocity of a wheel (rad/s) for a ground speed (m/s).
inline double WheelSpeed(double speed) { return speed / kinematics2d::kFootbotWheelRadius; }

}  // namespace swarmanoid
