// Time of the kinematic engine's solver per robot and step: footbots that wander in a walled square.
// Arguments: robots, robots per square metre, threads.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "common/math/elementary.h"
#include "common/math/random.h"
#include "engine_worker/engines/kinematics2d/kinematic_world.h"

namespace swarmanoid::kinematics2d
{
namespace
{

constexpr double kTick = 0.1;
constexpr int kWarmUp = 100;  // ticks, so that the crowd is mixed and buffers have grown

CollisionModel Box(double min_x, double min_y, double max_x, double max_y)
{
  const std::array<Vector2, 4> corners{Vector2(max_x, min_y), Vector2(max_x, max_y), Vector2(min_x, max_y),
                                       Vector2(min_x, min_y)};
  return MakeModel({}, {MakePolygon(corners)});
}

KinematicWorld Crowd(std::uint32_t count, double density, unsigned threads)
{
  KinematicWorld world;
  const auto footbot = world.AddModel(FootbotModel());
  const double side = std::sqrt(count / density);
  const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(count)));
  const double spacing = side / columns;
  RandomStream random(1, 0, 0, 0);
  for (std::uint32_t k = 0; k < count; ++k)
    world.AddBody(footbot,
                  {(k % columns + 0.5) * spacing, (k / columns + 0.5) * spacing, RotorOf(random.Uniform(-kPi, kPi))});
  world.AddStatic(Box(-0.1, -0.1, 0, side + 0.1));
  world.AddStatic(Box(side, -0.1, side + 0.1, side + 0.1));
  world.AddStatic(Box(-0.1, -0.1, side + 0.1, 0));
  world.AddStatic(Box(-0.1, side, side + 0.1, side + 0.1));
  world.Start({0, 0, side, side}, threads);
  return world;
}

// New speeds for a twentieth of the robots, forward as often as back: without avoidance, a crowd that only goes forward
// would jam along the walls.
void Steer(KinematicWorld& world, std::uint32_t tick)
{
  RandomStream random(2, 0, 0, tick);
  for (std::uint32_t k = tick % 20; k < world.BodyCount(); k += 20)
    world.SetTwist(k, {random.Uniform(-0.2, 0.2), 0, random.Uniform(-1, 1)});
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
