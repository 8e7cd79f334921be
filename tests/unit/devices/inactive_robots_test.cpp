// Robots that wait outside the arena are no work for the sensors of those inside, nor have any themselves.
#include <gmock/gmock.h>

#include "controller_host/devices/sensing/sensor_world.h"
#include "controller_host/devices/sensing/sight_lines.h"
#include "test_world.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

std::vector<std::uint32_t> SeenFrom(SightLines& lines, const CSwarmanoidSpace& space, std::uint32_t robot)
{
  lines.LookFrom(robot, space.GetPose(robot).position, 1000);
  const auto places = lines.PlacesAround();
  return {places.begin(), places.end()};
}

TEST(InactiveRobots, AreNeitherSensedNorSense)
{
  TestWorld world;
  for (int k = 0; k < 50; ++k) world.AddFootbot(1 + 0.15 * k, 2);
  auto& entities = world.Configuration().entities;
  for (std::uint32_t k = 2; k < 50; ++k)
  {
    entities[k].waits = true;
    entities[k].pose = WaitingPose(entities[k], k);
  }
  CSwarmanoidSpace& space = world.Space();
  SensorWorld sensors(space);
  SightLines lines(sensors, 1000);
  sensors.Refresh();
  EXPECT_THAT(sensors.Grid().Sorted(), UnorderedElementsAre(0U, 1U));
  EXPECT_EQ(SeenFrom(lines, space, 0).size(), 1U);
  EXPECT_THAT(SeenFrom(lines, space, 49), IsEmpty()) << "the others that wait are not far from it";

  // One comes in, one goes.
  space.SetPose(49, {{5, 5, 0}, Quaternion::Identity()});
  space.SetAttribute(space.PresenceSlot(49), 1);
  space.SetAttribute(space.PresenceSlot(0), 0);
  sensors.Refresh();
  EXPECT_THAT(sensors.Grid().Sorted(), UnorderedElementsAre(1U, 49U));
  EXPECT_EQ(SeenFrom(lines, space, 49).size(), 1U);
}

TEST(InactiveRobots, AreListedInOrderHoweverTheyComeAndGo)
{
  TestWorld world;
  for (int k = 0; k < 6; ++k) world.AddFootbot(1 + k, 2);
  CSwarmanoidSpace& space = world.Space();
  for (const std::uint32_t k : {4U, 1U, 5U, 1U}) space.SetAttribute(space.PresenceSlot(k), 0);
  EXPECT_THAT(space.Absent(), ElementsAre(1, 4, 5));
  const std::uint64_t revision = space.Revision();
  space.SetAttribute(space.PresenceSlot(4), 1);
  space.SetAttribute(space.PresenceSlot(3), 1);
  EXPECT_THAT(space.Absent(), ElementsAre(1, 5));
  EXPECT_NE(space.Revision(), revision);
}

}  // namespace
}  // namespace swarmanoid
