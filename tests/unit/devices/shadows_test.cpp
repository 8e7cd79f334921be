#include "controller_host/devices/sensing/shadows.h"

#include "common/control_interface/footbot/ci_footbot_light_sensor.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

bool IsHiddenByBruteForce(const SensorWorld& world, std::uint32_t robot, const Vector3& point, const Vector3& source)
{
  for (std::uint32_t e = 0; e < world.Space().Size(); ++e)
    if (e != robot && world.CanHideFrom(robot, e) && world.HitOn(e, point, source)) return true;
  return false;
}

TEST(Sectors, WrapAtBothEnds)
{
  const Sectors sectors(64);
  EXPECT_EQ(sectors.Wrapped(64), 0U);
  EXPECT_EQ(sectors.Wrapped(-1), 63U);
  for (int sector = 0; sector < 64; ++sector) EXPECT_EQ(sectors.Wrapped(sector), static_cast<std::size_t>(sector));
}

void AddWalls(TestWorld& world, RandomStream& random, double side, int count)
{
  for (int n = 0; n < count; ++n)
    world.Add(EntityKind::kBlock, {random.Uniform(0, side), random.Uniform(0, side), random.Uniform(0, 0.5)},
              random.Uniform(-kPi, kPi), {random.Uniform(0.02, 3), random.Uniform(0.02, 1), random.Uniform(0.02, 1)},
              false, n % 3 == 0 ? -1 : 0);
}

// Alike and mixed bodies, tilted ones, several engines, sources above, among and within them, near and far.
TEST(MovingShadows, AgreesWithBruteForceInRandomWorlds)
{
  int hidden = 0, seen = 0;
  for (std::uint32_t trial = 0; trial < 60; ++trial)
  {
    TestWorld world;
    RandomStream random(trial, 1, 1, 1);
    const double side = trial % 5 == 0 ? 40 : 8;
    const double origin = trial % 7 == 0 ? 900 : 0;
    world.Configuration().arena_size = {origin + side, origin + side, 5};
    world.AddEngine("second");
    const bool is_mixed = trial % 2 == 1;
    const auto at = [&] { return origin + random.Uniform(-0.5, side + 0.5); };
    const auto engine = [&] { return trial % 4 == 3 ? static_cast<int>(random.Below(3)) - 1 : 0; };
    const int robots = trial % 3 == 0 ? 20 : 300;
    for (int n = 0; n < robots; ++n)
      world.AddFootbot(at(), at(), random.Uniform(-kPi, kPi), is_mixed ? random.Uniform(0, 1) : 0, engine());
    if (is_mixed)
    {
      for (int n = 0; n < 10; ++n) world.AddEyebot(at(), at(), random.Uniform(0, 2), 0, engine());
      for (int n = 0; n < 10; ++n)
        world.Add(EntityKind::kHandbot, {at(), at(), 0}, random.Uniform(-kPi, kPi), {0.22, 0.17, 0.16}, true, engine());
    }
    if (origin == 0) AddWalls(world, random, side, trial % 3 * 6);
    if (trial % 8 == 7)
      for (EntityConfiguration& entity : world.Configuration().entities)
        if (random.Uniform() < 0.4)
          entity.pose.orientation =
              QuaternionFromEuler({random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-3, 3)});

    SensorWorld sensor_world(world.Space());
    sensor_world.Refresh();
    const CSwarmanoidSpace& space = world.Space();
    SightedPoints points;
    points.Reserve(static_cast<std::size_t>(robots));
    for (std::uint32_t robot = 0; robot < static_cast<std::uint32_t>(robots); ++robot)
    {
      const Vector3 point = space.GetPose(robot).Apply({0, 0, trial % 9 == 8 ? 0.0 : 0.06});
      points.x[points.count] = point.x();
      points.y[points.count] = point.y();
      points.z[points.count] = point.z();
      points.robot[points.count++] = robot;
    }
    MovingShadows shadows(sensor_world);
    FixedShadows fixed;
    for (int n = 0; n < 6; ++n)
    {
      const double heights[] = {0.06, 0.1, 0.146899733, 1, 0, 3};
      Vector3 source(at(), at(), heights[n]);
      if (n % 3 == 2) source = space.GetPose(static_cast<std::uint32_t>(n)).position + Vector3(0.01, 0, heights[n]);
      const double reach = n == 1 ? 3 : 1000;
      fixed.Place(sensor_world, source);
      shadows.Sort(source, reach);
      std::vector<std::uint32_t> found;
      shadows.Look(points, fixed, found);
      std::size_t next = 0;
      for (std::uint32_t i = 0; i < points.count; ++i)
      {
        const Vector3 point(points.x[i], points.y[i], points.z[i]);
        const bool is_seen = next < found.size() && found[next] == i;
        if (is_seen) ++next;
        if ((point - source).head<2>().norm() > reach) continue;
        ASSERT_EQ(is_seen, !IsHiddenByBruteForce(sensor_world, i, point, source))
            << "trial " << trial << " source " << n << " robot " << i;
        ++(is_seen ? seen : hidden);
      }
      ASSERT_EQ(next, found.size());
    }
  }
  EXPECT_GT(hidden, 10000);
  EXPECT_GT(seen, 10000);
}

