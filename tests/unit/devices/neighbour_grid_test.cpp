// One thread and several threads make the same grid of neighbours.
#include "controller_host/devices/sensing/neighbour_grid.h"

#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

// All that sensors may ask of a grid.
struct SeenRobots
{
  explicit SeenRobots(const NeighbourGrid& grid)
  {
    const std::span<const std::uint32_t> sorted = grid.Sorted();
    bodies.assign(sorted.begin(), sorted.end());
    for (std::size_t place = 0; place < sorted.size(); ++place)
      for (const double at : {grid.OriginX()[place], grid.OriginY()[place], grid.OriginZ()[place]})
        origins.push_back(at);
    facts = {grid.AllUpright(), grid.AllLevel(), grid.AreAlike()};
    for (double x = 0.5; x < 50; x += 3)
      for (double y = 0.5; y < 50; y += 3)
        grid.ForEachNear(x, y, 0.7, [&](std::uint32_t body) { near.push_back(body); });
  }
  bool operator==(const SeenRobots&) const = default;

  std::vector<std::uint32_t> bodies, near;
  std::vector<double> origins;
  std::vector<bool> facts;
};

// A swarm of which the body `odd` differs.
enum class Odd
{
  kNone,
  kTilted,
  kLifted,
  kPrey,
  kAbsent
};
void Compare(Odd odd, std::uint32_t which)
{
  SCOPED_TRACE(testing::Message() << "kind " << static_cast<int>(odd) << ", body " << which);
  TestWorld world;
  world.Configuration().arena_size = {50, 50, 2};
  RandomStream random(which, 4, 0, 0);
  for (std::uint32_t e = 0; e < 2600; ++e)
  {
    const double x = random.Uniform(0, 50);
    const double y = random.Uniform(0, 50);
    if (e == which && odd == Odd::kPrey)
      world.AddPrey(x, y, 0.3, 0.2);
    else
      world.AddFootbot(x, y, 0, e == which && odd == Odd::kLifted ? 0.4 : 0);
  }
  EntityConfiguration& entity = world.Configuration().entities[which];
  if (odd == Odd::kTilted) entity.pose.orientation = QuaternionFromEuler({0.3, 0.2, 0});
  if (odd == Odd::kAbsent) entity.waits = true;
  const CSwarmanoidSpace& space = world.Space();
  const BodyShapes shapes(space);
  NeighbourGrid alone(space, shapes);
  alone.Rebuild();
  const SeenRobots expected(alone);
  EXPECT_EQ(expected.bodies.size(), odd == Odd::kAbsent ? 2599U : 2600U);
  EXPECT_EQ(expected.facts,
            (std::vector<bool>{odd != Odd::kTilted, odd != Odd::kLifted, odd == Odd::kNone || odd == Odd::kAbsent}));
  for (const unsigned threads : {2U, 3U})
  {
    WorkerPool pool(threads);
    NeighbourGrid shared(space, shapes);
    // A second time: nothing of the first one is left.
    for (int time = 0; time < 2; ++time) shared.Rebuild(&pool);
    EXPECT_TRUE(SeenRobots(shared) == expected) << threads << " threads";
  }
}

TEST(NeighbourGrid, ThreadsChangeNothing)
{
  for (const Odd odd : {Odd::kNone, Odd::kTilted, Odd::kLifted, Odd::kPrey, Odd::kAbsent})
    for (const std::uint32_t which : {0U, 1300U, 2599U}) Compare(odd, which);
}

// Eight at a time find the same as one by one: the same bodies in the same order, but oneself.
TEST(NeighbourGrid, FindsOthersAroundSeveralBodiesAsAroundEach)
{
  TestWorld world;
  world.Configuration().arena_size = {8, 5, 2};
  RandomStream random(6, 4, 0, 0);
  // Some of them are outside the arena.
  for (int n = 0; n < 200; ++n) world.AddFootbot(random.Uniform(-1, 9), random.Uniform(-1, 6));
  world.AddPrey(4, 3, 0.4, 0.2);
  const BodyShapes shapes(world.Space());
  NeighbourGrid grid(world.Space(), shapes);
  grid.Rebuild();
  const std::ptrdiff_t count = std::ssize(grid.Sorted());
  std::size_t pairs = 0;
  for (const double reach : {0.05, 0.2, 1.5})
    for (std::ptrdiff_t first = 0; first + kLanes <= count; first += kLanes)
    {
      std::array<std::int32_t, kLanes> places;
      for (int lane = 0; lane < kLanes; ++lane) places[lane] = static_cast<std::int32_t>(first) + kLanes - 1 - lane;
      CellWindows windows;
      grid.FindWindows(places.data(), reach, windows);
      for (std::size_t lane = 0; lane < kLanes; ++lane)
      {
        const auto place = static_cast<std::size_t>(places[lane]);
        std::vector<std::size_t> expected, found;
        grid.ForEachPlaceNear(grid.OriginX()[place], grid.OriginY()[place], reach,
                              [&](std::size_t other)
                              {
                                if (other != place) expected.push_back(other);
                              });
        grid.ForEachOtherNear(place, reach, windows, lane, [&](std::size_t other) { found.push_back(other); });
        ASSERT_EQ(found, expected) << "reach " << reach << ", place " << place;
        pairs += found.size();
      }
    }
  EXPECT_GT(pairs, 3000U);
}

}  // namespace
}  // namespace swarmanoid
