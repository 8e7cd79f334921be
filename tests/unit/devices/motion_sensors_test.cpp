// Positioning, gyroscope and battery against the motion that they follow from.
#include "common/control_interface/ci_battery_sensor.h"
#include "common/control_interface/ci_gyroscope_sensor.h"
#include "common/control_interface/ci_positioning_sensor.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

TEST(Positioning, IsThePoseOfTheRobot)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  TestSensor sensor(world, "positioning", "generic_positioning", {0});
  const Pose pose{{1, 2, 0.5}, QuaternionFromEuler({0.1, -0.2, 2.5})};
  world.Space().SetPose(0, pose);
  sensor.Update();
  const auto& positioning = sensor.Of<CCI_PositioningSensor>(0);
  EXPECT_EQ(positioning.GetPosition(), pose.position);
  EXPECT_EQ(positioning.GetOrientation().coeffs(), world.Space().GetPose(0).orientation.coeffs());
  EXPECT_NEAR(positioning.GetHeading(), 2.5, 1e-12);
}

TEST(Positioning, IsTheOriginBeforeTheFirstReading)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  TestSensor sensor(world, "positioning", "generic_positioning", {0});
  const auto& positioning = sensor.Of<CCI_PositioningSensor>(0);
  EXPECT_EQ(positioning.GetPosition(), Vector3(0, 0, 0));
  EXPECT_EQ(positioning.GetOrientation().coeffs(), Quaternion::Identity().coeffs());
}

// If a body turns steadily about an axis fixed in it, its rates are that axis times its speed.
TEST(Gyroscope, ReadsTheAngularVelocityInTheFrameOfTheRobot)
{
  RandomStream random(5, 0, 0, 0);
  for (int trial = 0; trial < 50; ++trial)
  {
    TestWorld world;
    world.AddFootbot(5, 5);
    TestSensor sensor(world, "gyroscope", "generic_gyroscope", {0});
    const Vector3 rates(random.Uniform(-10, 10), random.Uniform(-10, 10), random.Uniform(-10, 10));
    const double angle = rates.norm() * world.Space().GetTickSeconds();
    const Quaternion turn(Eigen::AngleAxisd(angle, rates.normalized()));
    Quaternion orientation = QuaternionFromEuler({random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-3, 3)});
    for (std::uint64_t tick = 0; tick < 4; ++tick)
    {
      world.Space().SetTick(tick);
      world.Space().SetPose(0, {{5, 5, 0}, orientation});
      sensor.Update();
      const auto readings = sensor.Of<CCI_GyroscopeSensor>(0).GetAllSensorReadings();
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(readings[static_cast<std::size_t>(axis)], tick == 0 ? 0 : rates[axis], 1e-9);
      orientation = orientation * turn;
    }
  }
}

const TestParameters kConsumption{
    {"start_charge", "0.5"}, {"per_second", "0.01"}, {"per_metre", "0.2"}, {"per_radian", "0.1"}};

TEST(Battery, FallsWithTimeWayAndAngleAndNeverBelowEmpty)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  TestSensor sensor(world, "battery", "generic_battery", {0}, kConsumption);
  const auto& battery = sensor.Of<CCI_BatterySensor>(0);
  const auto step = [&](std::uint64_t tick, double x, double yaw)
  {
    world.Space().SetTick(tick);
    world.Space().SetPose(0, {{x, 5, 0}, QuaternionFromYaw(yaw)});
    sensor.Update();
  };
  step(0, 5, 0);
  EXPECT_EQ(battery.GetCharge(), 0.5);
  EXPECT_EQ(battery.GetTimeLeft(), std::numeric_limits<double>::infinity());
  step(1, 5.3, 0.4);
  const double used = 0.01 * 0.1 + 0.2 * 0.3 + 0.1 * 0.4;
  EXPECT_NEAR(battery.GetCharge(), 0.5 - used, 1e-12);
  EXPECT_NEAR(battery.GetTimeLeft(), (0.5 - used) / used * 0.1, 1e-9);
  step(2, 5.3, 0.4);
  EXPECT_NEAR(battery.GetCharge(), 0.5 - used - 0.001, 1e-12);
  for (std::uint64_t tick = 3; tick < 10; ++tick) step(tick, 5 + 0.5 * static_cast<double>(tick % 2), 0);
  EXPECT_EQ(battery.GetCharge(), 0);
}

