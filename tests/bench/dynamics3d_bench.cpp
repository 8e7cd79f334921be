// dynamics3d: time of a clock tick (100 ms, 20 steps of the solver) and of one step, for footbots that drive about at
// one per square metre within arena walls, one in ten of them an eyebot; on the plane, on hills, on an OctoMap of
// 2,000 cells a robot, and there with a prey and a plate to each two robots.
//   build/bin/bench/dynamics3d_bench
#include <benchmark/benchmark.h>
#include <octomap/octomap.h>

#include <cmath>

#include "common/math/elementary.h"
#include "common/math/random.h"
#include "common/plugin_descriptions/engines.h"
#include "common/space/space.h"
#include "engine_worker/engines/dynamics3d/dynamics3d_engine.h"
#include "tests/world/small_experiment.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

enum class EGround
{
  kPlane,
  kHills,
  kCells
};

class BenchWorld
{
public:
  BenchWorld(int robots, EGround ground, bool objects)
  {
    const double side = std::sqrt(robots) + 1;
    experiment_.arena_size = {side, side, 5};
    const int per_side = static_cast<int>(std::ceil(std::sqrt(robots)));
    RandomStream random(1, 0, 0, 0);
    EngineLayout layout;
    ChannelBlock wheels{"footbot_wheels", 2, {}, 0};
    for (int k = 0; k < robots; ++k)
    {
      const bool flies = k % 10 == 9;
      EntityConfiguration robot =
          test::Entity(flies ? EntityKind::kEyebot : EntityKind::kFootbot, "robot" + std::to_string(k));
      robot.pose = {{1 + k % per_side + random.Uniform(-0.2, 0.2), 1 + k / per_side + random.Uniform(-0.2, 0.2),
                     flies ? 2.0 : 0.02},
                    QuaternionFromYaw(random.Uniform(-kPi, kPi))};
      if (!flies) wheels.entities.push_back(static_cast<std::uint32_t>(k));
      experiment_.entities.push_back(robot);
      layout.owned.push_back(static_cast<std::uint32_t>(k));
    }
    for (int k = 0; objects && k < robots; ++k)
    {
      const EntityConfiguration thing =
          test::Entity(k % 2 == 0 ? EntityKind::kCylindricPrey : EntityKind::kBlock, "thing" + std::to_string(k),
                       {0.5 + k % per_side, 0.5 + k / per_side, 0.05},
                       k % 2 == 0 ? Vector3(0.1, 0.1, 0.1) : Vector3(0.3, 0.3, 0.05), true);
      layout.owned.push_back(static_cast<std::uint32_t>(experiment_.entities.size()));
      experiment_.entities.push_back(thing);
    }
    layout.command_size = 2 * wheels.entities.size();
    layout.commands.push_back(wheels);
    layout_ = layout;
    space_ = std::make_unique<CSwarmanoidSpace>(experiment_);

    node_->attributes.push_back({"arena_walls", "true", {}});
    if (ground != EGround::kPlane) node_->attributes.push_back({"ground", "false", {}});
    engine_.Init({configuration_, Parameters(TConfigurationTree(node_), table_), *space_, layout_});
    if (ground == EGround::kHills) AddHills(side);
    if (ground == EGround::kCells) AddCells(side);
    for (std::size_t k = 0; k < space_->Size(); ++k) engine_.AddEntity(space_->GetEntity(k), EBinding::kOwned);
    engine_.Start();

    for (std::size_t k = 0; k < wheels.entities.size(); ++k)
      for (int wheel = 0; wheel < 2; ++wheel) commands_.push_back(random.Uniform(2, 6));
    update_.poses.resize(7 * layout.owned.size());
    for (int tick = 0; tick < 20; ++tick) Tick();
  }

  void Tick()
  {
    update_.attributes.Clear();
    engine_.Update({layout_.commands, commands_}, update_, {});
    space_->SetTick(space_->GetTick() + 1);
  }

private:
  void AddHills(double side)
  {
    const int points = static_cast<int>(side / 0.1) + 2;
    RandomStream random(2, 0, 0, 0);
    std::vector<double> heights;
    for (int k = 0; k < points * points; ++k) heights.push_back(random.Uniform(-0.005, 0.005));
    const auto hills =
        std::make_shared<const HeightTerrain>(heights, points, points, (points - 1) * 0.1, (points - 1) * 0.1);
    terrain_ = AddHeightfield(engine_.WorldForTest(), dynamics3d::kNoEntity, hills, Pose());
  }
  // Four layers of cells of 5 cm, and a cell on top of one in 400.
  void AddCells(double side)
  {
    const int cells = static_cast<int>(side / 0.05) + 1;
    RandomStream random(2, 0, 0, 0);
    octomap::OcTree tree(0.05);
    const auto fill = [&](int x, int y, int z)
    {
      const auto at = [](int k) { return 0.05F * static_cast<float>(k) + 0.025F; };
      tree.updateNode(octomap::point3d(at(x), at(y), at(z)), true, true);
    };
    for (int x = 0; x < cells; ++x)
      for (int y = 0; y < cells; ++y)
        for (int z = -4; z < (random.Uniform() < 1.0 / 400 ? 1 : 0); ++z) fill(x, y, z);
    tree.updateInnerOccupancy();
    const test::TemporaryFolder folder;
    const std::string path = folder / "floor.bt";
    tree.writeBinary(path);
    terrain_ =
        AddVoxels(engine_.WorldForTest(), dynamics3d::kNoEntity, std::make_shared<const VoxelTerrain>(path), Pose());
  }

  Experiment experiment_;
  EngineConfiguration configuration_;
  EngineLayout layout_;
  std::vector<ParameterSpec> table_ = Dynamics3dDescription().parameters;
  std::shared_ptr<ConfigurationNode> node_ = std::make_shared<ConfigurationNode>();
  std::unique_ptr<CSwarmanoidSpace> space_;
  std::unique_ptr<dynamics3d::TerrainShape> terrain_;
  CDynamics3dEngine engine_;
  std::vector<double> commands_;
  EngineUpdate update_;
};

void Ticks(benchmark::State& state, EGround ground, bool objects)
{
  BenchWorld world(static_cast<int>(state.range(0)), ground, objects);
  for (auto _ : state) world.Tick();
  using benchmark::Counter;
  const auto steps = static_cast<double>(state.iterations()) * 20;
  state.counters["step"] = Counter(steps, Counter::kIsRate | Counter::kInvert);
  state.counters["robot_step"] =
      Counter(steps * static_cast<double>(state.range(0)), Counter::kIsRate | Counter::kInvert);
}

BENCHMARK_CAPTURE(Ticks, plane, EGround::kPlane, false)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Ticks, hills, EGround::kHills, false)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Ticks, cells, EGround::kCells, false)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Ticks, objects, EGround::kPlane, true)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Ticks, objects_on_cells, EGround::kCells, true)->Arg(100)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace swarmanoid

BENCHMARK_MAIN();
