// EngineTestWorld: a rigid-body engine with a small experiment made in memory, run tick by tick without other roles. It
// is the base of the test worlds of dynamics2d and dynamics3d.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/math/elementary.h"
#include "common/plugin_descriptions/describe_builtins.h"
#include "common/plugins/catalogue.h"
#include "common/space/space.h"
#include "engine_worker/physics_engine.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{

template <class Engine>
class EngineTestWorld
{
public:
  explicit EngineTestWorld(PluginDescription description) : description_(std::move(description))
  {
    configuration_.tag = description_.label;
    configuration_.id = "engine";
    experiment.arena_size = {10, 10, 3};
  }

  Experiment experiment;
  RegionTeam* team = nullptr;  // of engines that are made from now on

  // More parameters may follow, each with its value.
  template <class... More>
  void Set(const std::string& parameter, const std::string& value, const More&... more)
  {
    engine_->attributes.push_back({parameter, value, {}});
    if constexpr (sizeof...(more) > 0) Set(more...);
  }
  void SetSubclock(int subclock) { configuration_.subclock = subclock; }

  std::uint32_t Add(EntityKind kind, const Vector3& position, const Quaternion& orientation, const Vector3& size,
                    double mass = 0, bool movable = true)
  {
    EntityConfiguration entity =
        test::Entity(kind, "e" + std::to_string(experiment.entities.size()), position, size, movable);
    entity.pose.orientation = orientation;
    entity.mass_kg = mass;
    return test::Add(experiment, entity, -1);
  }
  std::uint32_t AddFootbot(const Vector3& position, double yaw = 0)
  {
    return Add(EntityKind::kFootbot, position, QuaternionFromYaw(yaw), DescriptionOf(EntityKind::kFootbot).size);
  }
  std::uint32_t AddEyebot(const Vector3& position, double yaw = 0)
  {
    return Add(EntityKind::kEyebot, position, QuaternionFromYaw(yaw), DescriptionOf(EntityKind::kEyebot).size);
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
  // Adds a terrain from a file, the same as <terrain><KIND file=… size=… height=…/></terrain>.
  std::uint32_t AddTerrain(const std::string& kind, const test::TestParameters& attributes, const Vector3& position)
  {
    const std::uint32_t entity = Add(EntityKind::kTerrain, position, Quaternion::Identity(), Vector3::Zero(), 0, false);
    experiment.entities[entity].tree = test::TerrainTree(kind, attributes);
    return entity;
  }
  void MakeMirror(std::uint32_t entity) { mirrors_.push_back(entity); }

  // Footbots turn their turrets as commanded. Without this the turrets stand still.
  void UseTurrets() { uses_turrets_ = true; }

  // Starts the engine, after all entities were added, with all its channels for all robots but mirrors. The first
  // command, tick or look at the space starts the engine, too. Several engines of the same experiment can be made.
  void Start()
  {
    for (std::uint32_t i = 0; i < experiment.entities.size(); ++i)
    {
      configuration_.entities.push_back(i);
      (!experiment.entities[i].movable ? layout_.fixed : IsMirror(i) ? layout_.mirrored : layout_.owned).push_back(i);
    }
    space_ = std::make_unique<CSwarmanoidSpace>(experiment);
    DescribeBuiltinDevices();
    for (const PluginDescription* device : PluginCatalogue::Instance().Of(PluginKind::kActuator))
      AddChannel(layout_.commands, layout_.command_size, *device);
    for (const PluginDescription* device : PluginCatalogue::Instance().Of(PluginKind::kSensor))
      AddChannel(layout_.sensors, layout_.sensor_size, *device);
    commands_.assign(layout_.command_size, 0);
    sensors_.assign(layout_.sensor_size, 0);
    update_.poses.resize(7 * layout_.owned.size());
    engine = MakeEngine();
  }
  std::unique_ptr<Engine> MakeEngine() { return MakeEngine(team); }
  std::unique_ptr<Engine> MakeEngine(RegionTeam* its_team)
  {
    auto made = std::make_unique<Engine>();
    const TConfigurationTree tree{std::shared_ptr<const ConfigurationNode>(engine_)};
    made->Init({configuration_, Parameters(tree, description_.parameters), *space_, layout_, its_team});
    for (std::uint32_t i = 0; i < experiment.entities.size(); ++i)
      made->AddEntity(space_->GetEntity(i), !experiment.entities[i].movable ? EBinding::kFixed
                                            : IsMirror(i)                   ? EBinding::kMirror
                                                                            : EBinding::kOwned);
    made->Start();
    return made;
  }
  // Replaces the running engine by a fresh one from its saved state, as a checkpoint does.
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
    EnsureStarted();
    std::copy(values.begin(), values.end(), commands_.begin() + Place(layout_.commands, channel, entity));
  }
  double Sensor(const std::string& channel, std::uint32_t entity, int element) const
  {
    return sensors_[static_cast<std::size_t>(Place(layout_.sensors, channel, entity) + element)];
  }

