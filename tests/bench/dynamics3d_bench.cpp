// dynamics3d: time of a clock tick (100 ms, 20 steps of the solver) and of one step, for footbots that drive about at
// one per square metre within arena walls, one in ten of them an eyebot; on the plane, on hills, on an OctoMap of
// 2,000 cells a robot, and there with a prey and a plate to each two robots. Regions: robots, robots per square metre
// and regions (0: not split); processor time of the engine and of the slowest region, with messages in memory.
//   build/bin/bench/dynamics3d_bench
#include <benchmark/benchmark.h>
#include <octomap/octomap.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "common/math/elementary.h"
#include "common/math/random.h"
#include "common/plugin_descriptions/engines.h"
#include "common/space/space.h"
#include "engine_worker/engines/dynamics3d/dynamics3d_engine.h"
#include "tests/unit/engines/local_team.h"
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
  BenchWorld(int robots, EGround ground, bool objects, double pitch = 1, unsigned regions = 0)
      : ground_(ground), side_(pitch * (std::sqrt(robots) + 1))
  {
    experiment_.arena_size = {side_, side_, 5};
    const int per_side = static_cast<int>(std::ceil(std::sqrt(robots)));
    RandomStream random(1, 0, 0, 0);
    EngineLayout layout;
    ChannelBlock wheels{"footbot_wheels", 2, {}, 0};
    for (int k = 0; k < robots; ++k)
    {
      const bool flies = k % 10 == 9;
      EntityConfiguration robot =
          test::Entity(flies ? EntityKind::kEyebot : EntityKind::kFootbot, "robot" + std::to_string(k));
      const double spread = std::min(0.2, pitch / 2 - 0.1);
      robot.pose = {{pitch * (1 + k % per_side) + random.Uniform(-spread, spread),
                     pitch * (1 + k / per_side) + random.Uniform(-spread, spread), flies ? 2.0 : 0.02},
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
    if (regions > 0) team_ = std::make_unique<LocalTeam>(regions, [this] { return std::make_unique<Region>(*this); });
    engine_ = MakeEngine(team_.get());

    for (std::size_t k = 0; k < wheels.entities.size(); ++k)
      for (int wheel = 0; wheel < 2; ++wheel) commands_.push_back(random.Uniform(2, 6));
    update_.poses.resize(7 * layout.owned.size());
    for (int tick = 0; tick < 20; ++tick) Tick();
  }

  void Tick()
  {
    update_.attributes.Clear();
    engine_->Update({layout_.commands, commands_}, update_, {});
    space_->SetTick(space_->GetTick() + 1);
  }
  LocalTeam& Team() { return *team_; }
  std::string StatusText() const { return engine_->StatusText(); }

private:
  struct NoExchange : RegionExchange
  {
    unsigned RegionCount() const override { return 1; }
    void Swap(std::span<const ByteWriter>, std::span<std::vector<char>>) override {}
  };
  struct Region : EngineRegion
  {
    explicit Region(BenchWorld& world) : engine(world.MakeEngine(nullptr)), region(engine->MakeRegion(0, exchange)) {}
    void Work(std::span<const char> task, ByteWriter& result) override { region->Work(task, result); }

    NoExchange exchange;
    std::unique_ptr<CDynamics3dEngine> engine;
    std::unique_ptr<EngineRegion> region;
  };

  std::unique_ptr<CDynamics3dEngine> MakeEngine(RegionTeam* team)
  {
    auto engine = std::make_unique<CDynamics3dEngine>();
    engine->Init({configuration_, Parameters(TConfigurationTree(node_), table_), *space_, layout_, team});
    if (ground_ == EGround::kHills) AddHills(*engine);
    if (ground_ == EGround::kCells) AddCells(*engine);
    for (std::size_t k = 0; k < space_->Size(); ++k) engine->AddEntity(space_->GetEntity(k), EBinding::kOwned);
    engine->Start();
    return engine;
  }
  void AddHills(CDynamics3dEngine& engine)
  {
    const int points = static_cast<int>(side_ / 0.1) + 2;
    RandomStream random(2, 0, 0, 0);
    std::vector<double> heights;
    for (int k = 0; k < points * points; ++k) heights.push_back(random.Uniform(-0.005, 0.005));
    const auto hills =
        std::make_shared<const HeightTerrain>(heights, points, points, (points - 1) * 0.1, (points - 1) * 0.1);
    terrains_.push_back(AddHeightfield(engine.WorldForTest(), dynamics3d::kNoEntity, hills, Pose()));
  }
  // Four layers of cells of 5 cm, and a cell on top of one in 400.
  void AddCells(CDynamics3dEngine& engine)
  {
    const int cells = static_cast<int>(side_ / 0.05) + 1;
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
    terrains_.push_back(
        AddVoxels(engine.WorldForTest(), dynamics3d::kNoEntity, std::make_shared<const VoxelTerrain>(path), Pose()));
  }

  EGround ground_;
  double side_;
  Experiment experiment_;
  EngineConfiguration configuration_;
  EngineLayout layout_;
  std::vector<ParameterSpec> table_ = Dynamics3dDescription().parameters;
  std::shared_ptr<ConfigurationNode> node_ = std::make_shared<ConfigurationNode>();
  std::unique_ptr<CSwarmanoidSpace> space_;
  std::vector<std::unique_ptr<dynamics3d::TerrainShape>> terrains_;
  std::unique_ptr<LocalTeam> team_;
  std::unique_ptr<CDynamics3dEngine> engine_;
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

void Regions(benchmark::State& state, EGround ground)
{
  const auto regions = static_cast<unsigned>(state.range(2));
  BenchWorld world(static_cast<int>(state.range(0)), ground, false, 1 / std::sqrt(static_cast<double>(state.range(1))),
                   regions);
  double sum = 0;
  std::size_t bytes = regions == 0 ? 0 : world.Team().Bytes();
  for (auto _ : state)
  {
    std::vector<double> before;
    if (regions > 0) before.assign(world.Team().Seconds().begin(), world.Team().Seconds().end());
    const double start = LocalTeam::ThreadSeconds();
    world.Tick();
    double seconds = LocalTeam::ThreadSeconds() - start;
    double slowest = 0;
    for (std::size_t region = 0; region < before.size(); ++region)
    {
      const double its = world.Team().Seconds()[region] - before[region];
      slowest = std::max(slowest, its);
      seconds -= its;
      sum += its;
    }
    state.SetIterationTime(seconds + slowest);
  }
  const auto ticks = static_cast<double>(state.iterations());
  state.counters["regions_ms"] = 1e3 * sum / ticks;
  if (regions > 0) state.counters["kB"] = 1e-3 * static_cast<double>(world.Team().Bytes() - bytes) / ticks;
  state.SetLabel(world.StatusText());
}

BENCHMARK_CAPTURE(Regions, plane, EGround::kPlane)
    ->ArgsProduct({{1000}, {1, 10}, {0, 1, 2, 4}})
    ->Iterations(20)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Regions, hills, EGround::kHills)
    ->ArgsProduct({{1000}, {1}, {0, 1, 2, 4}})
    ->Iterations(20)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Ticks, plane, EGround::kPlane, false)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Ticks, hills, EGround::kHills, false)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Ticks, cells, EGround::kCells, false)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Ticks, objects, EGround::kPlane, true)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Ticks, objects_on_cells, EGround::kCells, true)->Arg(100)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace swarmanoid

BENCHMARK_MAIN();
