// A rigid-body engine over a small experiment put together in memory, driven tick by tick without any other role. Base
// of the test worlds of dynamics2d and dynamics3d.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/math/elementary.h"
#include "common/space/space.h"
#include "engine_worker/physics_engine.h"

namespace swarmanoid
{

template <class Engine>
class EngineTestWorld
{
public:
  EngineTestWorld(const std::string& tag, std::vector<ParameterSpec> parameters)
      : parameter_table_(std::move(parameters))
  {
    configuration_.tag = tag;
    configuration_.id = "engine";
    experiment.arena_size = {10, 10, 3};
  }

  Experiment experiment;

  void Set(const std::string& parameter, const std::string& value)
  {
    engine_->attributes.push_back({parameter, value, {}});
  }
  void SetSubclock(int subclock) { configuration_.subclock = subclock; }

  std::uint32_t Add(EntityKind kind, const Vector3& position, const Quaternion& orientation, const Vector3& size,
                    double mass = 0, bool movable = true)
  {
    EntityConfiguration entity;
    entity.kind = kind;
    entity.id = "e" + std::to_string(experiment.entities.size());
    entity.pose = {position, orientation};
    entity.size = size;
    entity.mass_kg = mass;
    entity.movable = movable;
    experiment.entities.push_back(entity);
    return static_cast<std::uint32_t>(experiment.entities.size() - 1);
  }
  std::uint32_t AddFootbot(const Vector3& position, double yaw = 0)
  {
    return Add(EntityKind::kFootbot, position, QuaternionFromYaw(yaw), {0.085036758, 0.085036758, 0.146899733});
  }
  std::uint32_t AddEyebot(const Vector3& position, double yaw = 0)
  {
    return Add(EntityKind::kEyebot, position, QuaternionFromYaw(yaw), {0.25, 0.25, 0.566});
  }
  std::uint32_t AddPrey(const Vector3& position, double mass, double radius = 0.1, double height = 0.1)
  {
    return Add(EntityKind::kCylindricPrey, position, Quaternion::Identity(), {radius, radius, height}, mass);
  }
  std::uint32_t AddBlock(const Vector3& centre, const Vector3& size, double mass,
                         const Quaternion& orientation = Quaternion::Identity())
  {
    return Add(EntityKind::kBlock, centre, orientation, size, mass, true);
  }
  std::uint32_t AddWall(const Vector3& centre, const Vector3& size, double yaw = 0)
  {
    return Add(EntityKind::kBlock, centre, QuaternionFromYaw(yaw), size, 0, false);
  }
  // A terrain from a file, as <terrain><KIND file=… size=… height=…/></terrain> says.
  std::uint32_t AddTerrain(const std::string& kind, const std::vector<std::pair<std::string, std::string>>& attributes,
                           const Vector3& position)
  {
    auto source = std::make_shared<ConfigurationNode>();
    source->name = kind;
    for (const auto& [name, value] : attributes) source->attributes.push_back({name, value, {}});
    auto node = std::make_shared<ConfigurationNode>();
    node->children.push_back(source);
    const std::uint32_t entity = Add(EntityKind::kTerrain, position, Quaternion::Identity(), Vector3::Zero(), 0, false);
    experiment.entities[entity].tree = TConfigurationTree(node);
    return entity;
  }
  void MakeMirror(std::uint32_t entity) { mirrors_.push_back(entity); }

  // For all robots of the kind in the channel's name, mirrors aside.
  void AddCommands(const std::string& channel, int width)
  {
    AddChannel(layout_.commands, layout_.command_size, channel, width);
  }
  void AddSensors(const std::string& channel, int width)
  {
    AddChannel(layout_.sensors, layout_.sensor_size, channel, width);
  }

