// Measures ns per moved entity and per range query of the positional indexes, at 1 entity per m2 (flat) and per 8 m3
// (3D).
#include <benchmark/benchmark.h>

#include <cmath>

#include "common/math/random.h"
#include "common/space/index/grid_index.h"
#include "common/space/index/octree_index.h"

namespace
{

using namespace swarmanoid;

enum Arrangement
{
  kFlat,
  kLayered,
  kOctree
};

struct Scene
{
  explicit Scene(benchmark::State& state)
      : count(static_cast<std::size_t>(state.range(1))), side(std::sqrt(static_cast<double>(count)))
  {
    const bool flat = state.range(0) == kFlat;
    const Vector3 arena(side, side, flat ? 1 : 8);
    for (std::size_t i = 0; i < count; ++i)
    {
      x.push_back(random.Uniform(0, side));
      y.push_back(random.Uniform(0, side));
      z.push_back(random.Uniform(0, arena.z()));
    }
    if (state.range(0) == kOctree)
      index = std::make_unique<OctreeIndex>();
    else
      index = std::make_unique<GridIndex>(arena, count, !flat);
    state.SetLabel(index->Name());
    index->Update({x, y, z});
  }

  std::size_t count;
  double side;
  RandomStream random{1, 0, 0, 0};
  std::vector<double> x, y, z;
  std::unique_ptr<PositionalIndex> index;
};

void MoveAll(benchmark::State& state)
{
  Scene scene(state);
  double step = 0.01;
  for (auto _ : state)
  {
    for (std::size_t i = 0; i < scene.count; ++i) scene.x[i] += step;
    step = -step;
    scene.index->Update({scene.x, scene.y, scene.z});
  }
  state.counters["ns_per_entity"] =
      benchmark::Counter(static_cast<double>(scene.count) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void QueryThreeMetres(benchmark::State& state)
{
  Scene scene(state);
  std::vector<std::uint32_t> found;
  std::size_t i = 0;
  for (auto _ : state)
  {
    scene.index->FindWithin({scene.x[i], scene.y[i], scene.z[i]}, 3, found);
    benchmark::DoNotOptimize(found.data());
    i = (i + 7919) % scene.count;
  }
}

// The same worlds with each kind of index: what <arena optimization="…"> chooses between. For counts of instructions,
// run one under callgrind with --toggle-collect='*FindWithin*' or '*::Update*'.
enum World
{
  kFlatSwarm,  // 1 per m², all on the floor
  kEyebots,    // 1 per 8 m³, at heights up to 22 m
  kSparse      // the eyebots in a corner of an arena of 10 km
};

constexpr std::size_t kMany = 10000;

Vector3 SizeOf(int world)
{
  if (world == kFlatSwarm) return {100, 100, 1};
  if (world == kEyebots) return {60, 60, 22};
  return {10000, 10000, 100};
}

struct ChosenScene
{
  explicit ChosenScene(benchmark::State& state)
  {
    const int world = static_cast<int>(state.range(0));
    const Vector3 size = SizeOf(world);
    const Vector3 filled = SizeOf(world == kSparse ? kEyebots : world);
    for (std::size_t i = 0; i < kMany; ++i)
    {
      x.push_back(random.Uniform(0, filled.x()));
      y.push_back(random.Uniform(0, filled.y()));
      z.push_back(world == kFlatSwarm ? 0 : random.Uniform(0, filled.z()));
    }
    if (state.range(1) == kOctree)
      index = std::make_unique<OctreeIndex>();
    else
      index = std::make_unique<GridIndex>(size, kMany, state.range(1) == kLayered);
    state.SetLabel(std::string(index->Name()));
    index->Update({x, y, z});
  }

  RandomStream random{1, 0, 0, 0};
  std::vector<double> x, y, z;
  std::unique_ptr<PositionalIndex> index;
};

void MoveInWorld(benchmark::State& state)
{
  ChosenScene scene(state);
  double step = 0.01;
  for (auto _ : state)
  {
    for (double& x : scene.x) x += step;
    step = -step;
    scene.index->Update({scene.x, scene.y, scene.z});
  }
}

void QueryInWorld(benchmark::State& state)
{
  ChosenScene scene(state);
  std::vector<std::uint32_t> found;
  std::size_t i = 0;
  for (auto _ : state)
  {
    scene.index->FindWithin({scene.x[i], scene.y[i], scene.z[i]}, 3, found);
    benchmark::DoNotOptimize(found.data());
    i = (i + 7919) % kMany;
  }
}

void Worlds(benchmark::internal::Benchmark* benchmark)
{
  for (const int world : {kFlatSwarm, kEyebots, kSparse})
    for (const int kind : {kFlat, kLayered, kOctree}) benchmark->Args({world, kind});
}

BENCHMARK(MoveInWorld)->Apply(Worlds)->Iterations(20);
BENCHMARK(QueryInWorld)->Apply(Worlds)->Iterations(2000);

void Sizes(benchmark::internal::Benchmark* benchmark)
{
  for (const int arrangement : {kFlat, kLayered, kOctree})
    for (const int count : {100, 1000, 10000, 100000}) benchmark->Args({arrangement, count});
}

BENCHMARK(MoveAll)->Apply(Sizes);
BENCHMARK(QueryThreeMetres)->Apply(Sizes);

}  // namespace

BENCHMARK_MAIN();
