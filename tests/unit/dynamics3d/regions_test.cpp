// Regions make the steps of an engine that is split. They give the bits of an engine that is not, whatever happens to
// the processes that have them.
#include "swarm_of_rigid_bodies.h"

namespace swarmanoid
{
namespace
{

TEST(RegionsOfDynamics3d, GiveTheBitsOfOneProcess)
{
  struct Case
  {
    double pitch;
    Ground ground;
    const char* iterations;
  };
  for (const Case& scene :
       {Case{0.18, Ground::kPlane, "8"}, Case{0.3, Ground::kPlane, "8"}, Case{0.6, Ground::kPlane, "20"},
        Case{0.4, Ground::kHills, "8"}, Case{0.4, Ground::kCells, "8"}})
  {
    const auto make = [&](const char* threads, unsigned regions)
    { return std::make_unique<RigidSwarm>(threads, scene.pitch, scene.ground, scene.iterations, regions); };
    const auto whole = make("1", 0), one = make("1", 1), two = make("1", 2), four = make("1", 4),
               threads = make("2", 2);
    for (int tick = 0; tick < 12; ++tick)
    {
      whole->Step();
      for (RigidSwarm* swarm : {one.get(), two.get(), four.get(), threads.get()})
      {
        swarm->Step();
        ASSERT_EQ(whole->Space().Hash(), swarm->Space().Hash()) << scene.pitch << ", tick " << tick;
        ASSERT_EQ(whole->engine->StatusText(), swarm->engine->StatusText()) << scene.pitch << ", tick " << tick;
        ASSERT_EQ(whole->engine->MostParts(), swarm->engine->MostParts());
        for (const std::uint32_t robot : whole->Robots())
          for (const char* sensor : {"footbot_encoders", "footbot_turret_torque", "footbot_accelerometer"})
            for (int element = 0; element < 2; ++element)
              ASSERT_EQ(whole->Sensor(sensor, robot, element), swarm->Sensor(sensor, robot, element)) << sensor;
      }
    }
    for (const RigidSwarm* swarm : {one.get(), two.get(), four.get(), threads.get()})
      EXPECT_EQ(whole->Saved(), swarm->Saved()) << scene.pitch;
    EXPECT_EQ(two->Team().BusyRegions(), 2U);
    EXPECT_EQ(four->Team().BusyRegions(), 4U);
  }
}

TEST(RegionsOfDynamics3d, ARegionThatIsReplacedGoesOnWithTheSameBits)
{
  RigidSwarm whole("1", 0.25, Ground::kPlane), split("1", 0.25, Ground::kPlane, "8", 3);
  for (unsigned tick = 0; tick < 60; ++tick)
  {
    TeamOfDynamics3d& team = split.Team();
    if (tick == 15) team.Replace(1);
    if (tick == 30) team.ReplaceAt(team.Works() + 1, 2);
    if (tick == 31) team.ReplaceAt(team.Works() + 1, 0);
    whole.Step();
    split.Step();
    ASSERT_EQ(whole.Space().Hash(), split.Space().Hash()) << tick;
  }
  EXPECT_EQ(whole.Saved(), split.Saved());
}

// Engines that recover, or whose regions come later, make the steps themselves.
TEST(RegionsOfDynamics3d, MayComeAndGoWithTheEngine)
{
  RigidSwarm whole("1", 0.25, Ground::kPlane), split("1", 0.25, Ground::kPlane, "8", 2);
  const auto second = split.MakeTeam(4);
  split.Team().SetReady(false);
  for (int tick = 0; tick < 80; ++tick)
  {
    if (tick == 10) split.Team().SetReady(true);
    if (tick == 25) split.Restore(second.get());
    if (tick == 35) second->SetReady(false);
    if (tick == 45) second->SetReady(true);
    if (tick == 60) split.Restore(nullptr);
    whole.Step();
    split.Step();
    ASSERT_EQ(whole.Space().Hash(), split.Space().Hash()) << tick;
  }
  EXPECT_EQ(whole.Saved(), split.Saved());
  EXPECT_GT(second->Works(), 0U);
}

TEST(RegionsOfDynamics3d, FollowWhatIsDoneFromOutside)
{
  RigidSwarm whole("1", 0.3, Ground::kPlane), split("1", 0.3, Ground::kPlane, "8", 2);
  for (int tick = 0; tick < 60; ++tick)
  {
    for (RigidSwarm* swarm : {&whole, &split})
    {
      const auto move = [&](std::uint32_t robot, double x, double y)
      {
        swarm->Space().SetPose(robot, {Vector3(x, y, 0), QuaternionFromYaw(0.1 * tick)});
        swarm->engine->EntityMoved(robot);
      };
      const auto kick = [&](std::uint32_t robot, double x, double y)
      {
        const dynamics3d::Model& model = *swarm->engine->ModelForTest(robot);
        dBodySetLinearVel(swarm->engine->WorldForTest().Body(model.MainBody()), x, y, 0.5);
      };
      if (tick == 10) move(swarm->Robots()[3], 4, 4);
      if (tick == 11) move(swarm->Robots()[4], 4.2, 4);
      if (tick == 20) move(swarm->Robots()[3], 0.5, 2);
      if (tick == 25) kick(swarm->Robots()[10], 1.5, 0.5);
      if (tick == 35) kick(swarm->Robots()[11], 6, 0.5);  // no robot is free, and steps are cut
      swarm->Step();
    }
    ASSERT_EQ(whole.Space().Hash(), split.Space().Hash()) << tick;
  }
  EXPECT_EQ(whole.Saved(), split.Saved());
}

// All units stop where the first body goes too far, and those that went on make their steps again.
TEST(RegionsOfDynamics3d, StopTogetherIfABodyLeavesItsGroup)
{
  Dynamics3dTestWorld whole("restitution", "1", "friction", "0"), split("restitution", "1", "friction", "0");
  TeamOfDynamics3d team(2, [&] { return split.MakeEngine(nullptr); });
  split.team = &team;
  unsigned most = 0;
  for (Dynamics3dTestWorld* world : {&whole, &split})
  {
    const auto heavy = world->AddPrey({1, 1, 0}, 50);
    for (const double x : {1.205, 1.48}) world->AddPrey({x, 1, 0}, 0.1);
    world->AddPrey({1.48, 1.205, 0}, 0.1);
    const auto robot = world->AddFootbot({3, 1, 0});
    const auto hanging = world->AddHandbot({3, 3, 0});
    world->AddBlock({3.2, 1, 0.1}, {0.1, 0.1, 0.2}, 0.5);
    world->Set("ceiling", "true");
    world->Start();
    for (int tick = 0; tick < 12; ++tick)
    {
      if (tick == 1)
        dBodySetLinearVel(world->engine->WorldForTest().Body(world->engine->ModelForTest(heavy)->MainBody()), 0.9, 0,
                          0);
      world->Drive(robot, 0.3, 0.3);
      world->Command("handbot_rope", hanging, {tick >= 1 ? 1.0 : 0.0, -0.1});
      const unsigned before = team.Works();
      world->Tick();
      most = std::max(most, team.Works() - before);
    }
  }
  EXPECT_GE(most, 3U);
  EXPECT_EQ(whole.Space().Hash(), split.Space().Hash());
}

TEST(RegionsOfDynamics3d, AreNotAskedWhileNothingNeedsTheSolver)
{
  Dynamics3dTestWorld none, one, pair, whole;
  TeamOfDynamics3d team(2, [&] { return pair.MakeEngine(nullptr); });
  for (Dynamics3dTestWorld* world : {&none, &one, &pair}) world->team = &team;
  one.Drive(one.AddFootbot({2, 2, 0}), 0.2, 0.2);
  none.Run(3);
  one.Run(3);
  EXPECT_EQ(team.Works(), 0U);
  for (Dynamics3dTestWorld* world : {&pair, &whole})
  {
    const auto left = world->AddFootbot({2, 2, 0});
    const auto right = world->AddFootbot({2.5, 2, 0}, kPi);
    world->Start();
    world->Drive(left, 0.2, 0.2);
    world->Drive(right, 0.2, 0.21);
    world->Run(30);
  }
  EXPECT_EQ(whole.Space().Hash(), pair.Space().Hash());
  EXPECT_GT(team.Works(), 5U);
  EXPECT_EQ(team.BusyRegions(), 1U);
}

TEST(RegionsOfDynamics3d, LongTasksAndResultsComeInPieces)
{
  Dynamics3dTestWorld whole, split;
  TeamOfDynamics3d team(1, [&] { return split.MakeEngine(nullptr); });
  split.team = &team;
  for (Dynamics3dTestWorld* world : {&whole, &split})
  {
    world->experiment.arena_size = {50, 50, 5};
    for (int i = 0; i < 2500; ++i) world->AddEyebot({1.0 + i % 50, 1.0 + i / 50, 1}, 0.1 * i);
    world->Run(2);
  }
  EXPECT_GT(team.Works(), 5U);
  EXPECT_LT(team.LongestTask(), 600000U);
  EXPECT_EQ(whole.Space().Hash(), split.Space().Hash());
}

TEST(RegionsOfDynamics3d, RefuseTasksThatDoNotFit)
{
  Dynamics3dTestWorld world;
  world.AddFootbot({2, 2, 0});
  world.AddFootbot({2.2, 2, 0});
  world.Start();
  TeamOfDynamics3d team(1, [&] { return world.MakeEngine(nullptr); });
  const auto work = [&](const std::vector<std::uint32_t>& members, std::int32_t to)
  {
    ByteWriter stream;
    stream.Put(std::uint64_t{0});
    stream.Put(std::int32_t{0});
    stream.Put(to);
    stream.Put(false);
    stream.Put(std::uint32_t{0});
    stream.PutArray(members);
    for (int array = 0; array < 4; ++array) stream.PutArray(std::vector<char>());
    std::vector<std::vector<char>> results(1);
    team.Work(
        false,
        [&](bool, std::span<ByteWriter> tasks)
        {
          tasks[0].Put(EStreamStep::kBegins);
          tasks[0].Put(std::uint8_t{1});
          tasks[0].PutArray(stream.Bytes());
        },
        results, [] {});
  };
  EXPECT_THROW(work({0, 5}, 20), std::runtime_error);  // no such assembly
  EXPECT_THROW(work({1, 0}, 20), std::runtime_error);  // another order
  EXPECT_THROW(work({}, 20), std::runtime_error);
  EXPECT_THROW(work({0, 1}, 21), std::runtime_error);  // more steps than a tick has
  EXPECT_THROW(work({0, 1}, 20), std::runtime_error);  // no states
}

}  // namespace
}  // namespace swarmanoid
