// Light sensors in rings, by closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "common/control_interface/ci_light_sensor.h"
#include "common/math/elementary.h"
#include "test_world.h"

namespace swarmanoid
{
namespace
{

// A footbot at (2, 2, 0), turned by 0.3 rad, and a bulb.
std::vector<double> ReadingsOf(const TestParameters& parameters, const Vector3& bulb, double intensity)
{
  TestWorld world;
  world.AddEngine("ground");
  world.AddFootbot(2, 2, 0.3);
  const auto entity = world.Add(EntityKind::kLightBulb, bulb, 0, {0, 0, 0}, false, -1);
  world.Configuration().entities[entity].intensity = intensity;
  TestSensor sensor(world, "light", "argos3_light", {0}, parameters);
  sensor.Update();
  const auto readings = sensor.Of<CCI_LightSensor>(0).GetAllSensorReadings();
  return {readings.begin(), readings.end()};
}

double Off(double direction_deg, const Vector3& way)
{
  return std::abs(std::remainder(direction_deg * kPi / 180 + 0.3 - std::atan2(way.y(), way.x()), 2 * kPi));
}

TEST(ExponentialLightRing, FallsWithTheDistanceAndTheAngleOfEachSensor)
{
  const Vector3 eye(0.1, -0.05, 0.2);
  const Vector3 place(2 + 0.1 * std::cos(0.3) + 0.05 * std::sin(0.3), 2 + 0.1 * std::sin(0.3) - 0.05 * std::cos(0.3),
                      0.2);
  const Vector3 bulb(1, 2.7, 0.9);
  const auto readings =
      ReadingsOf({{"directions", "17, 100, 200"}, {"half_angle", "180"}, {"position", "0.1, -0.05, 0.2"}}, bulb, 1.5);
  ASSERT_EQ(readings.size(), 3U);
  const Vector3 way = bulb - place;
  for (unsigned i = 0; i < 3; ++i)
  {
    const double direction = i == 0 ? 17 : i == 1 ? 100 : 200;
    EXPECT_NEAR(readings[i], std::exp(-2 * way.norm() / 1.5) * (1 - Off(direction, way) / kPi), 1e-12) << i;
  }
}

TEST(ExponentialLightRing, SeesNothingBehindItsHalfAngleAndItsReach)
{
  // Sensors at 0 and 90 degrees of a robot that is turned by 0.3 rad; the bulb is straight to the robot's right.
  const Vector3 right(2 + 0.5 * std::sin(0.3), 2 - 0.5 * std::cos(0.3), 0);
  const auto readings = ReadingsOf({{"directions", "0, 90, -90"}}, right, 1);
  EXPECT_NEAR(readings[0], 0, 1e-12);
  EXPECT_EQ(readings[1], 0);
  EXPECT_NEAR(readings[2], std::exp(-1), 1e-12);
  EXPECT_GT(ReadingsOf({{"directions", "0"}}, {4.49, 2.1, 0}, 1)[0], 0);
  EXPECT_EQ(ReadingsOf({{"directions", "0"}}, {4.51, 2.1, 0}, 1)[0], 0);
}

TEST(ExponentialLightRing, AStepOfIndicesSkipsSensorsAsArgos3DoesForKheperas)
{
  // By steps of 15 degrees, a light at 90 degrees is number 6 of 8 sensors. So sensors 4, 5, 6, 7 and 0 are computed,
  // and none of them looks at it.
  const Vector3 left(2 - std::sin(0.3), 2 + std::cos(0.3), 0);
  for (const double reading : ReadingsOf({{"index_step", "15"}}, left, 1)) EXPECT_NEAR(reading, 0, 1e-12);
  const auto all = ReadingsOf({}, left, 1);
  EXPECT_NEAR(all[2], std::exp(-2), 1e-12);
  // A light ahead is number 0.
  const Vector3 ahead(2 + std::cos(0.3), 2 + std::sin(0.3), 0);
  const auto near = ReadingsOf({{"index_step", "15"}}, ahead, 1);
  EXPECT_NEAR(near[0], std::exp(-2), 1e-12);
  EXPECT_NEAR(near[1], std::exp(-2) / 2, 1e-12);
  EXPECT_NEAR(near[7], std::exp(-2) / 2, 1e-12);
}

}  // namespace
}  // namespace swarmanoid
