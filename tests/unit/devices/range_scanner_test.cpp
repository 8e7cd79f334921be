// Range scanners against closed forms, and against rays that meet each body one by one.
#include "common/control_interface/ci_range_scanner_sensor.h"

#include <cmath>
#include <random>

#include "common/space/shape.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

constexpr double kNoEcho = std::numeric_limits<double>::infinity();

const CCI_RangeScannerSensor& ScanOf(TestSensor& scanner) { return scanner.Of<CCI_RangeScannerSensor>(0); }

TEST(RangeScanner, SeesNothingInAnEmptyArena)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  TestSensor scanner(world, "range_scanner", "generic_range_scanner", {robot}, {{"beams", "7"}});
  scanner.Update();
  EXPECT_EQ(ScanOf(scanner).GetAllDistances().size(), 7U);
  for (const double distance : ScanOf(scanner).GetAllDistances()) EXPECT_EQ(distance, kNoEcho);
}

TEST(RangeScanner, IsABatchWithoutRobots)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  TestSensor scanner(world, "range_scanner", "generic_range_scanner", {});
  EXPECT_NO_THROW(scanner.Update());
}

TEST(RangeScanner, HasItsBeamsFromRightToLeftAndItsLayersFromTheLowestUp)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  TestSensor half(
      world, "range_scanner", "generic_range_scanner", {robot},
      {{"beams", "5"}, {"field_of_view", "180"}, {"layers", "3"}, {"vertical_field_of_view", "40"}, {"pan", "10"}});
  for (unsigned beam = 0; beam < 5; ++beam)
    EXPECT_NEAR(ScanOf(half).GetAngle(beam), DegreesToRadians(-90 + 45.0 * beam + 10), 1e-12);
  for (unsigned layer = 0; layer < 3; ++layer)
    EXPECT_NEAR(ScanOf(half).GetElevation(layer), DegreesToRadians(-20 + 20.0 * layer), 1e-12);
  EXPECT_THROW((void)ScanOf(half).GetDistance(5), std::out_of_range);
  EXPECT_THROW((void)ScanOf(half).GetDistance(0, 3), std::out_of_range);
  // All around the last beam is one step before the first.
  TestSensor whole(world, "range_scanner", "generic_range_scanner", {robot}, {{"beams", "4"}});
  for (unsigned beam = 0; beam < 4; ++beam) EXPECT_NEAR(ScanOf(whole).GetAngle(beam), kPi / 2 * beam - kPi, 1e-12);
  TestSensor one(world, "range_scanner", "generic_range_scanner", {robot}, {{"beams", "1"}});
  EXPECT_EQ(ScanOf(one).GetAngle(0), 0);
}

TEST(RangeScanner, MeasuresAWallAlongEachBeam)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5, kPi / 2);
  world.AddBlock({5, 7.1, 1}, {8, 0.2, 2});  // its face is 1.9 m ahead of the scanner
  TestSensor scanner(world, "range_scanner", "generic_range_scanner", {robot},
                     {{"position", "0.1, 0, 0.2"}, {"beams", "91"}, {"field_of_view", "90"}});
  scanner.Update();
  for (unsigned beam = 0; beam < 91; ++beam)
    EXPECT_NEAR(ScanOf(scanner).GetDistance(beam), 1.9 / std::cos(DegreesToRadians(beam - 45.0)), 1e-9) << beam;
}

TEST(RangeScanner, MeasuresACylinderAlongEachBeam)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  world.AddPrey(3, 5, 0.5, 1);  // behind the robot, where a full turn begins and ends
  TestSensor scanner(world, "range_scanner", "generic_range_scanner", {robot}, {{"beams", "360"}});
  scanner.Update();
  for (unsigned beam = 0; beam < 360; ++beam)
  {
    const double aside = 2 * std::sin(DegreesToRadians(beam));
    const double along = 2 * std::cos(DegreesToRadians(beam));
    if (along > 0 && std::abs(aside) < 0.5)
      EXPECT_NEAR(ScanOf(scanner).GetDistance(beam), along - std::sqrt(0.25 - aside * aside), 1e-9) << beam;
    else
      EXPECT_EQ(ScanOf(scanner).GetDistance(beam), kNoEcho) << beam;
  }
}

TEST(RangeScanner, LayersMeetTheFloorAndPassOverLowBodies)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  world.AddPrey(7, 5, 0.2, 0.3);
  TestSensor scanner(world, "range_scanner", "generic_range_scanner", {robot},
                     {{"position", "0, 0, 0.4"}, {"beams", "1"}, {"layers", "3"}, {"vertical_field_of_view", "20"}});
  scanner.Update();
  const double down = DegreesToRadians(10);
  // The lowest layer meets the prey: at its front it is 0.4 - 1.8 tan(10 deg) = 0.083 m high.
  EXPECT_NEAR(ScanOf(scanner).GetDistance(0, 0), 1.8 / std::cos(down), 1e-9);
  EXPECT_EQ(ScanOf(scanner).GetDistance(0, 1), kNoEcho);
  EXPECT_EQ(ScanOf(scanner).GetDistance(0, 2), kNoEcho);
  // Without it the floor.
  world.Space().SetPose(1, {{5, 8, 0}, Quaternion::Identity()});
  world.Space().SetTick(1);
  scanner.Update();
  EXPECT_NEAR(ScanOf(scanner).GetDistance(0, 0), 0.4 / std::sin(down), 1e-9);
}