  void Tick()
  {
    EnsureStarted();
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

  CSwarmanoidSpace& Space()
  {
    EnsureStarted();
    return *space_;
  }
  Vector3 Position(std::uint32_t entity) { return Space().GetEntity(entity).GetPosition(); }
  Quaternion Orientation(std::uint32_t entity) { return Space().GetEntity(entity).GetOrientation(); }
  double Yaw(std::uint32_t entity) { return YawOf(Orientation(entity)); }
  double Attribute(std::uint32_t entity, const char* name, int element = 0)
  {
    return Space().GetEntity(entity).GetAttribute(name, element);
  }

  std::unique_ptr<Engine> engine;

private:
  void EnsureStarted()
  {
    if (engine == nullptr) Start();
  }
  bool IsMirror(std::uint32_t entity) const
  {
    return std::find(mirrors_.begin(), mirrors_.end(), entity) != mirrors_.end();
  }
  // Adds the channel of a device. Several devices may use one channel. Its name begins with the kind of its robots.
  void AddChannel(std::vector<ChannelBlock>& blocks, std::size_t& size, const PluginDescription& device)
  {
    if (std::ranges::find(description_.channels, device.channel) == description_.channels.end() ||
        std::ranges::find(blocks, device.channel, &ChannelBlock::name) != blocks.end())
      return;
    std::size_t joints = 0;
    for (const EntityConfiguration& entity : experiment.entities)
      joints = std::max(joints, DescriptionOf(entity.kind).links.size());
    const int width = device.channel_width * (device.channel_is_per_joint ? static_cast<int>(joints) : 1);
    ChannelBlock block{device.channel, width, {}, size};
    for (std::uint32_t i = 0; i < experiment.entities.size(); ++i)
    {
      const EntityKind kind = experiment.entities[i].kind;
      const bool is_flight = device.channel == "eyebot_propellers" && DescriptionOf(kind).propellers;
      const bool has_it = (device.channel == "joints" && !DescriptionOf(kind).links.empty()) ||
                          (device.channel == "wheels" && !IsBuiltIn(kind) && DescriptionOf(kind).wheels);
      if ((is_flight || has_it || device.channel.starts_with(std::string(TagName(kind)) + "_")) && !IsMirror(i))
        block.entities.push_back(i);
    }
    if (block.entities.empty() || (block.name == "footbot_turret" && !uses_turrets_)) return;
    size += block.entities.size() * static_cast<std::size_t>(block.width);
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
    throw std::logic_error("the engine has no such channel: " + channel);
  }

  EngineConfiguration configuration_;
  PluginDescription description_;
  bool uses_turrets_ = false;
  std::shared_ptr<ConfigurationNode> engine_ = std::make_shared<ConfigurationNode>();
  EngineLayout layout_;
  std::vector<std::uint32_t> mirrors_;
  std::unique_ptr<CSwarmanoidSpace> space_;
  std::vector<double> commands_;
  std::vector<double> sensors_;
  EngineUpdate update_;
};

}  // namespace swarmanoid
