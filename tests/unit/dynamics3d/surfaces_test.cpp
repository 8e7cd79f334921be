// Tests friction and restitution of single entities.
#include "dynamics3d_test_world.h"

#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

void Give(Dynamics3dTestWorld& world, std::uint32_t entity, const test::TestParameters& attributes)
{
  world.experiment.entities[entity].tree = test::TreeOf(attributes);
}

// On a ground of 15 degrees, where tan is 0.268: what rubs less slides with g (sin - mu cos), the others hold.
TEST(Dynamics3dSurfaces, ABlockSlidesOnTheGroundByItsOwnGroundFriction)
{
  Dynamics3dTestWorld world("orientation", "0, 15, 0");
  const Quaternion tilt = QuaternionFromEuler({0, DegreesToRadians(15), 0});
  std::vector<std::uint32_t> blocks;
  for (int k = 0; k < 3; ++k) blocks.push_back(world.AddBlock(tilt * Vector3(0, k, 0.05), {0.4, 0.4, 0.1}, 2, tilt));
  Give(world, blocks[1], {{"ground_friction", "0.1"}});
  Give(world, blocks[2], {{"friction", "0.1"}});  // is for other bodies
  world.Run(20);
  const auto slid = [&](int k) { return (tilt.conjugate() * world.Position(blocks[static_cast<std::size_t>(k)])).x(); };
  const double way = 9.81 * (Sin(DegreesToRadians(15)) - 0.1 * Cos(DegreesToRadians(15))) * 4 / 2;
  EXPECT_NEAR(slid(0), 0, 2e-3);
  EXPECT_NEAR(slid(1), way, 0.02 * way);
  EXPECT_NEAR(slid(2), 0, 2e-3);
}

// The same on a tilted board: the geometric mean of 0.04 and 0.25 is 0.1, with the engine's 0.5 it is 0.354.
TEST(Dynamics3dSurfaces, TwoBodiesRubByTheMeanOfTheirFrictions)
{
  for (const bool slippery : {true, false})
  {
    Dynamics3dTestWorld world;
    const Quaternion tilt = QuaternionFromEuler({0, DegreesToRadians(15), 0});
    const auto board = world.Add(EntityKind::kBlock, {5, 5, 3}, tilt, {8, 1, 0.1}, 0, false);
    const auto block = world.AddBlock(Vector3(5, 5, 3) + tilt * Vector3(-2, 0, 0.1), {0.4, 0.4, 0.1}, 2, tilt);
    if (slippery) Give(world, board, {{"friction", "0.04"}});
    Give(world, block, {{"friction", "0.25"}});
    world.Run(15);
    const double way = 9.81 * (Sin(DegreesToRadians(15)) - 0.1 * Cos(DegreesToRadians(15))) * 2.25 / 2;
    const double slid = (tilt.conjugate() * (world.Position(block) - Vector3(5, 5, 3))).x() + 2;
    EXPECT_NEAR(slid, slippery ? way : 0, slippery ? 0.02 * way : 2e-3);
  }
}

// A block that is dropped from half a metre rises again to e^2 of the height; the larger restitution of the two counts.
TEST(Dynamics3dSurfaces, ABlockBouncesByItsOwnRestitution)
{
  Dynamics3dTestWorld world;
  const auto lively = world.AddBlock({5, 5, 0.6}, {0.2, 0.2, 0.2}, 1);
  const auto dead = world.AddBlock({7, 5, 0.6}, {0.2, 0.2, 0.2}, 1);
  Give(world, lively, {{"restitution", "0.6"}});
  world.Run(4);  // on the ground after 0.32 s
  double highest_lively = 0;
  double highest_dead = 0;
  for (int tick = 0; tick < 6; ++tick)
  {
    world.Tick();
    highest_lively = std::max(highest_lively, world.Position(lively).z() - 0.1);
    highest_dead = std::max(highest_dead, world.Position(dead).z() - 0.1);
  }
  EXPECT_NEAR(highest_lively, 0.36 * 0.5, 0.02);
  EXPECT_NEAR(highest_dead, 0, 2e-3);
}

// A wheel on a slippery board: 1 and 0.01 make 0.1, which gives 0.1 g at most.
TEST(Dynamics3dSurfaces, WheelsSlipOnASlipperyBoard)
{
  for (const bool slippery : {true, false})
  {
    Dynamics3dTestWorld world;
    const auto board = world.AddWall({5, 5, -0.05}, {8, 8, 0.1});
    if (slippery) Give(world, board, {{"friction", "0.01"}});
    const auto footbot = world.AddFootbot({3, 5, 0});
    world.Set("ground", "false");
    world.Run(5);
    const double start = world.Position(footbot).x();
    world.Drive(footbot, 1, 1);
    world.Run(5);
    const double way = world.Position(footbot).x() - start;
    const double bound = 0.1 * 9.81 * 0.25 / 2;  // without the load on the casters
    if (slippery)
    {
      EXPECT_LT(way, bound);
      EXPECT_GT(way, 0.6 * bound);
    }
    else
      EXPECT_GT(way, 1.5 * bound);
  }
}

}  // namespace
}  // namespace swarmanoid
