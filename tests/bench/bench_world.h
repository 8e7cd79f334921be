// BenchWorld: a walled square arena with robots of one kind at random positions, for the benchmarks of devices.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/math/elementary.h"
#include "common/math/random.h"
#include "controller_host/device.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{

class BenchWorld
{
public:
  // `waiting`: the number of further robots, which wait outside the arena.
  BenchWorld(int robots, double robots_per_square_metre, EntityKind kind = EntityKind::kFootbot, int waiting = 0)
  {
    RegisterBuiltinDevices();
    const double side = std::sqrt(robots / robots_per_square_metre);
    experiment_.arena_size = {side, side, 2};
    experiment_.engines.emplace_back();
    const double half = side / 2;
    AddWall({half, 0.05, 0.25}, {side, 0.1, 0.5});
    AddWall({half, side - 0.05, 0.25}, {side, 0.1, 0.5});
    AddWall({0.05, half, 0.25}, {0.1, side, 0.5});
    AddWall({side - 0.05, half, 0.25}, {0.1, side, 0.5});

    // The robots are on a square lattice, displaced as far as the lattice allows, so that none overlap at any density.
    const int per_side = static_cast<int>(std::ceil(std::sqrt(robots)));
    const double pitch = (side - 0.4) / per_side;
    const double shake = std::max(0.0, (pitch - 0.1701) / 2);
    RandomStream random(1, 2, 3, 4);
    for (int n = 0; n < robots; ++n)
    {
      const double x = 0.2 + (n % per_side + 0.5) * pitch + random.Uniform(-shake, shake);
      const double y = 0.2 + (n / per_side + 0.5) * pitch + random.Uniform(-shake, shake);
      robots_.push_back(
          test::Add(experiment_, test::Entity(kind, "fb" + std::to_string(n), {x, y, 0}, random.Uniform(-kPi, kPi))));
    }
    // The numbers are shuffled, since in a real run they do not follow the positions.
    for (std::size_t n = robots_.size() - 1; n > 0; --n)
      std::swap(experiment_.entities[robots_[n]].pose,
                experiment_.entities[robots_[random.Below(static_cast<std::uint32_t>(n + 1))]].pose);
    for (int n = 0; n < waiting; ++n)
    {
      EntityConfiguration robot = experiment_.entities[robots_[0]];
      robot.id = "late" + std::to_string(n);
      robot.waits = true;
      robot.pose = WaitingPose(robot, experiment_.entities.size());
      robots_.push_back(test::Add(experiment_, robot));
    }
    space_ = std::make_unique<CSwarmanoidSpace>(experiment_);
  }

  CSwarmanoidSpace& Space() { return *space_; }
  // All poses count as new at every tick, as in a run.
  void NextTick()
  {
    space_->SetTick(space_->GetTick() + 1);
    space_->SetPose(robots_[0], space_->GetPose(robots_[0]));
  }
  const std::vector<std::uint32_t>& Robots() const { return robots_; }

  std::unique_ptr<SensorBatch> MakeSensor(const std::string& type, const std::string& implementation,
                                          const test::TestParameters& parameters = {})
  {
    const auto* entry = PluginRegistry<SensorBatch>::Instance().Find(type, implementation);
    auto sensor = entry->create();
    sensor->Init(
        {Parameters(test::TreeOf(parameters), entry->description.parameters), *space_, robots_, SensorStream(type)});
    return sensor;
  }

private:
  void AddWall(const Vector3& centre, const Vector3& size)
  {
    test::Add(experiment_, test::Entity(EntityKind::kBlock, "wall" + std::to_string(experiment_.entities.size()),
                                        centre, size, false));
  }

  Experiment experiment_;
  std::vector<std::uint32_t> robots_;
  std::unique_ptr<CSwarmanoidSpace> space_;
};

}  // namespace swarmanoid
