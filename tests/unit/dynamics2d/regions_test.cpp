// Regions solve the groups of an engine that is split. They give the bits of an engine that is not, whatever happens to
// the processes that have them.
#include "swarm.h"

namespace swarmanoid
{
namespace
{

// Makes an engine again from its saved state, in the middle of a run.
void Restore(Swarm& swarm, RegionTeam* team)
{
  swarm.engine->Canonicalise();
  swarm.team = team;
  swarm.ReplaceEngineBySavedState();
}

TEST(RegionsOfDynamics2d, GiveTheBitsOfOneProcess)
{
  for (const double pitch : {0.22, 0.3, 0.5})
  {
    TeamOfDynamics2d of_one(1), of_two(2), of_four(4), of_two_with_threads(2);
    Swarm whole("1", pitch);
    Swarm one("1", pitch, &of_one), two("1", pitch, &of_two), four("1", pitch, &of_four);
    Swarm threads("2", pitch, &of_two_with_threads);
    for (int tick = 0; tick < 130; ++tick)
    {
      whole.Step();
      for (Swarm* swarm : {&one, &two, &four, &threads})
      {
        swarm->Step();
        ASSERT_EQ(whole.Space().Hash(), swarm->Space().Hash()) << pitch << ", tick " << tick;
        ASSERT_EQ(whole.engine->StatusText(), swarm->engine->StatusText()) << pitch << ", tick " << tick;
        for (const std::uint32_t robot : whole.Robots())
          for (const char* sensor : {"footbot_encoders", "footbot_turret_torque", "footbot_accelerometer"})
            for (int element = 0; element < 2; ++element)
              ASSERT_EQ(whole.Sensor(sensor, robot, element), swarm->Sensor(sensor, robot, element)) << sensor;
      }
    }
    for (const Swarm* swarm : {&one, &two, &four, &threads}) EXPECT_EQ(whole.Saved(), swarm->Saved());
    EXPECT_EQ(of_two.BusyRegions(), 2U);
    EXPECT_EQ(of_four.BusyRegions(), pitch > 0.25 ? 4U : of_four.BusyRegions());
  }
}

TEST(RegionsOfDynamics2d, ARegionThatIsReplacedGoesOnWithTheSameBits)
{
  for (const double pitch : {0.22, 0.3})
  {
    TeamOfDynamics2d team(3);
    Swarm whole("1", pitch);
    Swarm split("1", pitch, &team);
    for (unsigned tick = 0; tick < 120; ++tick)
    {
      if (tick == 35) team.Replace(1);
      if (tick == 60) team.ReplaceAt(team.Works() + 1, 2);
      if (tick == 61) team.ReplaceAt(team.Works() + 1, 0);
      whole.Step();
      split.Step();
      ASSERT_EQ(whole.Space().Hash(), split.Space().Hash()) << pitch << ", tick " << tick;
    }
    EXPECT_EQ(whole.Saved(), split.Saved());
  }
}

// Engines that recover, or whose regions come later, compute the groups that begin meanwhile.
TEST(RegionsOfDynamics2d, MayComeAndGoWithTheEngine)
{
  TeamOfDynamics2d first(2), second(4);
  Swarm whole("1", 0.3);
  Swarm split("1", 0.3, &first);
  first.SetReady(false);
  for (int tick = 0; tick < 140; ++tick)
  {
    if (tick == 10) first.SetReady(true);
    if (tick == 50) Restore(split, &second);
    if (tick == 60) second.SetReady(false);
    if (tick == 75) second.SetReady(true);
    if (tick == 100) Restore(split, nullptr);
    if (tick == 50 || tick == 100) whole.engine->Canonicalise();
    whole.Step();
    split.Step();
    ASSERT_EQ(whole.Space().Hash(), split.Space().Hash()) << tick;
  }
  EXPECT_EQ(whole.Saved(), split.Saved());
  EXPECT_GT(first.Works(), 0U);
  EXPECT_GT(second.Works(), 0U);
}

TEST(RegionsOfDynamics2d, FollowWhatIsDoneFromOutside)
{
  TeamOfDynamics2d team(2);
  Swarm whole("1", 0.25);
  Swarm split("1", 0.25, &team);
  for (int tick = 0; tick < 90; ++tick)
  {
    for (Swarm* swarm : {&whole, &split})
    {
      const auto move = [&](std::uint32_t robot, double x, double y)
      {
        swarm->Space().SetPose(robot, {Vector3(x, y, 0), QuaternionFromYaw(0.1 * tick)});
        swarm->engine->EntityMoved(robot);
      };
      if (tick == 20) move(swarm->Robots()[3], 6, 6);
      if (tick == 21) move(swarm->Robots()[4], 6.2, 6);
      if (tick == 40) move(swarm->Robots()[3], 2.1, 2.1);
      if (tick == 50) swarm->engine->SetVelocity(swarm->Robots()[10], {1.5, 0.5, 1});
      if (tick == 55) swarm->engine->SetVelocity(swarm->Robots()[11], {3, 0.5, 1});  // all bodies become one group
      if (tick == 70) swarm->engine->BeginAgain();
      swarm->Step();
    }
    ASSERT_EQ(whole.Space().Hash(), split.Space().Hash()) << tick;
  }
  EXPECT_EQ(whole.Saved(), split.Saved());
}

// A crowd of one group is sent in several pieces, also to a region that knows nothing.
TEST(RegionsOfDynamics2d, ALargeGroupComesInPieces)
{
  TeamOfDynamics2d team(2);
  Dynamics2dTestWorld whole, split;
  split.team = &team;
  constexpr std::uint32_t kRobots = 1600;
  for (Dynamics2dTestWorld* world : {&whole, &split})
  {
    world->experiment.arena_size = {30, 30, 3};
    for (std::uint32_t i = 0; i < kRobots; ++i) world->AddFootbot(1 + 0.21 * (i % 40), 1 + 0.21 * (i / 40), 0.7 * i);
    world->Start();
  }
  const auto step = [&](std::uint32_t tick)
  {
    for (Dynamics2dTestWorld* world : {&whole, &split})
    {
      for (std::uint32_t robot = 0; robot < kRobots; ++robot) DriveAtRandom(*world, robot, robot, tick, false);
      world->Tick();
    }
    ASSERT_EQ(whole.Space().Hash(), split.Space().Hash()) << tick;
  };
  for (std::uint32_t tick = 0; tick < 6; ++tick) step(tick);
  const unsigned before = team.Works();
  team.Replace(0);
  step(6);
  EXPECT_GT(team.Works(), before + 1);
  EXPECT_LT(team.LongestTask(), 600000U);
  step(7);
}

TEST(RegionsOfDynamics2d, AreNotAskedWhileNothingMeets)
{
  TeamOfDynamics2d team(2);
  Dynamics2dTestWorld none, one, pair, whole;
  for (Dynamics2dTestWorld* world : {&none, &one, &pair}) world->team = &team;
  one.AddFootbot(2, 2);
  none.Run(3);
  one.Run(3);
  EXPECT_EQ(team.Works(), 0U);
  for (Dynamics2dTestWorld* world : {&pair, &whole})
  {
    const auto left = world->AddFootbot(2, 2);
    const auto right = world->AddFootbot(2.5, 2, kPi);
    world->Start();
    world->Drive(left, 0.2, 0.2);
    world->Drive(right, 0.2, 0.21);
    world->Run(30);
  }
  EXPECT_EQ(whole.Space().Hash(), pair.Space().Hash());
  EXPECT_GT(team.Works(), 5U);
  EXPECT_EQ(team.BusyRegions(), 1U);
}

TEST(RegionsOfDynamics2d, RefuseTasksThatDoNotFit)
{
  dynamics2d::GroupRegion region;
  ByteWriter result, task, stream;
  stream.Put(std::uint8_t{0});
  stream.PutArray(std::vector<std::uint32_t>());
  stream.Put(std::uint32_t{5});
  stream.Put(std::uint8_t{0});
  stream.PutArray(std::vector<char>());
  task.Put(std::uint8_t{1});
  task.Put(std::uint8_t{1});
  task.PutArray(stream.Bytes());
  EXPECT_THROW(region.Work(task.Bytes(), result), std::runtime_error);
  EXPECT_THROW(region.Work(std::span(task.Bytes()).first(9), result), std::runtime_error);
}

}  // namespace
}  // namespace swarmanoid
