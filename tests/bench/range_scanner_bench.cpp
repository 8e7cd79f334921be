// Cost of range scanners: one batch over all footbots, including the grid of neighbours, as ns a beam. Robots are at
// random positions without overlap in a walled square arena, 1 per m^2. Arguments: number of robots, beams, layers,
// range (m).
#include <benchmark/benchmark.h>

#include "bench_world.h"
#include "common/control_interface/ci_range_scanner_sensor.h"

namespace swarmanoid
{
namespace
{

void RangeScanners(benchmark::State& state)
{
  BenchWorld world(static_cast<int>(state.range(0)), 1);
  const auto sensor = world.MakeSensor("range_scanner", "generic_range_scanner",
                                       {{"beams", std::to_string(state.range(1))},
                                        {"layers", std::to_string(state.range(2))},
                                        {"range", std::to_string(state.range(3))}});
  for (auto _ : state)
  {
    world.NextTick();
    sensor->Update({});
    // The scanner computes its readings when they are asked for.
    for (std::size_t k = 0; k < static_cast<std::size_t>(state.range(0)); ++k)
      benchmark::DoNotOptimize(
          dynamic_cast<const CCI_RangeScannerSensor&>(*sensor->Sensor(k)).GetAllDistances().data());
  }
  state.counters["ns_per_beam"] =
      benchmark::Counter(static_cast<double>(state.range(0) * state.range(1) * state.range(2)) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(RangeScanners)
    ->ArgNames({"robots", "beams", "layers", "range"})
    ->Args({1000, 360, 1, 10})
    ->Args({1000, 360, 1, 4})
    ->Args({1000, 36, 1, 4})
    ->Args({1000, 36, 1, 10})
    ->Args({100, 900, 16, 10})
    ->Args({100, 360, 1, 10})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace swarmanoid

BENCHMARK_MAIN();
