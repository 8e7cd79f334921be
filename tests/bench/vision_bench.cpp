// Cost of the sensors that need lines of sight: range and bearing, and the pie camera with a view of 3 m; all robots
// send and are lit. Arguments: number of robots, robots per 10 m^2.
#include <benchmark/benchmark.h>

#include "bench_world.h"

namespace swarmanoid
{
namespace
{

void Sense(benchmark::State& state, const char* type, const char* implementation,
           const test::TestParameters& parameters)
{
  BenchWorld world(static_cast<int>(state.range(0)), static_cast<double>(state.range(1)) / 10);
  for (const std::uint32_t robot : world.Robots())
  {
    CSwarmanoidSpaceEntity& entity = world.Space().GetEntity(robot);
    entity.SetAttribute("message", 1);
    for (int led = 0; led < 12; ++led) entity.SetAttribute("led", robot % 2 == 0 ? 0xff0000 : 0x0000ff, led);
  }
  const auto sensor = world.MakeSensor(type, implementation, parameters);
  for (auto _ : state)
  {
    world.NextTick();
    sensor->Update({});
  }
  state.counters["ns_per_robot"] =
      benchmark::Counter(static_cast<double>(state.range(0)) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void Densities(benchmark::internal::Benchmark* bench)
{
  bench->Args({1000, 10})->Args({10000, 10})->Args({1000, 100})->Unit(benchmark::kMicrosecond);
}

BENCHMARK_CAPTURE(Sense, range_and_bearing, "range_and_bearing", "generic_range_and_bearing", test::TestParameters{})
    ->Apply(Densities);
BENCHMARK_CAPTURE(Sense, pie_camera, "pie_camera", "generic_pie_camera", test::TestParameters{{"aperture", "88"}})
    ->Apply(Densities);
BENCHMARK_CAPTURE(Sense, omnidirectional_camera, "footbot_omnidirectional_camera",
                  "generic_footbot_omnidirectional_camera", test::TestParameters{})
    ->Apply(Densities);
BENCHMARK_CAPTURE(Sense, range_and_bearing_with_noise, "range_and_bearing", "generic_range_and_bearing",
                  test::TestParameters{{"range_noise_kind", "gaussian"},
                                       {"range_noise_deviation", "0.05"},
                                       {"bearing_noise_kind", "gaussian"},
                                       {"bearing_noise_deviation", "0.05"}})
    ->Args({1000, 10})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Sense, omnidirectional_camera_with_noise, "footbot_omnidirectional_camera",
                  "generic_footbot_omnidirectional_camera",
                  test::TestParameters{{"distance_noise_kind", "gaussian"},
                                       {"distance_noise_deviation", "0.02"},
                                       {"angle_noise_kind", "gaussian"},
                                       {"angle_noise_deviation", "0.02"}})
    ->Args({1000, 10})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Sense, ground, "footbot_ground", "generic_footbot_ground", test::TestParameters{})->Args({1000, 10});
BENCHMARK_CAPTURE(Sense, light, "footbot_light", "generic_footbot_light", test::TestParameters{})->Args({1000, 10});

}  // namespace
}  // namespace swarmanoid

BENCHMARK_MAIN();