TEST(Battery, IsFullAtFirstAndNoisyReadingsStayInItsRange)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  TestSensor plain(world, "battery", "generic_battery", {0});
  TestSensor noisy(world, "battery", "generic_battery", {0},
                   {{"start_charge", "0.5"},
                    {"per_second", "0"},
                    {"noise_kind", "uniform"},
                    {"noise_mean", "0"},
                    {"noise_range", "2"}});
  bool was_full = false, was_empty = false;
  for (std::uint64_t tick = 0; tick < 100; ++tick)
  {
    world.Space().SetTick(tick);
    world.Space().SetPose(
        0, {{5 + 0.01 * static_cast<double>(tick), 5, 0}, QuaternionFromYaw(0.02 * static_cast<double>(tick))});
    plain.Update();
    noisy.Update();
    const double charge = noisy.Of<CCI_BatterySensor>(0).GetCharge();
    EXPECT_GE(charge, 0);
    EXPECT_LE(charge, 1);
    was_full |= charge == 1;
    was_empty |= charge == 0;
  }
  EXPECT_TRUE(was_full && was_empty);
  // 1e-4 each second, and 1e-3 each metre and radian.
  EXPECT_NEAR(plain.Of<CCI_BatterySensor>(0).GetCharge(), 1 - 99 * (1e-4 * 0.1 + 1e-3 * 0.01 + 1e-3 * 0.02), 1e-12);
}

TEST(Battery, KeepsItsChargeOutsideTheArena)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  CSwarmanoidSpace& space = world.Space();
  TestSensor battery(world, "battery", "generic_battery", {0}, kConsumption);
  TestSensor gyroscope(world, "gyroscope", "generic_gyroscope", {0});
  const auto step = [&](bool is_present, double x, double yaw)
  {
    space.SetAttribute(space.PresenceSlot(0), is_present);
    space.SetPose(0, {{x, 5, 0}, QuaternionFromYaw(yaw)});
    battery.Update();
    gyroscope.Update();
    EXPECT_EQ(gyroscope.Of<CCI_GyroscopeSensor>(0).GetYawRate(), 0) << "carried, not turned";
    return battery.Of<CCI_BatterySensor>(0).GetCharge();
  };
  step(true, 5, 0);
  EXPECT_EQ(step(false, 1e5, 1), 0.5);
  EXPECT_EQ(step(false, 1e5, 1), 0.5);
  EXPECT_EQ(step(true, 3, 2), 0.5);
  EXPECT_NEAR(step(true, 3, 2), 0.499, 1e-12);
}

// Sensors with a memory continue from a saved state without a difference.
TEST(MotionSensors, GoOnFromASavedState)
{
  for (const char* type : {"gyroscope", "battery"})
  {
    TestWorld world;
    world.AddFootbot(5, 5);
    const std::string implementation = std::string("generic_") + type;
    TestSensor first(world, type, implementation, {0});
    TestSensor second(world, type, implementation, {0});
    const auto readings = [&](TestSensor& sensor)
    {
      sensor.Update();
      std::vector<CCI_Reading> described;
      sensor.batch->Sensor(0)->Describe(described);
      return described.back().value;
    };
    for (int tick = 0; tick < 5; ++tick)
    {
      world.Space().SetPose(0, {{5 + 0.1 * tick, 5, 0}, QuaternionFromYaw(0.3 * tick * tick)});
      readings(first);
    }
    ByteWriter saved;
    first.batch->SaveState(0, saved);
    ByteReader reader(saved.Bytes());
    second.batch->LoadState(0, reader);
    world.Space().SetPose(0, {{5.9, 5.2, 0}, QuaternionFromYaw(-1)});
    EXPECT_EQ(readings(second), readings(first)) << type;
    EXPECT_TRUE(reader.AtEnd());
  }
}

}  // namespace
}  // namespace swarmanoid