  // After all entities and channels; more than one engine of the same experiment can be made.
  void Start()
  {
    for (std::uint32_t i = 0; i < experiment.entities.size(); ++i)
    {
      configuration_.entities.push_back(i);
      (!experiment.entities[i].movable ? layout_.fixed : IsMirror(i) ? layout_.mirrored : layout_.owned).push_back(i);
    }
    space_ = std::make_unique<CSwarmanoidSpace>(experiment);
    commands_.assign(layout_.command_size, 0);
    sensors_.assign(layout_.sensor_size, 0);
    update_.poses.resize(7 * layout_.owned.size());
    engine = MakeEngine();
  }
  std::unique_ptr<Engine> MakeEngine()
  {
    auto made = std::make_unique<Engine>();
    const TConfigurationTree tree{std::shared_ptr<const ConfigurationNode>(engine_)};
    made->Init({configuration_, Parameters(tree, parameter_table_), *space_, layout_});
    for (std::uint32_t i = 0; i < experiment.entities.size(); ++i)
      made->AddEntity(space_->GetEntity(i), !experiment.entities[i].movable ? EBinding::kFixed
                                            : IsMirror(i)                   ? EBinding::kMirror
                                                                            : EBinding::kOwned);
    made->Start();
    return made;
  }
  // Puts a fresh engine in place of the running one, from its saved state, as a checkpoint does.
  void ReplaceEngineBySavedState()
  {
    ByteWriter state;
    engine->SaveState(state);
    auto fresh = MakeEngine();
    ByteReader reader(state.Bytes());
    fresh->LoadState(reader);
    EXPECT_TRUE(reader.AtEnd());
    engine = std::move(fresh);
  }

  void Command(const std::string& channel, std::uint32_t entity, const std::vector<double>& values)
  {
    std::copy(values.begin(), values.end(), commands_.begin() + Place(layout_.commands, channel, entity));
  }
  double Sensor(const std::string& channel, std::uint32_t entity, int element) const
  {
    return sensors_[static_cast<std::size_t>(Place(layout_.sensors, channel, entity) + element)];
  }

  void Tick()
  {
    update_.attributes.Clear();
    engine->Update({layout_.commands, commands_}, update_, sensors_);
    space_->SetPoses(layout_.owned, update_.poses);
    space_->SetAttributes(update_.attributes);
    space_->SetTick(space_->GetTick() + 1);
  }
  void Run(int ticks)
  {
    for (int i = 0; i < ticks; ++i) Tick();
  }

  CSwarmanoidSpace& Space() { return *space_; }
  Vector3 Position(std::uint32_t entity) const { return space_->GetEntity(entity).GetPosition(); }
  Quaternion Orientation(std::uint32_t entity) const { return space_->GetEntity(entity).GetOrientation(); }
  double Yaw(std::uint32_t entity) const { return YawOf(Orientation(entity)); }
  double Attribute(std::uint32_t entity, const char* name, int element = 0) const
  {
    return space_->GetEntity(entity).GetAttribute(name, element);
  }

  std::unique_ptr<Engine> engine;

private:
  bool IsMirror(std::uint32_t entity) const
  {
    return std::find(mirrors_.begin(), mirrors_.end(), entity) != mirrors_.end();
  }
  void AddChannel(std::vector<ChannelBlock>& blocks, std::size_t& size, const std::string& channel, int width)
  {
    const EntityKind kind = channel.starts_with("eyebot")    ? EntityKind::kEyebot
                            : channel.starts_with("handbot") ? EntityKind::kHandbot
                                                             : EntityKind::kFootbot;
    ChannelBlock block{channel, width, {}, size};
    for (std::uint32_t i = 0; i < experiment.entities.size(); ++i)
      if (experiment.entities[i].kind == kind && !IsMirror(i)) block.entities.push_back(i);
    size += block.entities.size() * static_cast<std::size_t>(width);
    blocks.push_back(block);
  }
  static std::ptrdiff_t Place(const std::vector<ChannelBlock>& blocks, const std::string& channel, std::uint32_t entity)
  {
    for (const ChannelBlock& block : blocks)
    {
      if (block.name != channel) continue;
      const auto found = std::find(block.entities.begin(), block.entities.end(), entity);
      if (found == block.entities.end()) break;
      return static_cast<std::ptrdiff_t>(block.offset) + (found - block.entities.begin()) * block.width;
    }
    throw std::logic_error("the test uses a channel that it did not add: " + channel);
  }

  EngineConfiguration configuration_;
  std::vector<ParameterSpec> parameter_table_;
  std::shared_ptr<ConfigurationNode> engine_ = std::make_shared<ConfigurationNode>();
  EngineLayout layout_;
  std::vector<std::uint32_t> mirrors_;
  std::unique_ptr<CSwarmanoidSpace> space_;
  std::vector<double> commands_;
  std::vector<double> sensors_;
  EngineUpdate update_;
};

}  // namespace swarmanoid
