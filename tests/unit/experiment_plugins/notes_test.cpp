// The warnings of `swarmanoid check`, and start poses off a plane. The engines of this test stay registered.
#include "common/experiment/notes.h"

#include <gmock/gmock.h>

#include "common/plugins/catalogue.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid
{
namespace
{

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

PluginDescription Engine(const std::string& label)
{
  PluginDescription engine;
  engine.label = label;
  engine.any_kind = true;
  engine.entity_tags = {"footbot", "cylindric_prey", "block", "hole"};
  return engine;
}

LoadedExperiment Load(const std::string& arena, const std::string& engines, const std::string& lists)
{
  static const bool registered = []
  {
    PluginDescription plane = Engine("note_plane");
    plane.ignores = {"mass", "friction", "hole"};
    plane.parameters = {{.name = "perpendicular_axis",
                         .type = ParameterType::kChoice,
                         .default_value = "z",
                         .description = "axis",
                         .choices = {"x", "y", "z"}},
                        {.name = "distance", .unit = "m", .default_value = "0", .description = "distance"},
                        {.name = "tilt",
                         .type = ParameterType::kVector3,
                         .unit = "deg",
                         .default_value = "0, 0, 0",
                         .description = "tilt"}};
    PluginCatalogue::Instance().Add(PluginKind::kEngine, plane);
    PluginCatalogue::Instance().Add(PluginKind::kEngine, Engine("note_space"));
    return true;
  }();
  static_cast<void>(registered);
  const test::ExperimentText text{
      .size = "4,4,4", .optimization = "3D", .arena = arena, .engines = engines, .physics = lists};
  return LoadExperimentText(text.Text(), "n.xml", "/");
}

std::vector<std::string> NotesOf(const LoadedExperiment& loaded)
{
  std::vector<std::string> texts;
  for (const Diagnostic& error : loaded.errors) texts.push_back("error " + error.Text());
  if (loaded.experiment)
    for (const Diagnostic& note : NotesOn(*loaded.experiment)) texts.push_back(note.Text());
  return texts;
}

std::vector<std::string> ErrorsOf(const LoadedExperiment& loaded)
{
  std::vector<std::string> texts;
  for (const Diagnostic& error : loaded.errors) texts.push_back(error.Text());
  return texts;
}

const std::string kPlane = "<note_plane id='p'/>";
const std::string kSpace = "<note_space id='s'/>";
const std::string kAllInPlane = "<engine id='p'><all/></engine>";
const std::string kAllInSpace = "<engine id='s'><all/></engine>";

TEST(Notes, AParameterThatNoEngineUsesIsToldWhereItStands)
{
  const std::string preys =
      "<cylindric_prey id='a' position='1,1,0' mass='2'/>\n<cylindric_prey id='b' position='2,1,0'/>\n";
  EXPECT_THAT(
      NotesOf(Load(preys, kPlane, kAllInPlane)),
      ElementsAre(testing::AllOf(HasSubstr("n.xml:3:"), HasSubstr("the mass of the cylindric_prey 'a' has no effect: "
                                                                  "its engine 'p' (note_plane)"))));
  EXPECT_THAT(NotesOf(Load(preys, kSpace, kAllInSpace)), IsEmpty());
  EXPECT_THAT(NotesOf(Load(preys, kPlane + kSpace, kAllInPlane + kAllInSpace)), IsEmpty()) << "the other one uses it";
}

TEST(Notes, OneLineForAllOfAPlaceInTheFile)
{
  const std::string many =
      "<distribute quantity='5'><position method='uniform' min='1,1,0' max='3,3,0'/>"
      "<cylindric_prey id='a' mass='2'/></distribute>";
  EXPECT_EQ(NotesOf(Load(many, kPlane, kAllInPlane)).size(), 1U);
}

TEST(Notes, AHoleThatNothingFallsIntoIsTold)
{
  const std::string hole = "<hole id='h' position='2,2,0' radius='0.3'/>\n";
  EXPECT_THAT(NotesOf(Load(hole, kSpace, kAllInSpace)), IsEmpty());
  EXPECT_THAT(NotesOf(Load(hole, kPlane, kAllInPlane)), ElementsAre(HasSubstr("nothing can fall into the hole 'h'")));
  EXPECT_THAT(NotesOf(Load(hole, kSpace, "")), Contains(HasSubstr("nothing can fall into the hole 'h'")));
  EXPECT_THAT(NotesOf(Load(hole, kPlane + kSpace, kAllInPlane)),
              Contains(HasSubstr("nothing can fall into the hole 'h'")))
      << "the engine that knows holes does not have it";
}

TEST(Notes, RobotsWithoutAControllerAreCountedOnce)
{
  const auto robot = [](int number)
  { return "<footbot id='f" + std::to_string(number) + "' position='" + std::to_string(number) + ",1,0'/>\n"; };
  EXPECT_THAT(NotesOf(Load(robot(1), kSpace, kAllInSpace)),
              ElementsAre(HasSubstr("n.xml:3:1: the robot 'f1' has no controller, and does nothing by itself")));
  EXPECT_THAT(NotesOf(Load(robot(1) + robot(2), kSpace, kAllInSpace)),
              ElementsAre(HasSubstr("2 robots have no controller, and do nothing by themselves: f1, f2")));
  const std::string many =
      "<distribute quantity='5'><position method='uniform' min='1,1,0' max='3,3,0'/><footbot id='a'/></distribute>";
  EXPECT_THAT(NotesOf(Load(many, kSpace, kAllInSpace)), ElementsAre(HasSubstr("5 robots have no controller")));
  EXPECT_THAT(NotesOf(Load("", kSpace, kAllInSpace)), ElementsAre(HasSubstr("has no entities")));
}

TEST(Notes, AnEngineWithoutEntitiesIsTold)
{
  const std::string prey = "<cylindric_prey id='a' position='1,1,0'/>";
  EXPECT_THAT(NotesOf(Load(prey, kPlane + kSpace, kAllInSpace)),
              ElementsAre(HasSubstr("the engine 'p' (note_plane) has no entities; list some in <arena_physics>")));
}

TEST(StartPoses, RobotsStandOnThePlaneOfTheirEngine)
{
  const auto robot_at = [](const std::string& place) { return "<footbot id='f' position='" + place + "'/>\n"; };
  EXPECT_THAT(ErrorsOf(Load(robot_at("1,1,0.0005"), kPlane, kAllInPlane)), IsEmpty());
  EXPECT_THAT(ErrorsOf(Load(robot_at("1,1,0.5"), kPlane, kAllInPlane)),
              ElementsAre(testing::AllOf(HasSubstr("the footbot 'f' is 0.5 m off the plane of the engine 'p'"),
                                         HasSubstr("put it to 1, 1, 0, or move the plane"))));
  EXPECT_THAT(ErrorsOf(Load(robot_at("1,1,0.5"), kSpace, kAllInSpace)), IsEmpty());
  const std::string wall = "<note_plane id='p' perpendicular_axis='x' distance='0.2'/>";
  EXPECT_THAT(ErrorsOf(Load(robot_at("0.2,1,2"), wall, kAllInPlane)), IsEmpty());
  EXPECT_THAT(ErrorsOf(Load(robot_at("1,1,0"), wall, kAllInPlane)), ElementsAre(HasSubstr("put it to 0.2, 1, 0")));
  const std::string ceiling = "<note_plane id='p' distance='-3' tilt='180,0,0'/>";
  EXPECT_THAT(ErrorsOf(Load(robot_at("1,1,3"), ceiling, kAllInPlane)), IsEmpty());
  EXPECT_THAT(ErrorsOf(Load(robot_at("1,1,0"), ceiling, kAllInPlane)), ElementsAre(HasSubstr("put it to 1, 1, 3")));
  // Blocks keep their height, and a mirror follows its own engine.
  EXPECT_THAT(
      ErrorsOf(Load("<block id='b' position='1,1,0.1' size='0.1,0.1,0.2' movable='true'/>", kPlane, kAllInPlane)),
      IsEmpty());
  EXPECT_THAT(ErrorsOf(Load(robot_at("1,1,1"), kSpace + kPlane, kAllInSpace + kAllInPlane)), IsEmpty());
}

TEST(StartPoses, RobotsStandUprightOnALevelPlane)
{
  const auto turned_by = [](const std::string& orientation)
  { return "<footbot id='f' position='1,1,0' orientation='" + orientation + "'/>\n"; };
  EXPECT_THAT(ErrorsOf(Load(turned_by("0,0,70"), kPlane, kAllInPlane)), IsEmpty());
  EXPECT_THAT(ErrorsOf(Load(turned_by("0.01,0,0"), kPlane, kAllInPlane)), IsEmpty());
  EXPECT_THAT(ErrorsOf(Load(turned_by("90,0,0"), kPlane, kAllInPlane)),
              ElementsAre(testing::AllOf(HasSubstr("the footbot 'f' leans by 90 degrees; it must stand upright"),
                                         HasSubstr("engine 'p'"), HasSubstr("write the orientation 0, 0, 0"))));
  EXPECT_THAT(ErrorsOf(Load(turned_by("0,10,30"), kPlane, kAllInPlane)), ElementsAre(HasSubstr("leans by 10 degrees")));
  EXPECT_THAT(ErrorsOf(Load(turned_by("90,0,0"), kSpace, kAllInSpace)), IsEmpty());
  const std::string ceiling = "<note_plane id='p' distance='0' tilt='180,0,0'/>";
  EXPECT_THAT(ErrorsOf(Load(turned_by("180,0,0"), ceiling, kAllInPlane)), IsEmpty());
}

}  // namespace
}  // namespace swarmanoid
