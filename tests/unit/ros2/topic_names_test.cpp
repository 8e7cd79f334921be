// Names of the topics of ROS 2.
#include <gtest/gtest.h>

#include "real_robot/driver.h"
#include "real_robot/drivers/ros2/ros2_endpoints.h"

namespace swarmanoid::ros2
{
namespace
{

TEST(TopicNames, AreInTheNamespaceUnlessTheyBeginAtTheRoot)
{
  EXPECT_EQ(TopicName("", "odom"), "rt/odom");
  EXPECT_EQ(TopicName("robot_1", "odom"), "rt/robot_1/odom");
  EXPECT_EQ(TopicName("/robot_1", "scan/a2"), "rt/robot_1/scan/a2");
  EXPECT_EQ(TopicName("robot_1", "/tf"), "rt/tf");
}

TEST(TopicNames, AreWordsThatDoNotBeginWithADigit)
{
  for (const char* name : {"", "/", "a/", "a//b", "1a", "a/1", "a/2b/c", "/1", "a-b", "a b", "\u00e4"})
    EXPECT_THROW(TopicName("", name), DriverError) << name;
  EXPECT_EQ(TopicName("", "a1/b2"), "rt/a1/b2");
}

TEST(TopicNames, OfRobotsAreTheirIdsAsWords)
{
  EXPECT_EQ(TopicWord("fb_1"), "fb_1");
  EXPECT_EQ(TopicWord("robot.2-b:c"), "robot_2_b_c");
  EXPECT_EQ(TopicWord("7th"), "_7th");
  EXPECT_EQ(TopicWord(""), "");
}

}  // namespace
}  // namespace swarmanoid::ros2
