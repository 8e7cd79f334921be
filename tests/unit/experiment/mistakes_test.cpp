// Each kind of mistake in an experiment file gives its place, what is wrong and what to do.
#include <gmock/gmock.h>

#include <sstream>
#include <string>
#include <vector>

#include "common/experiment/diagnostics.h"
#include "common/mesh/convex_hull.h"
#include "tests/unit/experiment/fake_plugins.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid::test
{
namespace
{

const std::string kGood = R"xml(<ahss-config>
  <framework>
    <clocktick>100</clocktick>
    <maxclock>500</maxclock>
  </framework>
  <controllers>
    <footbot_sample_controller id="fc">
      <actuators>
        <footbot_wheels><implementation>dummy_footbot_wheels</implementation></footbot_wheels>
      </actuators>
      <sensors>
        <pie_camera implementation="generic_pie_camera" noise="0.1"/>
      </sensors>
      <parameters><any><thing at="all"/></any></parameters>
    </footbot_sample_controller>
  </controllers>
  <arena size="10,10,3" optimization="2D">
    <footbot id="fb"><position>9, 9, 0</position><controller>fc</controller></footbot>
    <footbot id="fb2" position="8, 8, 0" orientation="0,0,90"/>
    <block id="wall"><position>5, 5, 0.25</position><size>1, 1, 0.5</size></block>
    <light_bulb id="lamp" position="1, 1, 2"/>
  </arena>
  <engines>
    <dummy_engine id="ground"><perpendicular_axis>z</perpendicular_axis></dummy_engine>
  </engines>
  <arena_physics>
    <engine id="ground"><entity id="fb"/><entity id="fb2"/><entity id="wall"/></engine>
  </arena_physics>
  <visualisations>
    <text_render id="table"><file>table.txt</file></text_render>
  </visualisations>
</ahss-config>
)xml";

struct Mistake
{
  const char* name;
  const char* good;    // a part of the file above that occurs once
  const char* bad;     // the text that replaces it
  const char* errors;  // all of them
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

std::string WithMistake(const Mistake& mistake)
{
  std::string text = kGood;
  const std::size_t at = text.find(mistake.good);
  EXPECT_NE(at, std::string::npos) << mistake.good;
  EXPECT_EQ(text.find(mistake.good, at + 1), std::string::npos) << "twice: " << mistake.good;
  return text.replace(at, std::string(mistake.good).size(), mistake.bad);
}

class Mistakes : public testing::TestWithParam<Mistake>
{
};

TEST_P(Mistakes, AreNamedWithPlaceAndCure) { EXPECT_EQ(ErrorsOf(WithMistake(GetParam())), GetParam().errors); }

const Mistake kMistakes[] = {
    {"UnknownRoot", "<ahss-config>\n  <framework>", "<argos-config>\n  <framework>",
     "test.xml:32:1: </ahss-config> does not match <argos-config>, which starts in line 1 and must be closed first\n"},
    {"UnknownSection", "<framework>\n", "<framwork/><framework>\n",
     "test.xml:2:3: <ahss-config> has no element <framwork>; allowed: framework, entity_kinds, controllers, arena, "
     "engines, "
     "arena_physics, visualisations, experiment_functions, faults; did you mean 'framework'?\n"},
    {"SecondSection", "<engines>\n", "<engines/>\n  <engines>\n",
     "test.xml:24:3: <ahss-config> holds a second <engines>; the first is in line 23\ntest.xml:28:13: there is no "
     "engine 'ground'; there are: none\n"},
    {"MissingArenaSize", "<arena size=\"10,10,3\" optimization=\"2D\">", "<arena optimization=\"2D\">",
     "test.xml:17:3: <arena> lacks 'size': three numbers \"x, y, z\" in m, from 1e-06 to 1000000 m\n"},
    {"UnknownAttribute", "optimization=\"2D\"", "optimisation=\"2D\"",
     "test.xml:17:3: <arena> lacks 'optimization': one of 2D, 3D, octree\ntest.xml:17:25: <arena> has no attribute "
     "'optimisation'; allowed: size, optimization, limit, beyond_limit; did you mean 'optimization'?\n"},
    {"BadChoice", "optimization=\"2D\"", "optimization=\"2d\"",
     "test.xml:17:25: 'optimization' of <arena> is '2d'; it must be one of 2D, 3D, octree; did you mean '2D'?\n"},
    {"NotANumber", "<maxclock>500</maxclock>", "<maxclock>5OO</maxclock>",
     "test.xml:4:5: 'maxclock' of <framework> is '5OO'; it must be a whole number in ticks, from 0 to 1000000000000000 "
     "ticks\n"},
    {"Negative", "<maxclock>500</maxclock>", "<maxclock>-1</maxclock>",
     "test.xml:4:5: 'maxclock' of <framework> is -1 ticks; it must be from 0 to 1000000000000000 ticks\n"},
    {"Fraction", "<clocktick>100</clocktick>", "<clocktick>0.1</clocktick>",
     "test.xml:3:5: 'clocktick' of <framework> is '0.1'; it must be a whole number in ms, from 1 to 3600000 ms\n"},
    {"ZeroTick", "<clocktick>100</clocktick>", "<clocktick>0</clocktick>",
     "test.xml:3:5: 'clocktick' of <framework> is 0 ms; it must be from 1 to 3600000 ms\n"},
    {"EmptyValue", "<clocktick>100</clocktick>", "<clocktick></clocktick>",
     "test.xml:3:5: 'clocktick' of <framework> is empty; it must be a whole number in ms, from 1 to 3600000 ms\n"},
    {"GivenTwice", "<clocktick>100</clocktick>", "<clocktick>100</clocktick><clocktick>10</clocktick>",
     "test.xml:3:31: <framework> gives 'clocktick' a second time; the first is in line 3\n"},
    {"BothForms", "<framework>\n", "<framework clocktick=\"10\">\n",
     "test.xml:3:5: <framework> gives 'clocktick' both as an attribute and as an element; keep one\n"},
    {"AttributesOnAValue", "<clocktick>100", "<clocktick unit=\"ms\">100",
     "test.xml:3:16: <clocktick> holds a value only: a whole number in ms, from 1 to 3600000 ms\n"},
    {"TextBetweenElements", "<framework>\n", "<framework>fast\n",
     "test.xml:2:3: <framework> holds the text 'fast', where only elements are allowed\n"},
    {"NotNumberInVector", "<position>9, 9, 0</position>", "<position>9, nan, 0</position>",
     "test.xml:18:22: 'position' of <footbot> is '9, nan, 0'; it must be three numbers \"x, y, z\" in m, from -1000000 "
     "to 1000000 m\n"},
    {"TwoNumbersForThree", "<position>9, 9, 0</position>", "<position>9, 9</position>",
     "test.xml:18:22: 'position' of <footbot> is '9, 9'; it must be three numbers \"x, y, z\" in m, from -1000000 to "
     "1000000 m\n"},
    {"ZeroSize", "<size>1, 1, 0.5</size>", "<size>1, 0, 0.5</size>",
     "test.xml:20:53: y of 'size' of <block> is 0 m; it must be from 1e-06 to 1000000 m\n"},
    {"MissingPosition", "<position>9, 9, 0</position>", "",
     "test.xml:18:5: <footbot> lacks 'position': three numbers \"x, y, z\" in m, from -1000000 to 1000000 m\n"},
    {"BudgetOfOneThatIsStartedAgain", "<footbot_sample_controller id=\"fc\">",
     "<footbot_sample_controller id=\"fc\" on_failure=\"restart\" time_budget_ms=\"5\">",
     "test.xml:7:61: the controller 'fc' has a time_budget_ms and on_failure=\"restart\": one that is too slow would "
     "be so "
     "again; take on_failure=\"stop_robot\" or \"abort\"\n"},
    {"BadPolicy", "<footbot_sample_controller id=\"fc\">", "<footbot_sample_controller id=\"fc\" on_failure=\"stop\">",
     "test.xml:7:40: 'on_failure' of <footbot_sample_controller> is 'stop'; it must be one of abort, stop_robot, "
     "restart; "
     "did you mean 'stop_robot'?\n"},
    {"OutsideTheArena", "<position>9, 9, 0</position>", "<position>9, 12, 0</position>",
     "test.xml:18:22: 'fb' is outside the arena: y is 12 m; it must be from 0 to 10 m\n"},
    {"UnknownEntity", "<light_bulb id=\"lamp\"", "<lightbulb id=\"lamp\"",
     "test.xml:21:5: <arena> has no element <lightbulb>; allowed: footbot, eyebot, handbot, block, cylindric_prey, "
     "light_bulb, sound_source, ground_patch, hole, wall, terrain, charging_station, distribute, reserve, "
     "floor_field, wind, size, optimization, limit, "
     "beyond_limit; did you mean 'light_bulb'?\n"},
    {"UnknownPolicy", "optimization=\"2D\"", "optimization=\"2D\" beyond_limit=\"ignore\"",
     "test.xml:17:43: 'beyond_limit' of <arena> is 'ignore'; it must be one of stop, hold, remove\n"},
    {"UnknownParameter", "orientation=\"0,0,90\"", "orientaton=\"0,0,90\"",
     "test.xml:19:42: <footbot> has no attribute 'orientaton'; allowed: id, position, orientation, controller; did you "
     "mean 'orientation'?\n"},
    {"PictureOnADisc", "<light_bulb id=\"lamp\" position=\"1, 1, 2\"/>",
     "<ground_patch id=\"lamp\" position=\"1, 1, 0\" radius=\"1\" picture=\"none.png\"/>",
     "test.xml:21:59: a picture lies on a rectangle: give 'size', not 'radius'\n"},
    {"TerrainWithoutMap", "<light_bulb id=\"lamp\" position=\"1, 1, 2\"/>", "<terrain id=\"lamp\"/>",
     "test.xml:21:5: <terrain> must hold one map, <octomap file=\"…\"/> or <heightmap file=\"…\" size=\"…\" "
     "height=\"…\"/>; it holds 0\n"},
    {"TerrainWithTwoMaps", "<light_bulb id=\"lamp\" position=\"1, 1, 2\"/>",
     "<terrain id=\"lamp\"><octomap file=\"a.bt\"/><heightmap file=\"a.png\" size=\"1,1\" height=\"1\"/></terrain>",
     "test.xml:21:5: <terrain> must hold one map, <octomap file=\"…\"/> or <heightmap file=\"…\" size=\"…\" "
     "height=\"…\"/>; it holds 2\n"},
    {"HeightMapWithoutHeight", "<light_bulb id=\"lamp\" position=\"1, 1, 2\"/>",
     "<terrain id=\"lamp\"><heightmap file=\"a.png\" size=\"1,1\"/></terrain>",
     "test.xml:21:24: <heightmap> lacks 'height': a number in m, from 1e-06 to 1000000 m\n"},
    {"OctoMapWithAnUnknownAttribute", "<light_bulb id=\"lamp\" position=\"1, 1, 2\"/>",
     "<terrain id=\"lamp\"><octomap fil=\"a.bt\"/></terrain>",
     "test.xml:21:24: <octomap> lacks 'file': a text\ntest.xml:21:33: <octomap> has no attribute 'fil'; allowed: file; "
     "did you mean 'file'?\n"},
    {"DuplicateId", "id=\"fb2\" position", "id=\"fb\" position",
     "test.xml:19:14: two entities have the id 'fb'; the first is in line 18\ntest.xml:27:50: there is no entity "
     "'fb2'; there are: fb, fb, wall, lamp; did you mean 'fb'?\n"},
    {"BadId", "id=\"lamp\"", "id=\"lamp 1\"",
     "test.xml:21:17: the id 'lamp 1' must be 1 to 64 letters, digits, '_', '.', ':' or '-', and start with none of "
     "the last three\n"},
    {"EmptyId", "id=\"lamp\"", "id=\"\"",
     "test.xml:21:17: the id '' must be 1 to 64 letters, digits, '_', '.', ':' or '-', and start with none of the last "
     "three\n"},
    {"MissingId", "<light_bulb id=\"lamp\"", "<light_bulb", "test.xml:21:5: <light_bulb> lacks 'id': a text\n"},
    {"UnknownController", "<controller>fc</controller>", "<controller>fcc</controller>",
     "test.xml:18:50: there is no controller with the id 'fcc'; there are: fc; did you mean 'fc'?\n"},
    {"OverlappingRobots", "position=\"8, 8, 0\"", "position=\"9, 9.1, 0\"",
     "test.xml:19:23: the footbot 'fb2' overlaps the footbot 'fb' (line 18) in the engine 'ground'; move one of "
     "them\n"},
    {"RobotInAWall", "position=\"8, 8, 0\"", "position=\"5.5, 5, 0\"",
     "test.xml:19:23: the footbot 'fb2' overlaps the block 'wall' (line 20) in the engine 'ground'; move one of "
     "them\n"},
    {"UnknownDevice", "<pie_camera implementation=\"generic_pie_camera\" noise=\"0.1\"/>",
     "<pi_camera implementation=\"generic_pie_camera\"/>",
     "test.xml:12:9: there is no sensor <pi_camera>; known: eyebot_altitude, footbot_proximity, pie_camera; did you "
     "mean 'pie_camera'?\n"},
    {"UnknownImplementation", "dummy_footbot_wheels", "dumy_footbot_wheels",
     "test.xml:9:25: the actuator <footbot_wheels> has no implementation 'dumy_footbot_wheels'; known: "
     "dummy_footbot_wheels, dynamic_footbot_wheels; did you mean 'dummy_footbot_wheels'?\n"},
    {"MissingImplementation", " implementation=\"generic_pie_camera\"", "",
     "test.xml:12:9: <pie_camera> lacks its implementation; known: generic_pie_camera\n"},
    {"UnknownDeviceParameter", "noise=\"0.1\"", "nose=\"0.1\"",
     "test.xml:12:57: <pie_camera> has no attribute 'nose'; allowed: implementation, library, noise; did you mean "
     "'noise'?\n"},
    {"DeviceParameterOutOfRange", "noise=\"0.1\"", "noise=\"2\"",
     "test.xml:12:57: 'noise' of <pie_camera> is 2; it must be from 0 to 1\n"},
    {"DeviceTwice", "<sensors>\n", "<sensors><pie_camera implementation=\"generic_pie_camera\"/>\n",
     "test.xml:12:9: <pie_camera> is listed twice; the first is in line 11\n"},
    {"DeviceOfAnotherRobot", "<pie_camera implementation=\"generic_pie_camera\" noise=\"0.1\"/>",
     "<eyebot_altitude implementation=\"generic_eyebot_altitude\"/>",
     "test.xml:12:9: the sensor <eyebot_altitude> (generic_eyebot_altitude) is for eyebot only, but the footbot 'fb' "
     "uses the controller 'fc'\n"},
    {"ChannelThatTheEngineLacks", "dummy_footbot_wheels", "dynamic_footbot_wheels",
     "test.xml:9:9: the actuator <footbot_wheels> (dynamic_footbot_wheels) of the robot 'fb' needs 'footbot_forces' "
     "from its engine, which 'ground' (dummy_engine) does not offer; it offers: footbot_wheels, footbot_gripper. Use "
     "another implementation or another engine\n"},
    {"RobotWithoutTheEngineThatItsDevicesNeed", "<entity id=\"fb\"/>", "",
     "test.xml:18:5: the robot 'fb' is in no engine, but <footbot_wheels> (dummy_footbot_wheels) of its controller "
     "'fc' "
     "needs one; list the robot under an engine in <arena_physics>, or leave the device out\n"},
    {"ParametersAsAttribute", "<footbot_sample_controller id=\"fc\">",
     "<footbot_sample_controller id=\"fc\" parameters=\"1\">",
     "test.xml:7:40: 'parameters' must be written as an element, <parameters>…</parameters>\ntest.xml:14:7: "
     "<footbot_sample_controller> gives 'parameters' both as an attribute and as an element; keep one\n"},
    {"UnknownEngine", "<dummy_engine id=\"ground\"><perpendicular_axis>z</perpendicular_axis></dummy_engine>",
     "<dumy_engine id=\"ground\"/>",
     "test.xml:24:5: there is no physics engine <dumy_engine>; known: dummy_engine; did you mean 'dummy_engine'?\n"},
    {"EngineParameter", "<perpendicular_axis>z</perpendicular_axis>", "<perpendicular_axis>w</perpendicular_axis>",
     "test.xml:24:31: 'perpendicular_axis' of <dummy_engine> is 'w'; it must be one of x, y, z\n"},
    {"EngineParameterName", "<perpendicular_axis>z</perpendicular_axis>", "<perpendicular>z</perpendicular>",
     "test.xml:24:31: <dummy_engine> has no element <perpendicular>; allowed: id, subclock, split, library, "
     "perpendicular_axis, distance; did you mean 'perpendicular_axis'?\n"},
    {"EngineThatCannotBeSplit", "<dummy_engine id=\"ground\">", "<dummy_engine id=\"ground\" split=\"2\">",
     "test.xml:24:31: the engine 'ground' (dummy_engine) cannot be split; leave out split\n"},
    {"SplitThatIsNone", "<dummy_engine id=\"ground\">", "<dummy_engine id=\"ground\" split=\"6x6\">",
     "test.xml:24:31: split is '6x6'; it must be a number of regions from 1 to 32 (\"4\"), or columns and rows of as "
     "many (\"2x2\")\n"},
    {"EngineTwice", "<engines>\n", "<engines><dummy_engine id=\"ground\"/>\n",
     "test.xml:24:19: two engines have the id 'ground'; the first is in line 23\n"},
    {"UnknownEngineId", "<engine id=\"ground\">", "<engine id=\"gound\">",
     "test.xml:27:13: there is no engine 'gound'; there are: ground; did you mean 'ground'?\n"},
    {"UnknownEntityId", "<entity id=\"fb2\"/>", "<entity id=\"fb3\"/>",
     "test.xml:27:50: there is no entity 'fb3'; there are: fb, fb2, wall, lamp; did you mean 'fb2'?\n"},
    {"EntityListedTwice", "<entity id=\"fb2\"/>", "<entity id=\"fb2\"/><entity id=\"fb2\"/>",
     "test.xml:27:68: 'fb2' is listed twice in the engine 'ground'; the first is in line 27\n"},
    {"PatternThatFitsNothing", "<entity id=\"fb2\"/>", "<entity id=\"robot_*\"/>",
     "test.xml:27:50: no entity fits 'robot_*'\n"},
    {"EntityThatTheEngineCannotSimulate", "<entity id=\"fb2\"/>", "<entity id=\"lamp\"/>",
     "test.xml:27:50: the engine 'ground' (dummy_engine) cannot simulate the light_bulb 'lamp'; it can: footbot, "
     "eyebot, handbot, block, cylindric_prey, wall\n"},
    {"UnknownKindOfAll", "<entity id=\"fb2\"/>", "<all kind=\"footbots\"/>",
     "test.xml:27:47: there is no kind of entity 'footbots'; known: footbot, eyebot, handbot, block, cylindric_prey, "
     "light_bulb, sound_source, ground_patch, hole, wall, terrain, charging_station; did you mean 'footbot'?\n"},
    {"EngineMembersTwice", "<arena_physics>\n", "<arena_physics><engine id=\"ground\"/>\n",
     "test.xml:27:13: the entities of the engine 'ground' are given twice; the first time in line 26\n"},
    {"UnknownVisualisation", "<text_render id=\"table\"><file>table.txt</file></text_render>",
     "<txt_render id=\"table\"/>",
     "test.xml:30:5: there is no visualisation <txt_render>; known: opengl_render, text_render; did you mean "
     "'text_render'?\n"},
    {"VisualisationParameter", "<file>table.txt</file>", "<file>table.txt</file><precison>3</precison>",
     "test.xml:30:51: <text_render> has no element <precison>; allowed: id, library, file, precision; did you mean "
     "'precision'?\n"},
};

INSTANTIATE_TEST_SUITE_P(Reader, Mistakes, testing::ValuesIn(kMistakes),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(MistakesTogether, TheGoodFileHasNone) { EXPECT_EQ(ErrorsOf(kGood), ""); }

TEST(MistakesTogether, AllAreReportedInTheOrderOfTheFile)
{
  EXPECT_EQ(ErrorsOf("<ahss-config>\n"
                     "  <framework clocktick='no'/>\n"
                     "  <arena size='1,1,1' optimization='4D'>\n"
                     "    <footbot id='a' position='2,0,0' controller='c'/>\n"
                     "  </arena>\n"
                     "  <engines><engine id='e'/></engines>\n"
                     "</ahss-config>"),
            "test.xml:2:14: 'clocktick' of <framework> is 'no'; it must be a whole number in ms, from 1 to 3600000 ms\n"
            "test.xml:3:23: 'optimization' of <arena> is '4D'; it must be one of 2D, 3D, octree; did you mean '2D'?\n"
            "test.xml:4:21: 'a' is outside the arena: x is 2 m; it must be from 0 to 1 m\n"
            "test.xml:4:38: there is no controller with the id 'c'; there are: none\n"
            "test.xml:6:12: there is no physics engine <engine>; known: dummy_engine\n");
}

// Each text has one mistake. What is missing because of it, in the arena, the lists of engines and the places, is not
// reported.
TEST(MistakesTogether, ConsequencesOfAMistakeAreLeftOut)
{
  const auto told = [](const std::string& kinds, const std::string& arena, const std::string& physics)
  {
    return ErrorsOf(ExperimentText{.kinds = kinds.empty() ? " " : kinds,
                                   .size = "9,9,3",
                                   .arena = arena,
                                   .physics = "<engine id='e'>" + physics + "</engine>"}
                        .Text());
  };
  // A mistake may have several lines, of which all but the first are indented.
  const auto count = [](const std::string& errors)
  {
    int mistakes = 0;
    std::istringstream lines(errors);
    for (std::string line; std::getline(lines, line);) mistakes += line.starts_with(' ') ? 0 : 1;
    return mistakes;
  };
  const std::string rover = "<rover id='r' position='1,1,0'/>";
  const std::string many = "<distribute quantity='3'><position method='uniform' min='1,1,0' max='2,2,0'/>";
  // A kind that cannot be read is missing in the arena, and its entities among those of the engine.
  for (const auto& [arena, physics] : std::vector<std::pair<std::string, std::string>>{
           {rover, "<entity id='r'/>"},
           {rover, "<entity id='r*'/>"},
           {rover, "<all kind='rover'/>"},
           {many + "<rover id='r'/></distribute>", "<entity id='r_2'/><entity id='r_?'/>"},
           {"<reserve quantity='3'><rover id='r'/></reserve>", "<entity id='r_0'/>"}})
  {
    const std::string errors = told("<rover urdf='none.urdf'/>", arena, physics);
    EXPECT_THAT(errors, testing::StartsWith("test.xml:2:22: ")) << errors;
    EXPECT_EQ(count(errors), 1) << errors;
  }
  for (const std::string kind : {"<rover library='no_such_library'/>", "<rover/>"})
  {
    const std::string errors = told(kind, rover, "<entity id='r'/><all kind='rover'/>");
    EXPECT_EQ(count(errors), 1) << errors;
  }
  // A misspelt entity, and one whose number is wrong.
  EXPECT_THAT(told("", "<footbt id='f' position='1,1,0'/>", "<entity id='f'/>"),
              testing::HasSubstr("<arena> has no element <footbt>"));
  for (const std::string& arena :
       std::vector<std::string>{"<footbt id='f' position='1,1,0'/>", many + "<footbt id='f'/></distribute>",
                                "<distribute quantity='-3'><position method='uniform' min='1,1,0' "
                                "max='2,2,0'/><footbot id='f'/></distribute>"})
  {
    const std::string errors = told("", arena, "<entity id='f*'/>");
    EXPECT_EQ(count(errors), 1) << errors;
  }
  // Positions on a map that cannot be read are unknown.
  const std::string errors =
      told("",
           "<terrain id='t'><octomap file='none.bt'/></terrain><distribute quantity='3'><position "
           "method='uniform' drop_from='2' min='1,1,0' max='2,2,0'/><block id='b' size='.1,.1,.1' "
           "movable='true'/></distribute>",
           "<all/>");
  EXPECT_THAT(errors, testing::HasSubstr("none.bt"));
  EXPECT_EQ(count(errors), 1) << errors;
  // Mistakes with another cause are still reported.
  EXPECT_THAT(told("<rover urdf='none.urdf'/>", rover, "<entity id='s'/>"),
              testing::HasSubstr("there is no entity 's'"));
  EXPECT_THAT(told("<rover urdf='none.urdf'/>", "<rovr id='r'/>", ""), testing::HasSubstr("has no element <rovr>"));
}

// The experiment only names such a file, so that its mistakes are causes.
TEST(MistakesTogether, ThoseOfAnotherFileComeFirst)
{
  Diagnostics diagnostics;
  const auto in = [](const char* file, int line) {
    return SourceLocation{std::make_shared<const std::string>(file), line, 1};
  };
  diagnostics.Add(in("test.xml", 9), "third");
  diagnostics.Add(in("test.xml", 2), "second");
  diagnostics.Add(in("rover.urdf", 30), "first");
  std::string order;
  for (const Diagnostic& one : diagnostics.Take("test.xml")) order += one.message + " ";
  EXPECT_EQ(order, "first second third ");
}

TEST(MistakesTogether, AnotherRootElementIsRefused)
{
  EXPECT_EQ(ErrorsOf("<!-- x -->\n<argos-configuration/>"),
            "test.xml:2:1: the root element is <argos-configuration>; it must be <ahss-config>\n");
  EXPECT_EQ(ErrorsOf("<ahss-config/>"), "test.xml:1:1: <ahss-config> lacks <arena>\n");
}

TEST(MistakesTogether, ThousandsAreCutShort)
{
  std::string text = "<ahss-config><arena size='1,1,1' optimization='2D'>";
  for (int i = 0; i < 1500; ++i) text += "<footbot/>\n";
  const LoadedExperiment loaded = LoadText(text + "</arena></ahss-config>");
  ASSERT_EQ(loaded.errors.size(), 1001U);
  EXPECT_EQ(loaded.errors.back().Text(), "test.xml: and 2000 more mistakes");
}

TEST(MistakesTogether, AMissingMapIsNamedWhereTheRunWillBe)
{
  const std::string text =
      "<ahss-config><arena size='1,1,1' optimization='3D'><terrain id='t'><octomap "
      "file='maps/none.bt'/></terrain></arena></ahss-config>";
  LoadOptions options;
  const LoadedExperiment here = LoadExperimentText(text, "test.xml", "/nowhere", options);
  ASSERT_EQ(here.errors.size(), 1U);
  EXPECT_EQ(here.errors[0].Text(), "test.xml:1:77: '/nowhere/maps/none.bt': there is no such file");
  options.check_files = false;
  EXPECT_TRUE(LoadExperimentText(text, "test.xml", "/nowhere", options).errors.empty());
}

// A block with more attributes, in a folder that does not exist.
std::string MistakeOfBlock(const std::string& more)
{
  const ExperimentText text{.size = "1,1,1",
                            .optimization = "3D",
                            .arena = "<block id='b' position='.5,.5,.5' size='.1,.1,.1' " + more + "/>",
                            .engines = ""};
  const LoadedExperiment loaded = LoadExperimentText(text.Text(), "test.xml", "/nowhere", {});
  return loaded.errors.empty() ? "none" : loaded.errors[0].Text();
}

TEST(MistakesTogether, AMeshThatCannotBeReadIsNamed)
{
  EXPECT_EQ(MistakeOfBlock("mesh='rock.glb'"), "test.xml:3:51: '/nowhere/rock.glb': there is no such file");
  EXPECT_EQ(MistakeOfBlock("mesh='rock.mesh'"),
            "test.xml:3:51: '/nowhere/rock.mesh': meshes are read from files that end in .glb, "
            ".gltf, .obj, .stl; export it as .glb, for example with Blender");
}

TEST(MistakesTogether, AHullThatCannotBeIsNamed)
{
  EXPECT_EQ(MistakeOfBlock("corners='0,0,0; 1,0,0; 0,1,0; 0,0,1'"), "none");
  EXPECT_EQ(MistakeOfBlock("corners='0,0,0; 1,0; 0,1,0; 0,0,1'"),
            "test.xml:3:51: corners are three numbers each, as in \"0, 0, 0; 1, 0, 0; …\"");
  EXPECT_EQ(MistakeOfBlock("corners='0,0,0; 1,0,0; 0,1,0'"), "test.xml:3:51: a body needs at least four corners");
  EXPECT_EQ(MistakeOfBlock("corners='0,0,0; 1,0,0; 0,1,0; 1,1,0'"), "test.xml:3:51: its corners lie in one plane");
  EXPECT_EQ(MistakeOfBlock("convex='true'"),
            "test.xml:3:51: it has no 'mesh' whose hull could collide; give it one, or its 'corners'");
}

TEST(MistakesTogether, AHullFillsItsBoxAndIsSharedByThoseThatAreAlike)
{
  const std::string block = "size='.2,.4,.6' corners='0,0,0; 9,0,0; 0,9,0; 0,0,9'/>";
  const ExperimentText text{
      .size = "1,1,1",
      .optimization = "3D",
      .arena = "<block id='a' position='.5,.5,.5' " + block + "<block id='b' position='.2,.2,.5' " + block,
      .engines = ""};
  const LoadedExperiment loaded = LoadExperimentText(text.Text(), "test.xml", "/nowhere", {});
  ASSERT_TRUE(loaded.experiment);
  const auto& hull = loaded.experiment->entities[0].hull;
  ASSERT_TRUE(hull);
  EXPECT_EQ(hull, loaded.experiment->entities[1].hull);
  EXPECT_NEAR(hull->volume, 0.048 / 6, 1e-12);
  EXPECT_LT((hull->centre - Vector3(-0.05, -0.1, -0.15)).norm(), 1e-12);
}

TEST(MistakesTogether, AHullThatCannotBeIsNamedWhereverItIsWanted)
{
  const std::string block = "' position='.5,.5,.5' size='.1,.1,.1' corners='0,0,0; 1,0,0; 0,1,0'/>";
  const ExperimentText text{
      .size = "1,1,1", .optimization = "3D", .arena = "<block id='a" + block + "<block id='b" + block, .engines = ""};
  EXPECT_EQ(LoadExperimentText(text.Text(), "test.xml", "/nowhere", {}).errors.size(), 2U);
}

TEST(MistakesTogether, AMissingFileIsNamed)
{
  const LoadedExperiment loaded = LoadExperimentFile("/nowhere/at_all.xml");
  ASSERT_EQ(loaded.errors.size(), 1U);
  EXPECT_EQ(loaded.errors[0].Text(), "/nowhere/at_all.xml: the file cannot be read: there is no such file");
}

}  // namespace
}  // namespace swarmanoid::test
