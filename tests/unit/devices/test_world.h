// TestWorld: a small experiment made in memory. TestSensor and others are a batch of a device for some of its robots.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/math/elementary.h"
#include "common/math/random.h"
#include "common/space/space.h"
#include "controller_host/device.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{

class TestWorld
{
public:
  TestWorld()
  {
    experiment_.arena_size = {10, 10, 3};
    experiment_.seed = 7;
    AddEngine("ground");
    RegisterBuiltinDevices();
  }

  std::size_t AddEngine(const std::string& id)
  {
    EngineConfiguration& engine = experiment_.engines.emplace_back();
    engine.tag = "dummy_engine";
    engine.id = id;
    return experiment_.engines.size() - 1;
  }

  // `yaw` is in radians; `engine` -1 means none.
  std::uint32_t Add(EntityKind kind, const Vector3& position, double yaw = 0, const Vector3& size = {0, 0, 0},
                    bool movable = true, int engine = 0)
  {
    EntityConfiguration entity =
        test::Entity(kind, "e" + std::to_string(experiment_.entities.size()), position, size, movable);
    entity.pose.orientation = QuaternionFromYaw(yaw);
    return test::Add(experiment_, entity, engine);
  }
  std::uint32_t AddFootbot(double x, double y, double yaw = 0, double z = 0, int engine = 0)
  {
    return Add(EntityKind::kFootbot, {x, y, z}, yaw, DescriptionOf(EntityKind::kFootbot).size, true, engine);
  }
  std::uint32_t AddEyebot(double x, double y, double z, double yaw = 0, int engine = 0)
  {
    return Add(EntityKind::kEyebot, {x, y, z}, yaw, DescriptionOf(EntityKind::kEyebot).size, true, engine);
  }
  std::uint32_t AddBlock(const Vector3& centre, const Vector3& size, double yaw = 0, int engine = 0)
  {
    return Add(EntityKind::kBlock, centre, yaw, size, false, engine);
  }
  std::uint32_t AddPrey(double x, double y, double radius, double height, int engine = 0)
  {
    return Add(EntityKind::kCylindricPrey, {x, y, 0}, 0, {radius, radius, height}, true, engine);
  }

  Experiment& Configuration() { return experiment_; }
  CSwarmanoidSpace& Space()
  {
    if (space_ == nullptr) space_ = std::make_unique<CSwarmanoidSpace>(experiment_);
    return *space_;
  }
  std::vector<std::uint32_t> RobotsOf(EntityKind kind) const
  {
    std::vector<std::uint32_t> robots;
    for (std::uint32_t e = 0; e < experiment_.entities.size(); ++e)
      if (experiment_.entities[e].kind == kind) robots.push_back(e);
    return robots;
  }

private:
  Experiment experiment_;
  std::unique_ptr<CSwarmanoidSpace> space_;
};

using test::TestParameters;
using test::TreeOf;

// Makes a batch for `robots`, with the channel of a specific device, all values 0.
template <class Interface>
class TestBatch
{
public:
  TestBatch(TestWorld& world, const std::string& type, const std::string& implementation,
            std::vector<std::uint32_t> robots, const TestParameters& parameters = {})
  {
    const auto* entry = PluginRegistry<Interface>::Instance().Find(type, implementation);
    if (entry == nullptr) throw std::runtime_error("no device " + type + " " + implementation);
    auto width = static_cast<std::size_t>(entry->description.channel_width);
    if (entry->description.channel_is_per_joint)
      width *= DescriptionOf(world.Space().GetEntity(robots.front()).GetKind()).links.size();
    values.assign(width * robots.size(), 0);
    for (std::size_t k = 0; k < robots.size(); ++k) offsets_.push_back(k * width);
    channel_ = {values, offsets_, static_cast<int>(width)};
    batch = entry->create();
    const bool is_sensor = std::is_same_v<Interface, SensorBatch>;
    batch->Init({Parameters(TreeOf(parameters), entry->description.parameters), world.Space(), robots,
                 is_sensor ? SensorStream(type) : ActuatorStream(type)});
  }
  TestBatch(const TestBatch&) = delete;
  TestBatch& operator=(const TestBatch&) = delete;

  const ChannelView& Channel() const { return channel_; }

  std::vector<double> values;
  std::unique_ptr<Interface> batch;

private:
  std::vector<std::size_t> offsets_;
  ChannelView channel_;
};

class TestSensor : public TestBatch<SensorBatch>
{
public:
  using TestBatch::TestBatch;
  void Update() { batch->Update(Channel()); }
  template <class Device>
  Device& Of(std::size_t k)
  {
    return dynamic_cast<Device&>(*batch->Sensor(k));
  }
};

class TestActuator : public TestBatch<ActuatorBatch>
{
public:
  using TestBatch::TestBatch;
  // Channel values are in `values`, attribute changes in `changes`.
  void Commit()
  {
    changes.Clear();
    batch->Commit(Channel(), changes);
  }
  template <class Device>
  Device& Of(std::size_t k)
  {
    return dynamic_cast<Device&>(*batch->Actuator(k));
  }
  AttributeChanges changes;
};

}  // namespace swarmanoid
