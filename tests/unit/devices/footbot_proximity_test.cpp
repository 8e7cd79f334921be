#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "controller_host/devices/sensing/body_shapes.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

constexpr double kBody = 0.085036758;
constexpr double kSensorHeight = 0.06;
constexpr unsigned kSensors = CCI_FootBotProximitySensor::NUM_SENSORS;

double Hyperbola(double d) { return d > 0.1 ? 0 : d < 0.009889556 ? 1 : 0.0100527 / (d + 0.000163144); }

std::span<const double, kSensors> ReadingsOf(TestSensor& sensor, std::size_t k)
{
  return sensor.Of<CCI_FootBotProximitySensor>(k).GetAllSensorReadings();
}

bool ShareEngine(const Experiment& experiment, std::uint32_t a, std::uint32_t b)
{
  for (const EngineConfiguration& engine : experiment.engines)
  {
    const auto has = [&](std::uint32_t e)
    { return std::find(engine.entities.begin(), engine.entities.end(), e) != engine.entities.end(); };
    if (has(a) && has(b)) return true;
  }
  return false;
}

// Every ray against every body, by stepping outwards along the ray until a point is inside, then halving: knows nothing
// of the formulas and grids under test.
double NearestByMarching(const CSwarmanoidSpace& space, std::uint32_t robot, unsigned i)
{
  const double angle = (7.5 + 15.0 * i) * kPi / 180;
  const Vector3 u(std::cos(angle), std::sin(angle), 0);
  const Pose pose = space.GetPose(robot);
  double nearest = 1;
  for (std::uint32_t e = 0; e < space.Size(); ++e)
  {
    if (e == robot || !ShareEngine(space.GetExperiment(), robot, e)) continue;
    const BodyShape shape = BodyShapeOf(space.GetExperiment().entities[e]);
    if (shape.kind == Shape::Kind::kNone) continue;
    const Pose to_body = space.GetPose(e).Inverse();
    const auto inside = [&](double d)
    {
      const Vector3 p = to_body.Apply(pose.Apply((kBody + d) * u + Vector3(0, 0, kSensorHeight)));
      if (p.z() < shape.low || p.z() > shape.high) return false;
      if (shape.kind == Shape::Kind::kBox)
        return std::abs(p.x()) <= shape.half_size.x() && std::abs(p.y()) <= shape.half_size.y();
      return p.x() * p.x() + p.y() * p.y() <= shape.radius * shape.radius;
    };
    constexpr double kStep = 2e-4;
    for (double d = 0; d <= 0.1 + kStep; d += kStep)
    {
      if (!inside(d)) continue;
      double low = d == 0 ? 0 : d - kStep, high = d;
      for (int k = 0; k < 40; ++k) (inside((low + high) / 2) ? high : low) = (low + high) / 2;
      nearest = std::min(nearest, high);
      break;
    }
  }
  return nearest;
}

TEST(FootbotProximity, SeesAWallAheadAtTheDistanceOfEachRay)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  world.AddBlock({5 + kBody + 0.05 + 0.1, 5, 0.25}, {0.2, 4, 0.5});
  TestSensor sensor(world, "footbot_proximity", "generic_footbot_proximity", {0});
  sensor.Update();
  const auto readings = ReadingsOf(sensor, 0);
  for (const unsigned i : {0U, 23U})  // 7.5 degrees off the front
    EXPECT_NEAR(readings[i], Hyperbola((kBody + 0.05) / std::cos(7.5 * kPi / 180) - kBody), 1e-12);
  EXPECT_NEAR(readings[2], Hyperbola((kBody + 0.05) / std::cos(37.5 * kPi / 180) - kBody), 1e-12);
  for (unsigned i = 6; i < 18; ++i) EXPECT_EQ(readings[i], 0);
}

