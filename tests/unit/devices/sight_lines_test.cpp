#include "controller_host/devices/sensing/sight_lines.h"

#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

// It tells whether a body hides the point, and by how much: the answer with the body a little smaller and a little
// larger.
struct Verdict
{
  bool surely_hidden = false;
  bool perhaps_hidden = false;
};

Verdict ByBruteForce(const SensorWorld& world, std::uint32_t observer, const Vector3& eye, const Vector3& point,
                     std::uint32_t owner)
{
  constexpr double kTolerance = 1e-5;
  const CSwarmanoidSpace& space = world.Space();
  Verdict verdict;
  for (std::uint32_t e = 0; e < space.Size(); ++e)
  {
    if (e == observer || e == owner) continue;
    const bool counts =
        owner == SightLines::kNobody || world.CanHideFrom(observer, e) || world.Membership().ShareEngine(owner, e);
    if (!counts) continue;
    Shape smaller = world.Body(e);
    Shape larger = smaller;
    smaller.half_size -= Vector3::Constant(kTolerance);
    larger.half_size += Vector3::Constant(kTolerance);
    verdict.surely_hidden |= SegmentHit(smaller, space.GetPose(e), eye, point).has_value();
    verdict.perhaps_hidden |= SegmentHit(larger, space.GetPose(e), eye, point).has_value();
  }
  return verdict;
}

TEST(EngineMembership, LightsOutsideTheEngineLeaveOneWorldOfAllBodies)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  world.AddBlock({9, 9, 0.5}, {0.2, 0.2, 1});
  world.Add(EntityKind::kLightBulb, {1, 1, 1}, 0, {0, 0, 0}, false, -1);
  EXPECT_TRUE(EngineMembership(world.Configuration()).IsOneWorld());
  world.AddBlock({1, 9, 0.5}, {0.2, 0.2, 1}, 0, -1);
  EXPECT_FALSE(EngineMembership(world.Configuration()).IsOneWorld());
}

// The buffers for bodies around are empty until a body was near.
TEST(SightLines, AnEyeThatNeverHadABodyNearSeesEverything)
{
  for (const int blocks : {0, 1})
  {
    TestWorld world;
    const std::uint32_t robot = world.AddFootbot(5, 5);
    for (int n = 0; n < blocks; ++n) world.AddBlock({9, 9, 0.5}, {0.2, 0.2, 1});
    SensorWorld sensor_world(world.Space());
    sensor_world.Refresh();
    SightLines lines(sensor_world, 1);
    for (int tick = 0; tick < 2; ++tick)
    {
      lines.LookFrom(robot, {5, 5, 0.3}, 1);
      lines.AddPoint({0.5, 0, -0.3}, SightLines::kNobody);
      const SeenPoints& seen = lines.Solve();
      EXPECT_TRUE(seen[0]) << blocks << " blocks far away, tick " << tick;
      lines.LookFrom(robot, {5, 5, 0.3}, 1);
      lines.LookAtBodiesAround();
      lines.Solve();
    }
  }
}

// Few and many bodies (below and above the number from which they are sorted), all kinds, several engines.
TEST(SightLines, AgreeWithBruteForceInRandomWorlds)
{
  int hidden = 0, seen = 0;
  for (std::uint32_t trial = 0; trial < 40; ++trial)
  {
    TestWorld world;
    world.Configuration().arena_size = {6, 6, 3};
    world.AddEngine("second");
    RandomStream random(trial, 1, 1, 1);
    const auto at = [&] { return random.Uniform(-0.5, 6.5); };
    const auto engine = [&] { return trial % 2 == 0 ? 0 : static_cast<int>(random.Below(3)) - 1; };
    const int robots = trial % 4 < 2 ? 20 : 150;
    for (int n = 0; n < robots; ++n) world.AddFootbot(at(), at(), random.Uniform(-kPi, kPi), 0, engine());
    for (int n = 0; n < 5; ++n) world.AddEyebot(at(), at(), random.Uniform(0, 2), 0, engine());
    for (int n = 0; n < 5; ++n)
      world.AddPrey(at(), at(), random.Uniform(0.05, 0.3), random.Uniform(0.05, 0.5), engine());
    for (int n = 0; n < 8; ++n)
      world.Add(EntityKind::kBlock, {at(), at(), random.Uniform(0, 0.5)}, random.Uniform(-kPi, kPi),
                {random.Uniform(0.02, 1), random.Uniform(0.02, 1), random.Uniform(0.02, 1)}, n % 2 == 0, engine());
    if (trial % 5 == 4)
      for (EntityConfiguration& entity : world.Configuration().entities)
        if (random.Uniform() < 0.4)
          entity.pose.orientation =
              QuaternionFromEuler({random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-3, 3)});

    SensorWorld sensor_world(world.Space());
    sensor_world.Refresh();
    const double reach = 3;
    SightLines lines(sensor_world, trial % 3 == 0 ? 1.0 : reach);
    for (std::uint32_t observer = 0; observer < 20; ++observer)
    {
      const Vector3 eye = world.Space().GetPose(observer).position + Vector3(0, 0, observer % 2 == 0 ? 0.1 : 0.2887);
      lines.LookFrom(observer, eye, reach);
      struct Point
      {
        Vector3 place;
        std::uint32_t owner;
      };
      std::vector<Point> points;
      for (const std::int32_t entity : lines.AroundForTest())
      {
        const auto e = static_cast<std::uint32_t>(entity);
        points.push_back({world.Space().GetPose(e).Apply({0, 0, e % 3 == 0 ? 0.1 : 0.05}), e});
      }
      for (int n = 0; n < 5; ++n)
        points.push_back({{eye.x() + random.Uniform(-2, 2), eye.y() + random.Uniform(-2, 2), random.Uniform(0, 1)},
                          SightLines::kNobody});
      points.push_back({{eye.x(), eye.y(), 0}, SightLines::kNobody});
      std::erase_if(points, [&](const Point& point) { return (point.place - eye).head<2>().norm() > reach; });
      for (const Point& point : points) lines.AddPoint(point.place - eye, point.owner);
      const auto answers = lines.Solve();
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        const Verdict verdict = ByBruteForce(sensor_world, observer, eye, points[i].place, points[i].owner);
        const bool wrong = (answers[i] && verdict.surely_hidden) || (!answers[i] && !verdict.perhaps_hidden);
        ASSERT_FALSE(wrong) << "trial " << trial << " observer " << observer << " point " << i;
        ++(answers[i] ? seen : hidden);
      }
    }
  }
  EXPECT_GT(hidden, 3000);
  EXPECT_GT(seen, 3000);
}

