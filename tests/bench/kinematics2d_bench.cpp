// Time of the kinematic engine's solver per robot and step: footbots that wander in a walled square.
// Arguments: robots, robots per square metre, threads.
#include <benchmark/benchmark.h>

#include "kinematic_crowd.h"

namespace swarmanoid::kinematics2d
{
namespace
{

constexpr int kWarmUp = 100;  // ticks, so that the crowd is mixed and buffers have grown

void Steer(KinematicWorld& world, std::uint32_t tick)
{
  SteerEach(static_cast<std::uint32_t>(world.BodyCount()), tick,
            [&](std::uint32_t body, const Twist& twist) { world.SetTwist(body, twist); });
}

void AdvanceCrowd(benchmark::State& state)
{
  const auto count = static_cast<std::uint32_t>(state.range(0));
  KinematicWorld world = Crowd(count, static_cast<double>(state.range(1)), static_cast<unsigned>(state.range(2)));
  std::uint32_t tick = 0;
  for (; tick < kWarmUp; ++tick)
  {
    Steer(world, tick);
    world.Advance(kTick, 1);
  }
  for (auto _ : state)
  {
    state.PauseTiming();
    Steer(world, tick++);
    state.ResumeTiming();
    world.Advance(kTick, 1);
  }
  state.counters["ns_per_robot"] =
      benchmark::Counter(static_cast<double>(count) * static_cast<double>(state.iterations()) * 1e-9,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["contacts_per_robot"] = static_cast<double>(world.Statistics().contacts) / count;
  state.counters["pairs_per_robot"] = static_cast<double>(world.Statistics().pairs) / count;
  state.counters["held_back"] = static_cast<double>(world.Statistics().held_back);
}
BENCHMARK(AdvanceCrowd)
    ->ArgsProduct({{100, 1000, 10000, 100000}, {1, 10}, {1}})
    ->ArgNames({"robots", "density", "threads"})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(AdvanceCrowd)
    ->ArgsProduct({{10000, 100000}, {1, 10}, {2, 4}})
    ->ArgNames({"robots", "density", "threads"})
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace swarmanoid::kinematics2d

BENCHMARK_MAIN();
