// Milliseconds of one tick (0.1 s, 4 sub-steps) of dynamics2d: footbots with grippers, one for each square metre,
// within four walls, driving on arcs. Run alone on the machine: bin/bench/dynamics2d_bench
#include <benchmark/benchmark.h>

#include "bench_world.h"
#include "common/plugin_descriptions/engines.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_engine.h"

namespace swarmanoid
{
namespace
{

class Field
{
public:
  explicit Field(int robots) : world_(robots, 1)
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
    const Parameters parameters(TConfigurationTree(), Dynamics2dDescription().parameters);
    engine_.Init({configuration_, parameters, space, layout_});
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
