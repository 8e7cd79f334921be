// Blocks that collide as convex hulls: a hull of the corners of a box is that box, others rest and slide as they must.
#include "common/math/random.h"
#include "common/mesh/convex_hull.h"
#include "dynamics3d_test_world.h"
#include "test_folders.h"

namespace swarmanoid
{
namespace
{

std::vector<Vector3> BoxCorners(const Vector3& size)
{
  std::vector<Vector3> corners;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5}) corners.push_back(size.cwiseProduct(Vector3(x, y, z)));
  return corners;
}

// A regular tetrahedron of this edge on its base, whose middle is below the origin.
std::vector<Vector3> Tetrahedron(double edge)
{
  const double r = edge / std::sqrt(3.0);
  const double height = edge * std::sqrt(2.0 / 3);
  return {{r, 0, -height / 2}, {-r / 2, edge / 2, -height / 2}, {-r / 2, -edge / 2, -height / 2}, {0, 0, height / 2}};
}

std::uint32_t AddHull(Dynamics3dTestWorld& world, const std::vector<Vector3>& corners, const Vector3& position,
                      double mass, const Quaternion& orientation = Quaternion::Identity(), bool movable = true)
{
  Eigen::AlignedBox3d box;
  for (const Vector3& corner : corners) box.extend(corner);
  const auto entity = world.Add(EntityKind::kBlock, position, orientation, box.sizes(), mass, movable);
  world.experiment.entities[entity].hull = std::make_shared<const ConvexHull>(HullOf(corners));
  return entity;
}

TEST(Dynamics3dHulls, ATetrahedronRestsOnItsBaseAndOnTheSideThatItFallsOn)
{
  const double edge = 0.3;
  const double height = edge * std::sqrt(2.0 / 3);
  for (const double tilt : {0.0, 80.0, 105.0, 150.0})
  {
    Dynamics3dTestWorld world;
    const auto body = AddHull(world, Tetrahedron(edge), {5, 5, 0.3}, 1,
                              QuaternionFromEuler({DegreesToRadians(tilt / 10), DegreesToRadians(tilt), 0}));
    world.Run(100);
    // The centre of mass is at a quarter of its height, whichever side it is on.
    const Vector3 centre = world.Position(body) + world.Orientation(body) * Vector3(0, 0, -height / 4);
    EXPECT_NEAR(centre.z(), height / 4, 1e-3) << tilt;
    EXPECT_EQ(world.engine->WorldForTest().SleeperCount(), 1U) << tilt;
  }
}

TEST(Dynamics3dHulls, AWedgeRestsOnItsSlopeOrItsBase)
{
  // The wedge is right-angled, 0.4 m long and 0.2 m high.
  const std::vector<Vector3> wedge{{-0.2, -0.1, -0.1}, {0.2, -0.1, -0.1}, {-0.2, -0.1, 0.1},
                                   {-0.2, 0.1, -0.1},  {0.2, 0.1, -0.1},  {-0.2, 0.1, 0.1}};
  Dynamics3dTestWorld world;
  const auto base = AddHull(world, wedge, {3, 5, 0.12}, 1);
  const auto slope = AddHull(world, wedge, {7, 5, 0.3}, 1, QuaternionFromEuler({0, DegreesToRadians(150), 0}));
  world.Run(100);
  EXPECT_NEAR(world.Position(base).z(), 0.1, 1e-3);
  EXPECT_LT(world.Tilt(base), 1e-3);
  // Its centre of mass is a third of each side from the right angle; so high above the slope.
  const Vector3 centre = world.Position(slope) + world.Orientation(slope) * Vector3(-0.2 + 0.4 / 3, 0, -0.1 + 0.2 / 3);
  EXPECT_NEAR(centre.z(), 0.4 * 0.2 / std::hypot(0.4, 0.2) / 3, 1e-3);
}

TEST(Dynamics3dHulls, AHullOfABoxFallsTipsAndRestsAsTheBox)
{
  const Vector3 size(0.3, 0.2, 0.1);
  const Quaternion tilted = QuaternionFromEuler({0.4, 0.9, 0.3});
  Dynamics3dTestWorld world;
  const auto box = world.AddBlock({3, 5, 0.5}, size, 2, tilted);
  const auto hull = AddHull(world, BoxCorners(size), {7, 5, 0.5}, 2, tilted);
  world.Run(2);
  EXPECT_NEAR(world.Position(hull).z(), world.Position(box).z(), 1e-12);
  world.Run(98);
  EXPECT_NEAR(world.Position(hull).z(), world.Position(box).z(), 1e-3);
  EXPECT_NEAR(world.Position(hull).z(), 0.05, 1e-3);
  EXPECT_EQ(world.engine->WorldForTest().SleeperCount(), 2U);
}

