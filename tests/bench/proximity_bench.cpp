// Cost of the proximity sensors of a host: one batch over all footbots, including the grid of neighbours. Robots are at
// random positions without overlap in a walled square arena. Arguments: number of robots, robots per 10 m^2.
#include <benchmark/benchmark.h>

#include <cmath>

#include "bench_world.h"

namespace swarmanoid
{
namespace
{

void Proximity(benchmark::State& state, const char* implementation, const test::TestParameters& parameters)
{
  BenchWorld world(static_cast<int>(state.range(0)), static_cast<double>(state.range(1)) / 10);
  const auto sensor = world.MakeSensor("footbot_proximity", implementation, parameters);
  for (auto _ : state)
  {
    world.NextTick();
    sensor->Update({});
  }
  state.counters["ns_per_robot"] =
      benchmark::Counter(static_cast<double>(state.range(0)) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(Proximity, rays, "generic_footbot_proximity", test::TestParameters{})
    ->ArgsProduct({{10, 100, 1000, 10000, 100000}, {10}})
    ->Args({1000, 1})
    ->Args({1000, 40})
    ->Args({1000, 100})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Proximity, polynomial, "generic_footbot_polynomial_proximity", test::TestParameters{})
    ->Args({1000, 10})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Proximity, rays_with_noise, "generic_footbot_proximity",
                  test::TestParameters{{"noise_kind", "uniform"}, {"noise_range", "0.05"}})
    ->Args({1000, 10})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Proximity, rays_with_gaussian_noise, "generic_footbot_proximity",
                  test::TestParameters{{"noise_kind", "gaussian"}, {"noise_deviation", "0.05"}})
    ->Args({1000, 10})
    ->Unit(benchmark::kMicrosecond);

// A hundred footbots are in the arena; the argument is the number of footbots that wait outside it.
void Reserve(benchmark::State& state)
{
  BenchWorld world(100, 1, EntityKind::kFootbot, static_cast<int>(state.range(0)));
  const auto sensor = world.MakeSensor("footbot_proximity", "generic_footbot_proximity", {});
  for (auto _ : state)
  {
    world.NextTick();
    sensor->Update({});
  }
}
BENCHMARK(Reserve)->Arg(0)->Arg(1000)->Arg(4000)->Arg(16000)->ArgName("waiting")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace swarmanoid

BENCHMARK_MAIN();