// If the ends of a wall are out of reach, only its side is tested. If an end is just within reach, the whole wall is.
TEST(FootbotProximity, ALongWallReadsBitForBitAsABoxThatEndsWhereTheRaysDo)
{
  constexpr double kReach = kBody + 0.1;
  RandomStream random(3, 1, 2, 3);
  int seen = 0;
  for (int trial = 0; trial < 400; ++trial)
  {
    const double own_yaw = random.Uniform(-kPi, kPi);
    const double wall_yaw = trial % 4 == 0 ? kPi / 2 * (trial / 4 % 4) : random.Uniform(-kPi, kPi);
    const double thickness = random.Uniform(0.01, 0.3);
    const double gap = random.Uniform(-0.01, kReach);
    const double away = gap + thickness / 2;
    const Vector3 at(5 + away * std::cos(wall_yaw), 5 + away * std::sin(wall_yaw), 0.25);
    std::array<std::array<double, kSensors>, 2> readings;
    for (int k = 0; k < 2; ++k)
    {
      TestWorld world;
      world.AddFootbot(5, 5, own_yaw);
      const double length = k == 0 ? 2 * kReach * (1 - 1e-9) : 3;
      if (trial % 2 == 0)
        world.AddBlock(at, {thickness, length, 0.5}, wall_yaw);
      else
        world.AddBlock(at, {length, thickness, 0.5}, wall_yaw + kPi / 2);
      TestSensor sensor(world, "footbot_proximity", "generic_footbot_proximity", {0});
      sensor.Update();
      std::ranges::copy(ReadingsOf(sensor, 0), readings[static_cast<std::size_t>(k)].begin());
    }
    EXPECT_EQ(readings[0], readings[1]) << trial;
    seen += readings[1] != std::array<double, kSensors>{} ? 1 : 0;
  }
  EXPECT_GT(seen, 300);
}

TEST(FootbotProximity, TouchingRobotReadsOneOnTheSideOfTheContact)
{
  TestWorld world;
  world.AddFootbot(5, 5, kPi / 2 - 7.5 * kPi / 180);  // its first ray points north
  world.AddFootbot(5, 5 + 2 * kBody);
  TestSensor sensor(world, "footbot_proximity", "generic_footbot_proximity", {0, 1});
  sensor.Update();
  EXPECT_EQ(ReadingsOf(sensor, 0)[0], 1);
  EXPECT_GT(ReadingsOf(sensor, 0)[1], 0);
  EXPECT_EQ(ReadingsOf(sensor, 0)[3], 0);
  EXPECT_EQ(ReadingsOf(sensor, 0)[12], 0);
}

TEST(FootbotProximity, BodiesAboveAndBelowTheSensorAreNotSeen)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  world.AddBlock({5.15, 5, 0.025}, {0.05, 1, 0.05});  // lower than the sensor
  world.AddBlock({4.85, 5, 0.6}, {0.05, 1, 1});       // hangs above it
  world.AddBlock({5, 5.15, 0.035}, {1, 0.05, 0.07});  // reaches the sensor
  TestSensor sensor(world, "footbot_proximity", "generic_footbot_proximity", {0});
  sensor.Update();
  const auto readings = ReadingsOf(sensor, 0);
  EXPECT_EQ(readings[0], 0);
  EXPECT_EQ(readings[12], 0);
  EXPECT_GT(readings[6], 0);
}

TEST(FootbotProximity, ClosedWorldsDoNotSeeEachOther)
{
  TestWorld world;
  world.AddEngine("other");
  world.AddFootbot(5, 5);
  world.AddFootbot(5.2, 5, 0, 0, 1);
  const auto shared = world.AddFootbot(4.8, 5, 0, 0, 1);
  world.Configuration().engines[0].entities.push_back(shared);
  world.AddFootbot(5, 5.2, 0, 0, -1);  // in no engine
  TestSensor sensor(world, "footbot_proximity", "generic_footbot_proximity", {0, 1, 2, 3});
  sensor.Update();
  EXPECT_EQ(ReadingsOf(sensor, 0)[0], 0);
  EXPECT_GT(ReadingsOf(sensor, 0)[12], 0);
  EXPECT_EQ(ReadingsOf(sensor, 0)[6], 0);
  EXPECT_GT(ReadingsOf(sensor, 2)[0], 0);
  for (const double reading : ReadingsOf(sensor, 3)) EXPECT_EQ(reading, 0);
}