// It lies on a slope of 20 degrees, whose tangent is 0.364.
TEST(Dynamics3dHulls, AHullSlidesWhereFrictionIsLessThanTheSlope)
{
  const double slope = DegreesToRadians(20);
  for (const char* friction : {"0.34", "0.39"})
  {
    Dynamics3dTestWorld world("friction", friction);
    const Quaternion turn = QuaternionFromEuler({0, slope, 0});
    world.Add(EntityKind::kBlock, {5, 5, 1}, turn, {4, 2, 0.2}, 0, false);
    const Vector3 up = turn * Vector3::UnitZ();
    const auto hull = AddHull(world, BoxCorners({0.2, 0.2, 0.1}), Vector3(5, 5, 1) + 0.15 * up, 1, turn);
    world.Run(20);
    const double way = (world.Position(hull) - (Vector3(5, 5, 1) + 0.15 * up)).norm();
    if (friction[3] == '9')
      EXPECT_LT(way, 2e-3);
    else
      EXPECT_NEAR(way, 0.5 * 9.81 * (std::sin(slope) - 0.34 * std::cos(slope)) * 4, 0.06);
  }
}

TEST(Dynamics3dHulls, AFreeBodyKeepsItsAngularMomentum)
{
  Dynamics3dTestWorld world("gravity", "0, 0, 0");
  const auto body = AddHull(world, Tetrahedron(0.5), {5, 5, 1.5}, 1);
  world.experiment.entities[body].hull = std::make_shared<const ConvexHull>(
      HullOf(std::vector<Vector3>{{0, 0, 0}, {0.4, 0, 0}, {0, 0.2, 0}, {0, 0, 0.3}}));
  world.Start();
  const auto body_of_ode = [&] { return world.engine->WorldForTest().Body(0); };
  dBodySetAngularVel(body_of_ode(), 1, 0.5, -0.7);
  const auto momentum = [&]() -> Vector3
  {
    const dBodyID ode = body_of_ode();
    dMass mass;
    dBodyGetMass(ode, &mass);
    const Vector3 rate = dynamics3d::VectorFromWorld(ode, dynamics3d::VectorOf(dBodyGetAngularVel(ode)));
    Eigen::Matrix3d inertia;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) inertia(i, j) = mass.I[4 * i + j];
    return dynamics3d::VectorToWorld(ode, inertia * rate);
  };
  const Vector3 before = momentum();
  const Vector3 place = dynamics3d::VectorOf(dBodyGetPosition(body_of_ode()));
  world.Run(20);
  EXPECT_LT((momentum() - before).norm(), 0.02 * before.norm());
  EXPECT_LT((dynamics3d::VectorOf(dBodyGetPosition(body_of_ode())) - place).norm(), 1e-9);
}

TEST(Dynamics3dHulls, APileOfHullsAndBoxesStands)
{
  const Vector3 cube(0.2, 0.2, 0.2);
  Dynamics3dTestWorld world;
  std::vector<std::uint32_t> pile;
  for (int k = 0; k < 10; ++k)
    pile.push_back(k % 3 == 1 ? world.AddBlock({5, 5, 0.1 + 0.2 * k}, cube, 1)
                              : AddHull(world, BoxCorners(cube), {5, 5, 0.1 + 0.2 * k}, 1));
  world.Run(300);
  for (std::size_t k = 0; k < pile.size(); ++k)
  {
    EXPECT_LT((world.Position(pile[k]) - Vector3(5, 5, 0)).head<2>().norm(), 0.005) << k;
    EXPECT_NEAR(world.Position(pile[k]).z(), 0.1 + 0.2 * static_cast<double>(k), 0.005) << k;
  }
  EXPECT_EQ(world.engine->WorldForTest().SleeperCount(), pile.size());
}

// A robot pushes a hull, and stops before a fixed hull as before a box.
TEST(Dynamics3dHulls, ARobotPushesAHullAndStopsAtOneThatStands)
{
  const Vector3 size(0.2, 0.2, 0.1);
  Dynamics3dTestWorld world;
  const auto pusher = world.AddFootbot({5, 3, 0});
  const auto pushed = AddHull(world, BoxCorners(size), {5.3, 3, 0.05}, 0.3);
  const auto before_hull = world.AddFootbot({5, 5, 0});
  AddHull(world, BoxCorners(size), {5.5, 5, 0.05}, 0, Quaternion::Identity(), false);
  const auto before_box = world.AddFootbot({5, 7, 0});
  world.AddWall({5.5, 7, 0.05}, size);
  world.Start();
  for (const auto robot : {pusher, before_hull, before_box}) world.Drive(robot, 0.1, 0.1);
  world.Run(80);
  EXPECT_NEAR(world.Position(pushed).x(), world.Position(pusher).x() + 0.085036758 + 0.1, 2e-3);
  EXPECT_GT(world.Position(pusher).x(), 5.6);
  EXPECT_NEAR(world.Position(before_hull).x(), world.Position(before_box).x(), 1e-3);
  EXPECT_NEAR(world.Position(before_hull).x(), 5.4 - 0.085036758, 2e-3);
}

