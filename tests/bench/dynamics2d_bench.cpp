// Milliseconds of one tick (0.1 s, 4 sub-steps) of dynamics2d: footbots with grippers within four walls, driving on
// arcs. Dynamics2dTick: one for each square metre, which have just started. Dynamics2dMixed: robots, robots per square
// metre and threads, after 60 s in which they took other arcs every 2 s. Dynamics2dRegions: robots, robots per square
// metre and regions (0: not split); processor time of the engine and of the slowest region, with messages in memory.
// Run alone on the machine: bin/bench/dynamics2d_bench
#include <benchmark/benchmark.h>

#include "bench_world.h"
#include "common/plugin_descriptions/engines.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_engine.h"
#include "engine_worker/engines/dynamics2d/group_region.h"
#include "tests/unit/engines/local_team.h"

namespace swarmanoid
{
namespace
{

class Field
{
public:
  explicit Field(int robots, double robots_per_square_metre = 1, int threads = 1, RegionTeam* team = nullptr)
      : world_(robots, robots_per_square_metre)
  {
    CSwarmanoidSpace& space = world_.Space();
    ChannelBlock wheels{"footbot_wheels", 2, {}, 0};
    for (std::uint32_t i = 0; i < space.Size(); ++i)
    {
      if (!space.GetEntity(i).IsMovable()) continue;
      RandomStream random(1, i, 0, 0);
      layout_.owned.push_back(i);
      wheels.entities.push_back(i);
      commands_.push_back(random.Uniform(1, 3));
      commands_.push_back(random.Uniform(1, 3));
    }
    layout_.commands.push_back(wheels);
    layout_.command_size = commands_.size();
    const Parameters parameters(test::TreeOf({{"threads", std::to_string(threads)}}),
                                Dynamics2dDescription().parameters);
    engine_.Init({configuration_, parameters, space, layout_, team});
    for (std::uint32_t i = 0; i < space.Size(); ++i)
      engine_.AddEntity(space.GetEntity(i), space.GetEntity(i).IsMovable() ? EBinding::kOwned : EBinding::kFixed);
    engine_.Start();
    update_.poses.resize(7 * layout_.owned.size());
  }

  void Tick()
  {
    update_.attributes.Clear();
    engine_.Update({layout_.commands, commands_}, update_, {});
  }
  // Drives for 60 s, and turns on to other arcs every 2 s, also backwards.
  void Mix()
  {
    for (int tick = 0; tick < 600; ++tick)
    {
      if (tick % 20 == 0)
      {
        RandomStream random(2, static_cast<std::uint64_t>(tick), 0, 0);
        for (double& command : commands_) command = random.Uniform(-1, 3);
      }
      Tick();
    }
  }
  CDynamics2dEngine& Engine() { return engine_; }

private:
  BenchWorld world_;
  EngineConfiguration configuration_;
  EngineLayout layout_;
  std::vector<double> commands_;
  CDynamics2dEngine engine_;
  EngineUpdate update_;
};

void Dynamics2dTick(benchmark::State& state)
{
  Field field(static_cast<int>(state.range(0)));
  for (int i = 0; i < 50; ++i) field.Tick();
  for (auto _ : state) field.Tick();
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(Dynamics2dTick)->Arg(10)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

void Dynamics2dMixed(benchmark::State& state)
{
  Field field(static_cast<int>(state.range(0)), static_cast<double>(state.range(1)), static_cast<int>(state.range(2)));
  field.Mix();
  for (auto _ : state) field.Tick();
  state.SetLabel(field.Engine().StatusText());
}
BENCHMARK(Dynamics2dMixed)
    ->ArgsProduct({{1000}, {1, 5, 20}, {1, 2}})
    ->Iterations(100)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void Dynamics2dRegions(benchmark::State& state)
{
  const auto regions = static_cast<unsigned>(state.range(2));
  LocalTeam team(std::max(regions, 1U), [] { return std::make_unique<dynamics2d::GroupRegion>(); });
  Field field(static_cast<int>(state.range(0)), static_cast<double>(state.range(1)), 1, regions == 0 ? nullptr : &team);
  field.Mix();
  double engine = 0;
  std::vector<double> of_regions(team.RegionCount());
  std::size_t bytes = team.Bytes();
  for (auto _ : state)
  {
    const std::vector<double> before(team.Seconds().begin(), team.Seconds().end());
    const double before_meanwhile = team.MeanwhileSeconds();
    const double start = LocalTeam::ThreadSeconds();
    field.Tick();
    double all = LocalTeam::ThreadSeconds() - start;
    const double meanwhile = team.MeanwhileSeconds() - before_meanwhile;
    double slowest = 0;
    for (std::size_t region = 0; region < before.size(); ++region)
    {
      const double seconds = team.Seconds()[region] - before[region];
      slowest = std::max(slowest, seconds);
      of_regions[region] += seconds;
      all -= seconds;
    }
    engine += all;
    state.SetIterationTime(all - meanwhile + std::max(meanwhile, slowest));
  }
  const auto ticks = static_cast<double>(state.iterations());
  double sum = 0;
  for (const double seconds : of_regions) sum += seconds;
  state.counters["engine_ms"] = 1e3 * engine / ticks;
  state.counters["regions_ms"] = 1e3 * sum / ticks;
  state.counters["kB"] = 1e-3 * static_cast<double>(team.Bytes() - bytes) / ticks;
  state.SetLabel(field.Engine().StatusText());
}
BENCHMARK(Dynamics2dRegions)
    ->ArgsProduct({{1000}, {1, 5, 10, 20}, {0, 1, 2, 4}})
    ->ArgsProduct({{10000}, {5}, {0, 2, 4}})
    ->Iterations(50)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

void Dynamics2dCanonicalise(benchmark::State& state)
{
  Field field(static_cast<int>(state.range(0)));
  for (int i = 0; i < 50; ++i) field.Tick();
  for (auto _ : state) field.Engine().Canonicalise();
}
BENCHMARK(Dynamics2dCanonicalise)->Arg(10)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace swarmanoid

BENCHMARK_MAIN();