// Random crowds of robots, preys, turned blocks and tilted bodies, some outside the arena, against the marching
// reference.
TEST(FootbotProximity, AgreesWithBruteForceInRandomWorlds)
{
  for (std::uint32_t trial = 0; trial < 12; ++trial)
  {
    TestWorld world;
    world.Configuration().arena_size = {2.5, 1.5, 1};
    world.AddEngine("second");
    RandomStream random(trial, 1, 2, 3);
    const auto x = [&] { return random.Uniform(-0.2, 2.7); };
    const auto y = [&] { return random.Uniform(-0.2, 1.7); };
    const auto yaw = [&] { return random.Uniform(-kPi, kPi); };
    for (int n = 0; n < 30; ++n)
      world.AddFootbot(x(), y(), yaw(), n % 5 == 0 ? random.Uniform(-0.1, 0.1) : 0, n % 7 == 0);
    for (int n = 0; n < 4; ++n) world.AddPrey(x(), y(), random.Uniform(0.02, 0.2), random.Uniform(0.03, 0.2));
    world.AddEyebot(x(), y(), random.Uniform(0, 0.1));
    for (int n = 0; n < 6; ++n)
    {
      const Vector3 size(random.Uniform(0.01, 0.6), random.Uniform(0.01, 0.6), random.Uniform(0.05, 0.4));
      world.Add(EntityKind::kBlock, {x(), y(), random.Uniform(0, 0.2)}, yaw(), size, n % 2 == 0, 0);
    }
    // Every fourth trial: tilted robots and blocks.
    if (trial % 4 == 3)
      for (EntityConfiguration& entity : world.Configuration().entities)
        if (random.Uniform() < 0.5)
          entity.pose.orientation = QuaternionFromEuler({random.Uniform(-1, 1), random.Uniform(-1, 1), yaw()});
    const auto robots = world.RobotsOf(EntityKind::kFootbot);
    TestSensor sensor(world, "footbot_proximity", "generic_footbot_proximity", robots);
    sensor.Update();
    int hits = 0;
    for (std::size_t k = 0; k < robots.size(); ++k)
      for (unsigned i = 0; i < kSensors; ++i)
      {
        const double expected = Hyperbola(NearestByMarching(world.Space(), robots[k], i));
        const double reading = ReadingsOf(sensor, k)[i];
        hits += reading > 0;
        // The reference may step over the tip of a corner; nothing else may differ.
        if (expected == 0 && reading > 0 && reading < 1) continue;
        ASSERT_NEAR(reading, expected, 2e-3) << "trial " << trial << " robot " << k << " ray " << i;
      }
    EXPECT_GT(hits, 100);
  }
}

TEST(FootbotProximity, ReadingsDoNotDependOnWhoIsInTheBatch)
{
  TestWorld world;
  RandomStream random(5, 0, 0, 0);
  for (int n = 0; n < 40; ++n) world.AddFootbot(random.Uniform(0, 2), random.Uniform(0, 2), random.Uniform(-3, 3));
  const TestParameters noise{{"noise_kind", "uniform"}, {"noise_range", "0.05"}};
  TestSensor all(world, "footbot_proximity", "generic_footbot_proximity", world.RobotsOf(EntityKind::kFootbot), noise);
  TestSensor some(world, "footbot_proximity", "generic_footbot_proximity", {3, 17, 39}, noise);
  for (std::uint64_t tick = 1; tick < 5; ++tick)
  {
    world.Space().SetTick(tick);
    all.Update();
    some.Update();
    std::size_t k = 0;
    for (const std::size_t robot : {3, 17, 39})
    {
      const auto expected = ReadingsOf(all, robot);
      const auto readings = ReadingsOf(some, k++);
      EXPECT_TRUE(std::equal(expected.begin(), expected.end(), readings.begin()));
    }
  }
}

