// Time that handbots of the engines of the plane take to look for something to grip, a handbot and tick: all close
// both hands, and nothing is within reach. Argument: handbots, and as many blocks.
#include <benchmark/benchmark.h>

#include <cmath>

#include "common/math/random.h"
#include "common/space/space.h"
#include "engine_worker/engines/plane_robots.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

constexpr double kTick = 0.1;  // s

class NoGrips : public PlaneGrips
{
public:
  bool Hold(std::uint32_t, std::uint32_t) override { return false; }
  void LetGo(std::uint32_t) override {}
  bool Holds(std::uint32_t) const override { return false; }
};

// Returns an experiment with a handbot and a block every two metres, a metre apart.
Experiment Field(std::uint32_t handbots)
{
  Experiment experiment;
  const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(handbots)));
  const double side = 2.0 * columns;
  experiment.arena_size = {side, side, 3};
  const auto add = [&](EntityKind kind, const Vector3& position, const Vector3& size) {
    test::Add(experiment, test::Entity(kind, "e" + std::to_string(experiment.entities.size()), position, size, true));
  };
  for (std::uint32_t k = 0; k < handbots; ++k)
    add(EntityKind::kHandbot, {2.0 * (k % columns) + 0.5, 2.0 * (k / columns) + 0.5, 0}, {0.22, 0.17, 0.16});
  for (std::uint32_t k = 0; k < handbots; ++k)
    add(EntityKind::kBlock, {2.0 * (k % columns) + 1.5, 2.0 * (k / columns) + 1.5, 0.05}, {0.1, 0.1, 0.1});
  return experiment;
}

void LookForObjects(benchmark::State& state)
{
  const auto count = static_cast<std::uint32_t>(state.range(0));
  const Experiment experiment = Field(count);
  const CSwarmanoidSpace space(experiment);
  NoGrips grips;
  PlaneRobots robots;
  robots.Init(space, PlaneFrame(PlaneAxis::kZ, 0), grips);
  ChannelBlock hands;
  hands.name = "handbot_hands";
  hands.width = 2;
  for (std::uint32_t k = 0; k < space.Size(); ++k) robots.AddOwned(space.GetEntity(k));
  for (std::uint32_t k = 0; k < count; ++k) hands.entities.push_back(k);
  robots.Command(hands, std::vector<double>(2 * count, 1.0));
  for (auto _ : state) robots.Advance(kTick);
  state.counters["ns_per_handbot"] = benchmark::Counter(
      static_cast<double>(count) * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(LookForObjects)->Arg(10)->Arg(100)->Arg(800)->Arg(6400)->ArgName("handbots")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace swarmanoid

BENCHMARK_MAIN();