TEST(RangeScanner, ReadsZeroWhereSomethingIsTooNearAndSeesThroughOtherEngines)
{
  TestWorld world;
  const int other = static_cast<int>(world.AddEngine("other"));
  const auto robot = world.AddFootbot(5, 5);
  world.AddBlock({5.4, 5, 0.5}, {0.2, 1, 1});
  world.AddPrey(4, 5, 0.2, 1, other);
  TestSensor scanner(world, "range_scanner", "generic_range_scanner", {robot}, {{"beams", "4"}, {"nearest", "0.35"}});
  scanner.Update();
  EXPECT_EQ(ScanOf(scanner).GetDistance(2), 0);        // ahead, at 0.3 m
  EXPECT_EQ(ScanOf(scanner).GetDistance(0), kNoEcho);  // behind, a body of another engine
}

TEST(RangeScanner, DisturbsWhatItMeasuresAlone)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  world.AddBlock({7.1, 5, 1}, {0.2, 1, 2});
  TestSensor scanner(world, "range_scanner", "generic_range_scanner", {robot},
                     {{"beams", "360"}, {"noise_kind", "gaussian"}, {"noise_deviation", "0.02"}});
  double sum = 0, squares = 0;
  int count = 0;
  for (std::uint64_t tick = 0; tick < 400; ++tick)
  {
    world.Space().SetTick(tick);
    scanner.Update();
    EXPECT_EQ(ScanOf(scanner).GetDistance(90), kNoEcho);
    const double error = ScanOf(scanner).GetDistance(180) - 2;
    sum += error;
    squares += error * error;
    ++count;
  }
  EXPECT_NEAR(sum / count, 0, 4 * 0.02 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count), 0.02, 4 * 0.02 / std::sqrt(2 * count));
}

// Bodies and scanners at random places and turns, some tilted, against SegmentHit of each body and the floor.
TEST(RangeScanner, AgreesWithRaysThroughRandomScenes)
{
  std::mt19937 random(12);
  std::uniform_real_distribution<double> unit(0, 1);
  int bodies = 0, floors = 0, nothing = 0;
  for (int trial = 0; trial < 200; ++trial)
  {
    TestWorld world;
    const auto robot = world.AddFootbot(5, 5, 2 * kPi * unit(random), trial % 5 == 0 ? 0.3 : 0);
    for (int i = 0; i < 14; ++i)
    {
      const double away = 4 * std::sqrt(unit(random)), bearing = 2 * kPi * unit(random);
      const double x = 5 + away * std::cos(bearing), y = 5 + away * std::sin(bearing);
      if (i % 3 == 0)
        world.AddBlock({x, y, 0.5 * unit(random)}, {0.1 + 2 * unit(random), 0.1 + 0.4 * unit(random), 0.5},
                       2 * kPi * unit(random));
      else if (i % 3 == 1)
        world.AddPrey(x, y, 0.05 + 0.4 * unit(random), 0.1 + unit(random));
      else
        world.AddFootbot(x, y, 2 * kPi * unit(random), 0.2 * unit(random));
    }
    CSwarmanoidSpace& space = world.Space();
    for (std::uint32_t e = 0; e < space.Size(); ++e)
      if (space.GetEntity(e).IsMovable() && (trial % 4 == 3 || (e != robot && unit(random) < 0.1)))
        space.SetPose(e, {space.GetPose(e).position,
                          QuaternionFromEuler({0.4 * unit(random), 0.4 * unit(random), unit(random)})});
    const bool is_full = trial % 2 == 0;
    const double pan = trial % 3 == 0 ? 0 : -100 + trial;
    TestSensor scanner(world, "range_scanner", "generic_range_scanner", {robot},
                       {{"beams", "37"},
                        {"field_of_view", is_full ? "360" : "200"},
                        {"layers", trial % 7 == 0 ? "1" : "5"},
                        {"vertical_field_of_view", "50"},
                        {"range", "3"},
                        {"pan", std::to_string(pan)},
                        {"position", "0.07, -0.05, 0.2"}});
    scanner.Update();
    const CCI_RangeScannerSensor& scan = ScanOf(scanner);
    const Pose pose = space.GetPose(robot);
    const Vector3 eye = pose.Apply({0.07, -0.05, 0.2});
    for (unsigned layer = 0; layer < scan.GetLayers(); ++layer)
      for (unsigned beam = 0; beam < 37; ++beam)
      {
        const double angle = scan.GetAngle(beam), up = scan.GetElevation(layer);
        const Vector3 way =
            pose.orientation * Vector3(std::cos(up) * std::cos(angle), std::cos(up) * std::sin(angle), std::sin(up));
        double body = kNoEcho;
        for (std::uint32_t e = 0; e < space.Size(); ++e)
          if (e != robot)
            if (const auto hit =
                    SegmentHit(ShapeOf(space.GetEntity(e).GetConfiguration()), space.GetPose(e), eye, eye + 3 * way))
              body = std::min(body, 3 * *hit);
        double floor = way.z() < -1e-12 ? eye.z() / -way.z() : kNoEcho;
        if (floor > 3) floor = kNoEcho;
        const double expected = std::min(body, floor);
        const double distance = scan.GetDistance(beam, layer);
        if (expected == kNoEcho)
          EXPECT_EQ(distance, kNoEcho) << trial << ": " << beam << ", " << layer;
        else
          EXPECT_NEAR(distance, expected, 1e-9) << trial << ": " << beam << ", " << layer;
        ++(expected == kNoEcho ? nothing : body < floor ? bodies : floors);
      }
  }
  EXPECT_GT(bodies, 500);
  EXPECT_GT(floors, 500);
  EXPECT_GT(nothing, 500);
}

}  // namespace
}  // namespace swarmanoid