TEST(FootbotProximity, FollowsTheRobotsAndForgetsWhatIsGone)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  world.AddFootbot(5.2, 5);
  TestSensor sensor(world, "footbot_proximity", "generic_footbot_proximity", {0, 1});
  sensor.Update();
  EXPECT_GT(ReadingsOf(sensor, 0)[0], 0);
  world.Space().SetPose(1, {{8, 8, 0}, Quaternion::Identity()});
  sensor.Update();  // the same tick: a space that was set back
  for (const double reading : ReadingsOf(sensor, 0)) EXPECT_EQ(reading, 0);
}

// Neighbours are searched from time to time and kept; a new sensor searches by itself.
TEST(FootbotProximity, WhoIsRememberedIsWhoIsNear)
{
  for (const double step : {0.002, 0.005, 0.02, 0.1})
  {
    TestWorld world;
    RandomStream random(11, 0, 0, 0);
    std::vector<std::uint32_t> robots;
    for (std::uint32_t n = 0; n < 60; ++n)
    {
      world.AddFootbot(random.Uniform(0.3, 2.7), random.Uniform(0.3, 2.7), random.Uniform(-3, 3));
      robots.push_back(n);
    }
    world.AddBlock({3, 1.5, 0.25}, {0.2, 3, 0.5});
    for (std::uint32_t n = 0; n < 6; ++n)
      world.AddBlock({random.Uniform(0.3, 2.7), random.Uniform(0.3, 2.7), 0.25}, {0.5, 0.05, 0.5},
                     random.Uniform(-3, 3));
    for (std::uint32_t n = 0; n < 8; ++n)
      world.AddPrey(random.Uniform(0.3, 2.7), random.Uniform(0.3, 2.7), random.Uniform(0.02, 0.2), 0.1);
    TestSensor sensor(world, "footbot_proximity", "generic_footbot_proximity", robots);
    int seen = 0;
    for (std::uint64_t tick = 1; tick < 80; ++tick)
    {
      world.Space().SetTick(tick);
      for (const std::uint32_t k : world.Space().Movable())
      {
        Pose pose = world.Space().GetPose(k);
        pose.position += Vector3(random.Uniform(-step, step), random.Uniform(-step, step), 0);
        world.Space().SetPose(k, pose);
      }
      // One robot is put elsewhere. Another one falls over, lies for some ticks and gets up.
      if (tick % 17 == 0) world.Space().SetPose(5, {{2.8, random.Uniform(0.3, 2.7), 0}, Quaternion::Identity()});
      if (tick == 30) world.Space().SetPose(7, {{1, 1, 0}, Quaternion(Eigen::AngleAxisd(0.3, Vector3::UnitX()))});
      if (tick == 40) world.Space().SetPose(7, {{1, 1, 0}, Quaternion::Identity()});
      sensor.Update();
      TestSensor fresh(world, "footbot_proximity", "generic_footbot_proximity", robots);
      fresh.Update();
      for (const std::uint32_t k : robots)
      {
        const auto expected = ReadingsOf(fresh, k);
        const auto readings = ReadingsOf(sensor, k);
        ASSERT_TRUE(std::equal(expected.begin(), expected.end(), readings.begin()))
            << "steps of " << step << " m, tick " << tick << ", robot " << k;
        for (const double reading : expected) seen += reading > 0;
      }
    }
    EXPECT_GT(seen, 1000);
  }
}