// A cylinder that stands on a hull, one that leans on its corner, and a hull on a cylinder.
TEST(Dynamics3dHulls, CylindersAndHullsBearOneAnother)
{
  const Vector3 size(0.4, 0.4, 0.1);
  Dynamics3dTestWorld world;
  AddHull(world, BoxCorners(size), {3, 5, 0.05}, 5);
  const auto above = world.AddPrey({3, 5, 0.1}, 0.5);
  world.AddPrey({7, 5, 0}, 2);
  const auto on_prey = AddHull(world, BoxCorners(size), {7, 5, 0.15}, 0.5);
  world.Run(100);
  EXPECT_NEAR(world.Position(above).z(), 0.1, 1e-3);
  EXPECT_LT(world.Tilt(above), 2e-3);
  EXPECT_NEAR(world.Position(on_prey).z(), 0.15, 1e-3);
  EXPECT_LT(world.Tilt(on_prey), 2e-3);
  EXPECT_EQ(world.engine->WorldForTest().SleeperCount(), 4U);
}

// Many bodies of many corners are thrown together: none goes through the ground, and all come to rest.
TEST(Dynamics3dHulls, AHeapOfStonesComesToRest)
{
  Dynamics3dTestWorld world;
  for (const double side : {-0.6, 0.6})
  {
    world.AddWall({5 + side, 5, 0.5}, {0.1, 1.3, 1});
    world.AddWall({5, 5 + side, 0.5}, {1.3, 0.1, 1});
  }
  std::vector<std::uint32_t> stones;
  RandomStream random(7, 0, 0, 0);
  for (int k = 0; k < 20; ++k)
  {
    std::vector<Vector3> corners;
    for (int c = 0; c < 30; ++c)
      corners.push_back(0.12 *
                        Vector3(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)).normalized());
    stones.push_back(
        AddHull(world, corners, {5 + 0.2 * (k % 3 - 1), 5 + 0.25 * (k / 3 % 3 - 1), 0.2 + 0.3 * (k / 9)}, 0.5));
  }
  world.Run(300);
  for (const auto stone : stones)
  {
    EXPECT_GT(world.Position(stone).z(), 0.05);
    EXPECT_LT((world.Position(stone) - Vector3(5, 5, 0)).head<2>().cwiseAbs().maxCoeff(), 0.5);
  }
  EXPECT_GE(world.engine->WorldForTest().SleeperCount(), 15U);
}

// On hills of a height map and on rough ground of cells nothing falls through.
TEST(Dynamics3dHulls, HullsRestOnTerrain)
{
  const std::string folder = SWARMANOID_SOURCE_FOLDER "/configs/terrain/";
  for (const bool cells : {false, true})
  {
    Dynamics3dTestWorld world("ground", "false");
    const Vector3 size(0.2, 0.16, 0.1);
    const auto box = world.AddBlock({0.5, 0.6, 0.3}, size, 0.5);
    const auto hull = AddHull(world, BoxCorners(size), {0.5, 0.6, 0.45}, 0.5);
    const auto stone = AddHull(world, Tetrahedron(0.2), {1.2, 1.1, 0.3}, 0.5);
    if (cells)
      world.AddTerrain("octomap", {{"file", folder + "rough_holes.bt"}}, Vector3::Zero());
    else
      world.AddTerrain("heightmap", {{"file", folder + "hills.png"}, {"size", "4, 4"}, {"height", "0.06"}},
                       Vector3::Zero());
    world.Run(150);
    // A box is below a hull, and each is 0.1 m high.
    EXPECT_NEAR((world.Position(hull) - world.Position(box)).norm(), 0.1, 2e-3) << cells;
    EXPECT_NEAR(world.Position(box).z(), 0.07, 0.03) << cells;
    EXPECT_GT(world.Position(stone).z(), 0.08) << cells;
    EXPECT_EQ(world.engine->WorldForTest().SleeperCount(), 3U) << cells;
  }
}

TEST(Dynamics3dHulls, ARestoredRunIsTheOneThatWasNotInterrupted)
{
  const auto run = [](bool restored)
  {
    Dynamics3dTestWorld world;
    const auto first = AddHull(world, Tetrahedron(0.3), {5, 5, 0.4}, 1, QuaternionFromEuler({0.3, 0.5, 0}));
    const auto second =
        AddHull(world, BoxCorners({0.3, 0.2, 0.1}), {5.05, 5, 0.9}, 1, QuaternionFromEuler({0.3, 0, 0}));
    world.Run(6);
    world.engine->Canonicalise();
    if (restored) world.ReplaceEngineBySavedState();
    world.Run(10);
    return std::pair(world.Position(first), world.Position(second));
  };
  EXPECT_EQ(run(false), run(true));
}

}  // namespace
}  // namespace swarmanoid