// The worlds have robots of one kind, few and many, on one level and not: these worlds take shorter ways.
TEST(SightLines, BodiesAroundAgreeWithBruteForce)
{
  int hidden = 0, seen = 0;
  for (std::uint32_t trial = 0; trial < 30; ++trial)
  {
    TestWorld world;
    world.Configuration().arena_size = {6, 6, 3};
    RandomStream random(trial, 2, 2, 2);
    const int robots = trial % 2 == 0 ? 30 : 200;
    for (int n = 0; n < robots; ++n)
      world.AddFootbot(random.Uniform(-1, 7), random.Uniform(-1, 7), 0, trial % 3 == 0 ? random.Uniform(0, 0.3) : 0);
    world.AddBlock({3, 3, 0.2}, {0.5, 0.3, 0.4}, 1);
    SensorWorld sensor_world(world.Space());
    sensor_world.Refresh();
    SightLines lines(sensor_world, 3);
    for (std::uint32_t observer = 0; observer < 30; ++observer)
    {
      const double height = observer % 2 == 0 ? 0.1 : 0.14;
      const Vector3 eye = world.Space().GetPose(observer).position + Vector3(0, 0, height);
      lines.LookFrom(observer, eye, 3);
      lines.LookAtBodiesAround();
      const SeenPoints& answers = lines.Solve();
      for (std::size_t i = 0; i < lines.AroundForTest().size(); ++i)
      {
        const auto owner = static_cast<std::uint32_t>(lines.AroundForTest()[i]);
        const Vector3 point = world.Space().GetPose(owner).position + Vector3(0, 0, height);
        if ((point - eye).head<2>().norm() > 3) continue;  // perhaps hidden by bodies still farther away
        const Verdict verdict = ByBruteForce(sensor_world, observer, eye, point, owner);
        const bool wrong = (answers[i] && verdict.surely_hidden) || (!answers[i] && !verdict.perhaps_hidden);
        ASSERT_FALSE(wrong) << "trial " << trial << " observer " << observer << " body " << owner;
        ++(answers[i] ? seen : hidden);
      }
    }
  }
  EXPECT_GT(hidden, 10000);
  EXPECT_GT(seen, 3000);
}

// Walls beyond all bodies are left out, by bounds that are found once a tick.
TEST(SightLines, AWallHidesABodyThatJumpsBehindIt)
{
  TestWorld world;
  const auto observer = world.AddFootbot(5, 5);
  const auto other = world.AddFootbot(4.5, 5);
  world.AddBlock({6, 5, 0.5}, {0.1, 4, 1});
  world.AddBlock({5, 6, 0.5}, {4, 0.1, 1}, 0.1);
  SensorWorld sensor_world(world.Space());
  SightLines lines(sensor_world, 3);
  const auto is_seen_at = [&](double x, double y)
  {
    world.Space().SetPose(other, {{x, y, 0}, Quaternion::Identity()});
    sensor_world.Refresh();
    lines.LookFrom(observer, {5, 5, 0.1}, 3);
    lines.LookAtBodiesAround();
    return lines.Solve()[0];
  };
  for (int round = 0; round < 2; ++round)
  {
    EXPECT_TRUE(is_seen_at(4.5, 5));
    EXPECT_FALSE(is_seen_at(7, 5));
    EXPECT_TRUE(is_seen_at(5.5, 5.5));
    EXPECT_FALSE(is_seen_at(5, 7));
  }
}