// Readings are stored side by side in the order of their computation, for all robots.
TEST(FootbotProximity, OfManyThatSeeEachHasItsOwn)
{
  TestWorld world;
  constexpr std::uint32_t kPairs = 400;
  std::vector<std::uint32_t> robots;
  for (std::uint32_t n = 0; n < kPairs; ++n)
  {
    // The robots begin at the far end, so the order of places is not that of numbers. The gaps get smaller.
    const double x = 9.5 - 0.45 * (n % 20);
    const double y = 9.5 - 0.45 * (n / 20);
    const double gap = 0.175 + 0.09 * n / kPairs;
    world.AddFootbot(x - gap / 2, y);
    world.AddFootbot(x + gap / 2, y, kPi);
    robots.insert(robots.end(), {2 * n, 2 * n + 1});
  }
  TestSensor sensor(world, "footbot_proximity", "generic_footbot_proximity", robots);
  for (int turn = 0; turn < 3; ++turn)
  {
    sensor.Update();
    for (std::uint32_t n = 0; n < kPairs; ++n)
    {
      TestSensor alone(world, "footbot_proximity", "generic_footbot_proximity", {2 * n});
      alone.Update();
      const auto expected = ReadingsOf(alone, 0);
      const auto readings = ReadingsOf(sensor, 2 * n);
      ASSERT_TRUE(std::equal(expected.begin(), expected.end(), readings.begin())) << n;
      ASSERT_EQ(expected[0] > 0, turn == 0 || n % 2 == 1) << n;
    }
    // Every other pair parts.
    for (std::uint32_t n = 0; n < kPairs; n += 2)
      world.Space().SetPose(2 * n + 1, {{0.2, 0.2, 50.0 + n}, Quaternion::Identity()});
  }
}

TEST(FootbotProximity, UniformNoiseStaysWithinItsRangeAndTheReadings)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  world.AddBlock({5 + kBody + 0.05 + 0.1, 5, 0.25}, {0.2, 4, 0.5});
  TestSensor plain(world, "footbot_proximity", "generic_footbot_proximity", {0});
  TestSensor noisy(world, "footbot_proximity", "generic_footbot_proximity", {0},
                   {{"noise_kind", "uniform"}, {"noise_range", "0.1"}});
  plain.Update();
  double sum = 0, squares = 0;
  for (std::uint64_t tick = 0; tick < 2000; ++tick)
  {
    world.Space().SetTick(tick);
    noisy.Update();
    for (unsigned i = 0; i < kSensors; ++i)
    {
      ASSERT_GE(ReadingsOf(noisy, 0)[i], 0);
      ASSERT_LE(ReadingsOf(noisy, 0)[i], 1);
      ASSERT_NEAR(ReadingsOf(noisy, 0)[i], ReadingsOf(plain, 0)[i], 0.1);
    }
    const double error = ReadingsOf(noisy, 0)[0] - ReadingsOf(plain, 0)[0];
    sum += error;
    squares += error * error;
  }
  EXPECT_NEAR(sum / 2000, 0, 0.006);              // four standard errors
  EXPECT_NEAR(squares / 2000, 0.01 / 3, 0.0003);  // variance of U(-0.1, 0.1)
}

TEST(FootbotProximity, PolynomialFollowsTheMeasuredCurveUnlessToldOtherwise)
{
  TestWorld world;
  RandomStream random(5, 0, 0, 0);
  for (int n = 0; n < 40; ++n) world.AddFootbot(random.Uniform(0, 2), random.Uniform(0, 2), random.Uniform(-3, 3));
  const auto robots = world.RobotsOf(EntityKind::kFootbot);
  TestSensor rays(world, "footbot_proximity", "generic_footbot_proximity", robots);
  TestSensor polynomial(world, "footbot_proximity", "generic_footbot_polynomial_proximity", robots);
  TestSensor linear(world, "footbot_proximity", "generic_footbot_polynomial_proximity", robots,
                    {{"coefficients", "1, -10"}});
  rays.Update();
  polynomial.Update();
  linear.Update();
  for (std::size_t k = 0; k < robots.size(); ++k)
    for (unsigned i = 0; i < kSensors; ++i)
    {
      const double expected = ReadingsOf(rays, k)[i];
      ASSERT_NEAR(ReadingsOf(polynomial, k)[i], expected, 0.0037);
      if (expected == 0 || expected == 1) continue;
      const double distance = 0.0100527 / expected - 0.000163144;
      ASSERT_NEAR(ReadingsOf(linear, k)[i], 1 - 10 * distance, 1e-9);
    }
}

TEST(FootbotProximity, CoefficientsThatAreNoNumbersAreRefused)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  EXPECT_THROW(
      TestSensor(world, "footbot_proximity", "generic_footbot_polynomial_proximity", {0}, {{"coefficients", "1, two"}}),
      ConfigurationError);
}

}  // namespace
}  // namespace swarmanoid
