// Bodies that go farther in a step than they are wide do not pass through what is thin.
#include <octomap/octomap.h>
#include <ode/ode.h>

#include "dynamics3d_test_world.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

// A floor of one layer of cells of 5 cm, 2 m by 2 m, whose surface is at z = 0.
std::string FloorOfCells(const test::TemporaryFolder& folder)
{
  octomap::OcTree tree(0.05);
  for (int x = 0; x < 40; ++x)
    for (int y = 0; y < 40; ++y)
      tree.updateNode(
          octomap::point3d(0.025F + 0.05F * static_cast<float>(x), 0.025F + 0.05F * static_cast<float>(y), -0.025F),
          true, true);
  tree.updateInnerOccupancy();
  std::string path = folder / "floor.bt";
  tree.writeBinary(path);
  return path;
}

TEST(Dynamics3dFastBodies, PlatesAndSmallPreysDoNotFallThroughCells)
{
  const test::TemporaryFolder folder;
  const std::string file = FloorOfCells(folder);
  for (const double speed : {10.0, 20.0, 40.0})
    for (const double lean : {0.0, 30.0, 90.0})
      for (int phase = 0; phase < 5; ++phase)
      {
        Dynamics3dTestWorld world("ground", "false");
        world.experiment.clock_tick_ms = 10;
        const Quaternion leaning(Eigen::AngleAxisd(DegreesToRadians(lean), Vector3(1, 0.3, 0).normalized()));
        const double height = 1 + speed * 1e-3 * phase;
        world.AddBlock({0.5, 0.5, height}, {0.2, 0.2, 0.01}, 0.3, leaning);
        world.AddPrey({1, 1, height}, 0.05, 0.02, 0.02);
        world.AddBlock({1.5, 1.5, height}, {0.05, 0.05, 0.05}, 0.1, leaning);
        world.AddTerrain("octomap", {{"file", file}}, Vector3::Zero());
        world.Start();
        for (int body = 0; body < 3; ++body) dBodySetLinearVel(world.engine->WorldForTest().Body(body), 0, 0, -speed);
        for (int tick = 0; tick < 40; ++tick)
        {
          world.Tick();
          for (std::uint32_t body = 0; body < 3; ++body)
          {
            const Vector3 place = world.Position(body);
            const bool is_over_floor = place.x() > 0.02 && place.x() < 1.98 && place.y() > 0.02 && place.y() < 1.98;
            ASSERT_TRUE(!is_over_floor || place.z() > -0.03)
                << "body " << body << " at " << speed << " m/s, lean " << lean << ", height " << place.z();
          }
        }
      }
}

TEST(Dynamics3dFastBodies, ABlockIsStoppedByAThinWall)
{
  for (const double speed : {5.0, 10.0, 20.0})
    for (int phase = 0; phase < 10; ++phase)
    {
      Dynamics3dTestWorld world;
      world.experiment.clock_tick_ms = 10;
      const auto block = world.AddBlock({2 + speed * 5e-4 * phase, 5, 0.5}, {0.05, 0.2, 0.2}, 0.3);
      world.AddWall({3, 5, 0.5}, {0.01, 2, 1});
      world.Start();
      dBodySetLinearVel(world.engine->WorldForTest().Body(0), speed, 0, 0);
      world.Run(50);
      EXPECT_LT(world.Position(block).x(), 3) << speed << " m/s, phase " << phase;
    }
}

// A body that is fast, but near nothing thin, costs nothing.
TEST(Dynamics3dFastBodies, AStepIsCutOnlyWhereAFastBodyMeetsSomethingThin)
{
  Dynamics3dTestWorld world;
  world.AddBlock({2, 5, 2.0}, {0.2, 0.2, 0.01}, 0.3);
  world.AddWall({6, 5, 0.5}, {0.01, 2, 1});
  world.Start();
  dynamics3d::OdeWorld& ode = world.engine->WorldForTest();
  dBodySetLinearVel(ode.Body(0), 20, 0, 0);
  world.Tick();
  EXPECT_EQ(world.engine->MostParts(), 1);
  dBodySetPosition(ode.Body(0), 5.85, 5, 0.5);
  dBodySetLinearVel(ode.Body(0), 20, 0, 0);
  world.Tick();
  // 10 cm and the gain of gravity, over a quarter of two centimetres.
  EXPECT_EQ(world.engine->MostParts(), 21);
}

}  // namespace
}  // namespace swarmanoid