TEST(SightLines, TheBodiesAroundAreAllWithinReach)
{
  for (std::uint32_t trial = 0; trial < 20; ++trial)
  {
    TestWorld world;
    world.Configuration().arena_size = {trial % 2 == 0 ? 4.0 : 30.0, 7, 3};
    RandomStream random(trial, 4, 4, 4);
    for (int n = 0; n < 150; ++n)
    {
      world.AddFootbot(random.Uniform(-2, 9), random.Uniform(-2, 9));
      if (trial % 3 == 0 && n % 5 == 0) world.AddPrey(random.Uniform(-2, 9), random.Uniform(-2, 9), 0.3, 0.1);
    }
    SensorWorld sensor_world(world.Space());
    sensor_world.Refresh();
    SightLines lines(sensor_world, 3);
    for (std::uint32_t observer = 0; observer < 20; ++observer)
    {
      const Vector3 eye = world.Space().GetPose(observer).position;
      const double reach = 0.2 * observer;
      lines.LookFrom(observer, eye, reach);
      std::vector<std::uint32_t> found(lines.AroundForTest().begin(), lines.AroundForTest().end());
      std::sort(found.begin(), found.end());
      EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
      for (std::uint32_t e = 0; e < world.Space().Size(); ++e)
      {
        const double distance = (world.Space().GetPose(e).position - eye).head<2>().norm();
        const double beyond = distance - reach - sensor_world.Body(e).radius;
        const bool is_found = std::binary_search(found.begin(), found.end(), e);
        if (e != observer && beyond > 0 && beyond < 1e-3) continue;  // may be there or not
        EXPECT_EQ(is_found, e != observer && beyond <= 0)
            << "trial " << trial << " observer " << observer << " body " << e;
      }
    }
  }
}

TEST(SightLines, ARobotBetweenHidesALowPointAndNotAHighOne)
{
  TestWorld world;
  const auto observer = world.AddFootbot(5, 5);
  world.AddFootbot(5.3, 5);
  SensorWorld sensor_world(world.Space());
  sensor_world.Refresh();
  SightLines lines(sensor_world, 2);
  lines.LookFrom(observer, {5, 5, 0.2887}, 2);
  lines.AddPoint({0.6, 0, -0.2887}, SightLines::kNobody);  // passes the robot at 0.144 m, lower than its top of 0.147 m
  lines.AddPoint({0.6, 0, -0.05}, SightLines::kNobody);
  const auto seen = lines.Solve();
  EXPECT_FALSE(seen[0]);
  EXPECT_TRUE(seen[1]);
}

TEST(SensorWorld, FirstHitAgreesWithTryingAllBodies)
{
  for (std::uint32_t trial = 0; trial < 10; ++trial)
  {
    TestWorld world;
    world.Configuration().arena_size = {8, 5, 3};
    RandomStream random(trial, 3, 3, 3);
    const auto x = [&] { return random.Uniform(-1, 9); };
    const auto y = [&] { return random.Uniform(-1, 6); };
    for (int n = 0; n < 30; ++n) world.AddFootbot(x(), y());
    for (int n = 0; n < 20; ++n)
      world.Add(EntityKind::kBlock, {x(), y(), random.Uniform(0, 1)}, random.Uniform(-kPi, kPi),
                {random.Uniform(0.01, 1.5), random.Uniform(0.01, 0.5), random.Uniform(0.02, 1)}, n % 3 == 0);
    SensorWorld sensor_world(world.Space());
    sensor_world.Refresh();
    int hits = 0;
    for (int n = 0; n < 300; ++n)
    {
      const Vector3 from(x(), y(), random.Uniform(0, 1));
      const Vector3 to = n % 10 == 0 ? Vector3(from.x(), from.y(), 0) : Vector3(x(), y(), random.Uniform(0, 1));
      const auto accept = [&](std::uint32_t e) { return e % 5 != static_cast<std::uint32_t>(n % 5); };
      double expected = 2;
      for (std::uint32_t e = 0; e < world.Space().Size(); ++e)
        if (accept(e))
          if (const auto hit = SegmentHit(sensor_world.Body(e), world.Space().GetPose(e), from, to))
            expected = std::min(expected, *hit);
      ASSERT_EQ(sensor_world.FirstHit(from, to, accept), expected) << "trial " << trial << " segment " << n;
      hits += expected <= 1;
    }
    EXPECT_GT(hits, 30);
  }
}

}  // namespace
}  // namespace swarmanoid