// Readings of footbots by the documented formula, bulb by bulb: what is left out is at most 1e-4 a bulb.
TEST(LightSensor, ReadingsAreThoseOfTheFormula)
{
  const struct
  {
    const char* implementation;
    double (*brightness)(double intensity, double distance);
    double height;
  } models[] = {{"generic_footbot_light", [](double i, double d) { return (i / d) * (i / d); }, 0.06},
                {"argos3_footbot_light", [](double i, double d) { return d > 2.5 * i ? 0 : std::exp(-2 * d / i); }, 0}};
  constexpr int kBulbs = 8;
  int left_out = 0;
  for (const auto& model : models)
  {
    TestWorld world;
    RandomStream random(5, 1, 1, 1);
    world.Configuration().arena_size = {20, 20, 5};
    for (int n = 0; n < 200; ++n)
      world.AddFootbot(random.Uniform(0, 20), random.Uniform(0, 20), random.Uniform(-kPi, kPi));
    AddWalls(world, random, 20, 10);
    std::vector<std::uint32_t> bulbs;
    for (int n = 0; n < kBulbs; ++n)
      bulbs.push_back(world.Add(EntityKind::kLightBulb,
                                {random.Uniform(0, 20), random.Uniform(0, 20), random.Uniform(0.05, 3)}, 0, {0, 0, 0},
                                false, -1));
    CSwarmanoidSpace& space = world.Space();
    // One of them as strong as most robots do not notice.
    for (int n = 0; n < kBulbs; ++n)
      space.GetEntity(bulbs[static_cast<std::size_t>(n)]).SetAttribute("intensity", n == 0 ? 0.02 : 0.5 * n);
    TestBatch<SensorBatch> sensor(world, "footbot_light", model.implementation, world.RobotsOf(EntityKind::kFootbot));
    SensorWorld bodies(space);
    for (int tick = 0; tick < 3; ++tick)
    {
      for (std::uint32_t robot = 0; robot < 200; ++robot)
      {
        // Some lean, but not in the first tick.
        const double lean = tick > 0 && robot % 3 == 0 ? random.Uniform(-0.5, 0.5) : 0;
        space.SetPose(robot, {{random.Uniform(0, 20), random.Uniform(0, 20), 0},
                              QuaternionFromEuler({lean, -lean / 2, random.Uniform(-3, 3)})});
      }
      bodies.Refresh();
      sensor.batch->Update({});
      for (std::uint32_t robot = 0; robot < 200; ++robot)
      {
        const auto readings =
            dynamic_cast<CCI_FootBotLightSensor&>(*sensor.batch->Sensor(robot)).GetAllSensorReadings();
        const Pose pose = space.GetPose(robot);
        const Vector3 eye = pose.Apply({0, 0, model.height});
        for (unsigned s = 0; s < 24; ++s)
        {
          double expected = 0;
          for (const std::uint32_t bulb : bulbs)
          {
            const Vector3 source = space.GetPose(bulb).position;
            const double intensity = space.Attributes()[space.GetEntity(bulb).SlotOf("intensity")];
            if (IsHiddenByBruteForce(bodies, robot, eye, source)) continue;
            const Vector3 place = pose.Inverse().Apply(source) - Vector3(0, 0, model.height);
            const double angle = std::atan2(place.y(), place.x()) - CCI_FootBotLightSensor::AngleOf(s);
            const double off = std::abs(std::remainder(angle, 2 * kPi));
            const double brightness = model.brightness(intensity, place.norm());
            left_out += brightness > 0 && brightness < 1e-4 ? 1 : 0;
            expected += brightness * std::max(0.0, 1 - off / (kPi / 2));
          }
          const double least = std::min(1.0, expected - 1e-4 * kBulbs);
          ASSERT_GE(readings[s], least - 1e-9);
          ASSERT_LE(readings[s], std::min(1.0, expected) + 1e-9);
        }
      }
    }
  }
  EXPECT_GT(left_out, 100);
}

// Every bit, at the directions where sensors begin and cease to see a bulb and where angles wrap, and next to them.
TEST(LightSensor, EachSensorIsLitByItsAngleToTheBulb)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  const auto bulb = world.Add(EntityKind::kLightBulb, {6, 5, 1}, 0, {0, 0, 0}, false, -1);
  CSwarmanoidSpace& space = world.Space();
  TestSensor sensor(world, "footbot_light", "generic_footbot_light", {0});
  const double intensity = space.Attributes()[space.GetEntity(bulb).SlotOf("intensity")];
  RandomStream random(8, 1, 1, 1);
  for (int n = -96; n < 3000; ++n)
  {
    const double direction = n <= 96 ? n * kPi / 96 : random.Uniform(-kPi, kPi);
    for (int near = -3; near <= 3; ++near)
    {
      const SinCos way = SinCosOf(direction);
      const Vector3 source(5 + 40 * way.cos, 5 + 40 * way.sin + near * 1e-14, 1);
      space.SetPose(bulb, {source, Quaternion::Identity()});
      sensor.Update();
      const auto readings = sensor.Of<CCI_FootBotLightSensor>(0).GetAllSensorReadings();
      const Vector3 to_bulb = source - Vector3(5, 5, CCI_FootBotLightSensor::RING_HEIGHT_M);
      const double bearing = Atan2(to_bulb.y(), to_bulb.x());
      const double brightness = intensity * intensity / to_bulb.squaredNorm();
      for (unsigned s = 0; s < readings.size(); ++s)
      {
        const double off = std::abs(WrapAngle(CCI_FootBotLightSensor::AngleOf(s) - bearing));
        ASSERT_EQ(readings[s], brightness * std::max(1 - off / (kPi / 2), 0.0))
            << "sensor " << s << " of " << direction;
      }
    }
  }
}

}  // namespace
}  // namespace swarmanoid
