#include "real_robot/robot_file.h"

#include <gmock/gmock.h>

#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kExperiment = R"(<ahss-config>
  <framework><clocktick>50</clocktick><seed>7</seed><controller_path>mine</controller_path></framework>
  <controllers>
    <walker id="a" library="walkers">
      <actuators><footbot_wheels><implementation>noisy</implementation></footbot_wheels></actuators>
      <sensors><footbot_light/><footbot_gripper/></sensors>
      <parameters><speed>0.3</speed></parameters>
    </walker>
    <flyer id="b" library="flyers"/>
  </controllers>
  <arena size="2,2,1">
    <distribute quantity="5"><eyebot id="e"><controller>b</controller></eyebot></distribute>
    <footbot id="f"><controller>a</controller></footbot>
  </arena>
</ahss-config>
)";

class RobotFile : public ::testing::Test
{
protected:
  RobotFile() { Write("experiment.xml", kExperiment); }

  std::string Write(const std::string& name, const std::string& text) { return folder_.Write(name, text); }
  std::string Mistake(const std::string& path, const RobotChoice& choice = {})
  {
    const std::string text = test::MessageOf<ConfigurationError>([&] { ReadRobotFile(path, choice); }, "none");
    return text.starts_with(folder_.Path()) ? text.substr(folder_.Path().size() + 1) : text;
  }

  test::TemporaryFolder folder_;
};

TEST_F(RobotFile, TakesTheControllerOfAnExperiment)
{
  const RobotConfiguration robot = ReadRobotFile(folder_ / "experiment.xml", {.controller = "a", .id = "fb_3"});
  EXPECT_EQ(robot.id, "fb_3");
  EXPECT_EQ(robot.kind, "footbot");
  EXPECT_EQ(robot.clock_tick_ms, 50U);
  EXPECT_EQ(robot.seed, 7U);
  EXPECT_EQ(robot.controller_tag, "walker");
  EXPECT_EQ(robot.controller_library, "walkers");
  EXPECT_EQ(robot.parameters.GetNumber("speed"), 0.3);
  ASSERT_EQ(robot.sensors.size(), 2U);
  EXPECT_EQ(robot.sensors[1].type, "footbot_gripper");
  ASSERT_EQ(robot.actuators.size(), 1U);
  EXPECT_FALSE(robot.actuators[0].tree.Exists());
  EXPECT_EQ(robot.controller_path[0], (folder_ / "mine").string());
  EXPECT_THAT(robot.driver_libraries, ElementsAre("ros2_drivers"));
}

TEST_F(RobotFile, FindsTheKindOfDistributedRobots)
{
  EXPECT_EQ(ReadRobotFile(folder_ / "experiment.xml", {.controller = "b"}).kind, "eyebot");
}

TEST_F(RobotFile, AsksForAControllerWhereThereAreSeveral)
{
  EXPECT_EQ(Mistake(folder_ / "experiment.xml"),
            "experiment.xml:3:3: the file has the controllers a, b; choose one by --controller ID");
  EXPECT_EQ(Mistake(folder_ / "experiment.xml", {.controller = "c"}),
            "experiment.xml:3:3: there is no controller with the id 'c'; there are: a, b");
}

TEST_F(RobotFile, ChoosesDriversWithTheirParameters)
{
  const std::string path = Write("robot.xml", R"(<ahss-robot id="r7" namespace="r7">
  <experiment file="experiment.xml" controller="a"/>
  <drivers library="ros2_drivers, mine" path="drivers" prefer="mine">
    <actuators><footbot_wheels driver="serial"><port>/dev/ttyS0</port></footbot_wheels></actuators>
  </drivers>
</ahss-robot>)");
  const RobotConfiguration robot = ReadRobotFile(path, {});
  EXPECT_EQ(robot.id, "r7");
  EXPECT_EQ(robot.name_space, "r7");
  EXPECT_EQ(robot.preferred_driver, "mine");
  EXPECT_THAT(robot.driver_libraries, ElementsAre("ros2_drivers", "mine"));
  EXPECT_THAT(robot.driver_path, Contains((folder_ / "drivers").string()));
  EXPECT_EQ(robot.actuators[0].driver, "serial");
  EXPECT_EQ(robot.actuators[0].tree.GetText("port"), "/dev/ttyS0");
}

TEST_F(RobotFile, NamesThePlaceOfEachMistake)
{
  EXPECT_EQ(Mistake(Write("r.xml", "<ahss-robot/>")),
            "r.xml:1:1: a robot file names the experiment whose controller is to run: <experiment "
            "file=\"experiment.xml\" controller=\"its id\"/>");
  EXPECT_THAT(Mistake(Write("r.xml", "<ahss-robot><experiment file=\"none.xml\"/></ahss-robot>")),
              HasSubstr("there is no such file"));
  EXPECT_EQ(
      Mistake(Write("r.xml", "<ahss-robot><driver/></ahss-robot>")),
      "r.xml:1:13: <driver> cannot stand in <ahss-robot>; allowed are: experiment, drivers; did you mean 'drivers'?");
  EXPECT_EQ(Mistake(Write("r.xml", R"(<ahss-robot>
  <experiment file="experiment.xml" controller="a"/>
  <drivers><sensors><footbot_ligth/></sensors></drivers>
</ahss-robot>)")),
            "r.xml:3:21: the controller lists no sensor <footbot_ligth>; it lists: footbot_light, footbot_gripper; did "
            "you mean 'footbot_light'?");
  EXPECT_THAT(Mistake(Write("r.xml", "<robot/>")), HasSubstr("neither an experiment (<ahss-config>) nor a robot"));
}

}  // namespace
}  // namespace swarmanoid
