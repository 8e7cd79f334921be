// Cost of the kinematic engine's plane cut into regions: the crowd of kinematics2d_bench, each region in a thread of
// its own, with messages by memory. Time is the processor time of all regions together. Arguments: robots, robots per
// square metre, regions (1, 2 halves, 4 quadrants).
#include <benchmark/benchmark.h>

#include <ctime>
#include <memory>
#include <thread>

#include "kinematic_crowd.h"
#include "tests/unit/kinematics2d/region_hub.h"

namespace swarmanoid::kinematics2d
{
namespace
{

constexpr std::uint32_t kWarmUp = 30;  // ticks
constexpr std::uint32_t kTicks = 20;   // of an iteration

double ThreadSeconds()
{
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<std::uint8_t> Cut(const KinematicWorld& world, unsigned regions)
{
  const std::uint32_t columns = world.BlockColumns();
  const std::uint32_t rows = world.BlockCount() / columns;
  std::vector<std::uint8_t> cut(world.BlockCount());
  for (std::uint32_t k = 0; k < cut.size(); ++k)
  {
    const std::uint32_t right = regions > 1 && 2 * (k % columns) >= columns ? 1 : 0;
    const std::uint32_t upper = regions > 2 && 2 * (k / columns) >= rows ? 2 : 0;
    cut[k] = static_cast<std::uint8_t>(right + upper);
  }
  return cut;
}

void AdvanceRegions(benchmark::State& state)
{
  const auto count = static_cast<std::uint32_t>(state.range(0));
  const auto density = static_cast<double>(state.range(1));
  const auto regions = static_cast<unsigned>(state.range(2));
  Hub hub(regions);
  std::vector<std::unique_ptr<HubExchange>> exchanges;
  std::vector<KinematicWorld> worlds;
  for (unsigned region = 0; region < regions; ++region)
  {
    exchanges.push_back(std::make_unique<HubExchange>(hub, region));
    worlds.push_back(Crowd(count, density, 1));
  }
  if (regions > 1)
    for (unsigned region = 0; region < regions; ++region)
      worlds[region].BecomeRegion(region, Cut(worlds[region], regions), *exchanges[region]);
  // Returns the processor time of all regions (s).
  std::uint32_t tick = 0;
  const auto advance = [&](std::uint32_t ticks)
  {
    std::vector<double> seconds(regions);
    std::vector<std::thread> threads;
    for (unsigned region = 0; region < regions; ++region)
      threads.emplace_back(
          [&, region]
          {
            KinematicWorld& world = worlds[region];
            for (std::uint32_t k = tick; k < tick + ticks; ++k)
            {
              SteerEach(count, k,
                        [&](std::uint32_t number, const Twist& twist)
                        {
                          const std::uint32_t body = regions > 1 ? world.FindBody(number) : number;
                          if (body < world.BodyCount()) world.SetTwist(body, twist);
                        });
              const double start = ThreadSeconds();
              world.Advance(kTick, 1);
              seconds[region] += ThreadSeconds() - start;
            }
          });
    for (std::thread& thread : threads) thread.join();
    tick += ticks;
    double all = 0;
    for (const double of_one : seconds) all += of_one;
    return all;
  };

  advance(kWarmUp);
  const std::uint64_t bytes = hub.Bytes();
  const std::uint64_t rounds = hub.Rounds();
  const std::uint32_t start = tick;
  for (auto _ : state) state.SetIterationTime(advance(kTicks) / kTicks);
  const double ticks = tick - start;
  const double border = (regions == 4 ? 2 : regions == 2 ? 1 : 0) * std::sqrt(count / density);
  std::size_t held = 0;
  for (const KinematicWorld& world : worlds) held += world.BodyCount();
  const double bytes_a_tick = static_cast<double>(hub.Bytes() - bytes) / ticks;
  state.counters["bytes_per_border_metre"] = border > 0 ? bytes_a_tick / border : 0;
  state.counters["exchanges"] = static_cast<double>(hub.Rounds() - rounds) / ticks;
  state.counters["held_per_robot"] = static_cast<double>(held) / count;
}
BENCHMARK(AdvanceRegions)
    ->ArgsProduct({{10000, 100000}, {1, 10, 20}, {1, 2, 4}})
    ->ArgNames({"robots", "density", "regions"})
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace swarmanoid::kinematics2d

BENCHMARK_MAIN();
