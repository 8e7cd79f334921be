// A dynamics2d engine over a small experiment put together in memory, driven tick by tick without any other role.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/math/elementary.h"
#include "common/space/space.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_engine.h"

namespace swarmanoid
{

class Dynamics2dTestWorld
{
public:
  Dynamics2dTestWorld() { configuration_.tag = "dynamics2d"; }

  Experiment experiment;

  void Set(const std::string& parameter, const std::string& value)
  {
    engine_->attributes.push_back({parameter, value, {}});
  }
  void SetSubclock(int subclock) { configuration_.subclock = subclock; }

  std::uint32_t Add(EntityKind kind, const Vector3& position, const EulerAngles& angles, const Vector3& size,
                    double mass = 0, bool movable = true)
  {
    EntityConfiguration entity;
    entity.kind = kind;
    entity.id = "e" + std::to_string(experiment.entities.size());
    entity.pose = {position, QuaternionFromEuler(angles)};
    entity.size = size;
    entity.mass_kg = mass;
    entity.movable = movable;
    experiment.entities.push_back(entity);
    return static_cast<std::uint32_t>(experiment.entities.size() - 1);
  }
  std::uint32_t AddFootbot(double x, double y, double yaw = 0)
  {
    return Add(EntityKind::kFootbot, {x, y, 0}, {0, 0, yaw}, {0.085036758, 0.085036758, 0.146899733});
  }
  std::uint32_t AddPrey(double x, double y, double mass, double radius = 0.1)
  {
    return Add(EntityKind::kCylindricPrey, {x, y, 0}, {}, {radius, radius, 0.1}, mass);
  }
  std::uint32_t AddWall(const Vector3& centre, const Vector3& size, double yaw = 0)
  {
    return Add(EntityKind::kBlock, centre, {0, 0, yaw}, size, 0, false);
  }
  void MakeMirror(std::uint32_t entity) { mirrors_.push_back(entity); }

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
      const bool mirror = std::find(mirrors_.begin(), mirrors_.end(), i) != mirrors_.end();
      (!experiment.entities[i].movable ? layout_.fixed : mirror ? layout_.mirrored : layout_.owned).push_back(i);
    }
    space_ = std::make_unique<CSwarmanoidSpace>(experiment);
    commands_.assign(layout_.command_size, 0);
    sensors_.assign(layout_.sensor_size, 0);
    update_.poses.resize(7 * layout_.owned.size());
    engine = MakeEngine();
  }
  std::unique_ptr<CDynamics2dEngine> MakeEngine()
  {
    auto made = std::make_unique<CDynamics2dEngine>();
    const TConfigurationTree tree{std::shared_ptr<const ConfigurationNode>(engine_)};
    made->Init({configuration_, Parameters(tree, dynamics2d::Dynamics2dParameterTable()), *space_, layout_});
    for (std::uint32_t i = 0; i < experiment.entities.size(); ++i)
    {
      const auto has = [i](const std::vector<std::uint32_t>& list)
      { return std::binary_search(list.begin(), list.end(), i); };
      made->AddEntity(space_->GetEntity(i), has(layout_.fixed)      ? EBinding::kFixed
                                            : has(layout_.mirrored) ? EBinding::kMirror
                                                                    : EBinding::kOwned);
    }
    made->Start();
    return made;
  }

  // Only robots of the kind that the channel is for take part.
  void Command(const std::string& channel, std::uint32_t entity, const std::vector<double>& values)
  {
    std::copy(values.begin(), values.end(), commands_.begin() + Place(layout_.commands, channel, entity));
  }
  double Sensor(const std::string& channel, std::uint32_t entity, int element) const
  {
    return sensors_[static_cast<std::size_t>(Place(layout_.sensors, channel, entity) + element)];
  }
  void Drive(std::uint32_t footbot, double left_m_per_s, double right_m_per_s)
  {
    Command("footbot_wheels", footbot,
            {left_m_per_s / dynamics2d::kWheelRadius, right_m_per_s / dynamics2d::kWheelRadius});
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
  double Yaw(std::uint32_t entity) const { return YawOf(space_->GetEntity(entity).GetOrientation()); }
  double Attribute(std::uint32_t entity, const char* name) const
  {
    return space_->GetEntity(entity).GetAttribute(name);
  }

  std::unique_ptr<CDynamics2dEngine> engine;

private:
  void AddChannel(std::vector<ChannelBlock>& blocks, std::size_t& size, const std::string& channel, int width)
  {
    const EntityKind kind = channel.starts_with("eyebot") ? EntityKind::kEyebot : EntityKind::kFootbot;
    ChannelBlock block{channel, width, {}, size};
    for (std::uint32_t i = 0; i < experiment.entities.size(); ++i)
      if (experiment.entities[i].kind == kind && std::find(mirrors_.begin(), mirrors_.end(), i) == mirrors_.end())
        block.entities.push_back(i);
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
  std::shared_ptr<ConfigurationNode> engine_ = std::make_shared<ConfigurationNode>();
  EngineLayout layout_;
  std::vector<std::uint32_t> mirrors_;
  std::unique_ptr<CSwarmanoidSpace> space_;
  std::vector<double> commands_;
  std::vector<double> sensors_;
  EngineUpdate update_;
};

}  // namespace swarmanoid
