// Cost of the kinematic engine's plane cut into regions: the crowd of kinematics2d_bench, with each region in a
// separate thread, and messages by memory. Time is the processor time of all regions together. Arguments: robots,
// robots per square metre, regions.
#include <benchmark/benchmark.h>

#include "engine_worker/engines/kinematics2d/region_cuts.h"
#include "kinematic_crowd.h"
#include "tests/unit/kinematics2d/region_hub.h"

namespace swarmanoid::kinematics2d
{
namespace
{

constexpr std::uint32_t kWarmUp = 30;  // ticks
constexpr std::uint32_t kTicks = 20;   // ticks of an iteration

void AdvanceRegions(benchmark::State& state)
{
  const auto count = static_cast<std::uint32_t>(state.range(0));
  const auto density = static_cast<double>(state.range(1));
  const auto regions = static_cast<unsigned>(state.range(2));
  KinematicWorld world = Crowd(count, density, 1);
  HubTeam team(regions);
  if (regions > 1)
  {
    world.Split(team);
    world.MoveCuts(CutPlane(world.BodiesInBlocks(), world.BlockColumns(), {regions, 0}));
  }
  // Returns the processor time of all regions, and of the world that is split (s).
  std::uint32_t tick = 0;
  double of_world = 0;
  double slowest = 0;
  const auto advance = [&](std::uint32_t ticks)
  {
    double seconds = 0;
    of_world = slowest = 0;
    for (const std::uint32_t end = tick + ticks; tick < end; ++tick)
    {
      SteerEach(count, tick, [&](std::uint32_t body, const Twist& twist) { world.SetTwist(body, twist); });
      const double start = HubTeam::ThreadSeconds();
      world.Advance(kTick, 1);
      of_world += HubTeam::ThreadSeconds() - start;
      if (regions > 1) slowest += team.SlowestSeconds();
      seconds += HubTeam::ThreadSeconds() - start + (regions > 1 ? team.Seconds() : 0);
    }
    return seconds;
  };
  const Hub& hub = team.Exchanges();

  advance(kWarmUp);
  const std::uint64_t bytes = hub.Bytes();
  const std::uint64_t rounds = hub.Rounds();
  const std::uint32_t start = tick;
  for (auto _ : state) state.SetIterationTime(advance(kTicks) / kTicks);
  const double ticks = tick - start;
  // The metres of border between regions, if cuts halve a square repeatedly.
  double border = 0;
  for (unsigned cuts = 1; cuts < regions; cuts *= 2)
    border += std::sqrt(count / density) * (cuts == 1 ? 1 : cuts == 2 ? 1 : 2);
  std::size_t held = 0;
  for (unsigned region = 0; region < regions; ++region) held += regions > 1 ? team.Region(region).BodyCount() : count;
  const double bytes_a_tick = static_cast<double>(hub.Bytes() - bytes) / ticks;
  state.counters["bytes_per_border_metre"] = border > 0 ? bytes_a_tick / border : 0;
  state.counters["exchanges"] = static_cast<double>(hub.Rounds() - rounds) / ticks;
  state.counters["task_bytes_per_robot"] = static_cast<double>(team.TaskBytes()) / count;
  state.counters["world_ns_per_robot"] = of_world / kTicks / count * 1e9;
  state.counters["slowest_us"] = slowest / kTicks * 1e6;
  state.counters["held_per_robot"] = static_cast<double>(held) / count;
}
BENCHMARK(AdvanceRegions)
    ->ArgsProduct({{10000, 100000}, {1, 10, 20}, {1, 2, 4, 8}})
    ->ArgNames({"robots", "density", "regions"})
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace swarmanoid::kinematics2d

BENCHMARK_MAIN();
