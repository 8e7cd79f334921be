// Worlds in SDF become bodies and lights: poses in their frames, shapes, masses, and a note for each part that has no
// counterpart.
#include "launcher/worlds/sdf_world.h"

#include <gmock/gmock.h>

#include "common/configuration/xml_reader.h"
#include "common/math/elementary.h"
#include "test_folders.h"
#include "tests/unit/launcher/world_lines.h"

namespace swarmanoid
{
namespace
{

using test::LinesOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kSdfFile = SWARMANOID_SOURCE_FOLDER "/tests/worlds/test.sdf";

World ReadSdf(const std::string& inside)
{
  return ReadSdfWorld(*ReadXml("<sdf version='1.9'><world name='w'>\n" + inside + "</world></sdf>", kSdfFile),
                      kSdfFile);
}

std::string SdfBox(const std::string& size, const std::string& pose = "", const std::string& name = "c")
{
  return "<collision name='" + name + "'>" + pose + "<geometry><box><size>" + size +
         "</size></box></geometry></collision>";
}

std::string SdfModel(const std::string& inside, const std::string& name = "m")
{
  return "<model name='" + name + "'><static>true</static>" + inside + "</model>\n";
}

std::string SdfPose(const std::string& numbers, const std::string& attributes = "")
{
  return "<pose " + attributes + ">" + numbers + "</pose>";
}

std::string SdfLink(const std::string& inside, const std::string& name = "l")
{
  return "<link name='" + name + "'>" + inside + "</link>";
}

TEST(SdfWorld, PosesOfModelLinkAndCollisionFollowEachOther)
{
  // The model is turned by a quarter, so the link's x is the world's y.
  const World world = ReadSdf(SdfModel(SdfPose("1 2 0 0 0 1.5707963267948966") +
                                       SdfLink(SdfPose("0.5 0 0 0 0 0") + SdfBox("1 2 3", SdfPose("0 0 0.25 0 0 0")))));
  EXPECT_THAT(LinesOf(world.mistakes), IsEmpty());
  EXPECT_THAT(LinesOf(world.notes), IsEmpty());
  ASSERT_EQ(world.bodies.size(), 1U);
  const WorldBody& body = world.bodies[0];
  EXPECT_EQ(body.name, "m");
  EXPECT_TRUE(body.pose.position.isApprox(Vector3(1, 2.5, 0.25), 1e-12)) << body.pose.position.transpose();
  EXPECT_NEAR(YawOf(body.pose.orientation), kPi / 2, 1e-12);
  EXPECT_EQ(body.size, Vector3(1, 2, 3));
  EXPECT_FALSE(body.movable);
}

TEST(SdfWorld, PosesAreRelativeToNamedFrames)
{
  const auto place_of = [](const std::string& model)
  {
    const World world = ReadSdf(model);
    EXPECT_THAT(LinesOf(world.mistakes), IsEmpty());
    return world.bodies.empty() ? Vector3(Vector3::Constant(-1)) : Vector3(world.bodies.back().pose.position);
  };
  // another link, a frame that is attached to it, the model itself
  const std::string other = SdfLink(SdfPose("1 0 0 0 0 0"), "other");
  EXPECT_TRUE(place_of(SdfModel(other + SdfLink(SdfPose("0 1 0.5 0 0 0", "relative_to='other'") + SdfBox("1 1 1"))))
                  .isApprox(Vector3(1, 1, 0.5)));
  const std::string frame = "<frame name='f' attached_to='other'>" + SdfPose("0 0 2 0 0 0") + "</frame>";
  EXPECT_TRUE(place_of(SdfModel(other + frame + SdfLink(SdfBox("1 1 1", SdfPose("0 1 0 0 0 0", "relative_to='f'")))))
                  .isApprox(Vector3(1, 1, 2)));
  EXPECT_TRUE(place_of(SdfModel(SdfLink(SdfPose("5 5 5 0 0 0") +
                                        SdfBox("1 1 1", SdfPose("0 1 1 0 0 0", "relative_to='__model__'")))))
                  .isApprox(Vector3(0, 1, 1)));
  // a model beside another one, a frame of a nested model, a model that is placed by its link
  EXPECT_TRUE(place_of(SdfModel(SdfPose("3 0 0 0 0 0"), "a") +
                       SdfModel(SdfPose("0 0 1 0 0 0", "relative_to='a'") + SdfLink(SdfBox("1 1 1"))))
                  .isApprox(Vector3(3, 0, 1)));
  const std::string nested = SdfModel(SdfPose("0 4 0 0 0 0") + SdfLink(SdfPose("0 0 1 0 0 0"), "in"), "n");
  EXPECT_TRUE(place_of(SdfModel(nested + SdfLink(SdfPose("1 0 0 0 0 0", "relative_to='n::in'") + SdfBox("1 1 1"))))
                  .isApprox(Vector3(1, 4, 1)));
  EXPECT_TRUE(place_of("<model name='p' placement_frame='l'><static>true</static>" + SdfPose("1 1 1 0 0 0") +
                       SdfLink(SdfPose("0 0 0.5 0 0 0") + SdfBox("1 1 1")) + "</model>")
                  .isApprox(Vector3(1, 1, 1)));
}

TEST(SdfWorld, RotationsAreRadiansDegreesOrQuaternions)
{
  for (const std::string& pose :
       {SdfPose("0 0 1 0 0 0.5235987755982988"), SdfPose("0 0 1 0 0 30", "degrees='true'"),
        SdfPose("0 0 1 0 0 0.25881904510252074 0.9659258262890683", "rotation_format='quat_xyzw'")})
  {
    const World world = ReadSdf(SdfModel(pose + SdfLink(SdfBox("1 1 1"))));
    ASSERT_EQ(world.bodies.size(), 1U);
    EXPECT_NEAR(YawOf(world.bodies[0].pose.orientation), kPi / 6, 1e-9) << pose;
  }
}

TEST(SdfWorld, NestedModelsOfAStaticModelStandStill)
{
  const World world =
      ReadSdf(SdfModel("<model name='in'>" + SdfLink(SdfBox("1 1 1")) + "</model>") + "<model name='free'>" +
              SdfLink("<inertial><mass>2.5</mass></inertial>" + SdfBox("1 1 1")) + "</model>");
  ASSERT_EQ(world.bodies.size(), 2U);
  EXPECT_EQ(world.bodies[0].name, "m.in");
  EXPECT_FALSE(world.bodies[0].movable);
  EXPECT_TRUE(world.bodies[1].movable);
  EXPECT_DOUBLE_EQ(world.bodies[1].mass_kg, 2.5);
}

TEST(SdfWorld, ColourAndFrictionOfAShape)
{
  const World world = ReadSdf(SdfModel(SdfLink(
      "<collision name='c'><geometry><box><size>1 1 1</size></box></geometry><surface><friction><ode><mu>0.3</mu>"
      "<mu2>0.1</mu2></ode></friction><bounce><restitution_coefficient>0.5</restitution_coefficient></bounce></surface>"
      "</collision><visual name='v'><geometry><box><size>1 1 1</size></box></geometry><material><diffuse>1 0.5 0 1"
      "</diffuse></material></visual>")));
  ASSERT_EQ(world.bodies.size(), 1U);
  EXPECT_EQ(world.bodies[0].colour, 0xff8000U);
  EXPECT_EQ(world.bodies[0].friction, 0.3);
  EXPECT_EQ(world.bodies[0].restitution, 0.5);
  EXPECT_THAT(LinesOf(world.notes), ElementsAre(HasSubstr("<mu2> is left out")));
}

TEST(SdfWorld, AMeshIsPlacedByTheMiddleOfItsBox)
{
  const World world =
      ReadSdf(SdfModel(SdfPose("1 0 0 0 0 1.5707963267948966") +
                       SdfLink("<collision name='c'><geometry><mesh><uri>wedge.obj</uri><scale>2 1 1</scale></mesh>"
                               "</geometry></collision>")));
  EXPECT_THAT(LinesOf(world.mistakes), IsEmpty());
  ASSERT_EQ(world.bodies.size(), 1U);
  EXPECT_TRUE(world.bodies[0].size.isApprox(Vector3(2, 1, 0.5)));
  // (1, 0.5, 0.25) in the model becomes (-0.5, 1, 0.25) after the quarter turn.
  EXPECT_TRUE(world.bodies[0].pose.position.isApprox(Vector3(0.5, 1, 0.25), 1e-9));
  EXPECT_THAT(LinesOf(world.notes), ElementsAre(HasSubstr("convex hull")));
}

TEST(SdfWorld, NamesEachPartWithoutCounterpart)
{
  const World world = ReadSdf(
      "<include><uri>model://sun</uri></include>\n"                                      // 2
      "<light name='s' type='spot'/>\n"                                                  // 3
      "<model name='robot'><link name='a'/><joint name='j' type='revolute'/></model>\n"  // 4
      "<model name='two'><link name='a'>" +
      SdfBox("1 1 1") + SdfBox("1 1 2", "", "d") +
      "</link></model>\n"  // 5
      "<model name='ball'><link name='a'><collision "
      "name='c'><geometry><sphere/></geometry></collision></link></model>\n"   // 6
      "<model name='seen'><link name='a'><visual name='v'/></link></model>\n"  // 7
      + SdfModel(SdfLink("<collision name='c'><geometry><plane/></geometry>" + SdfPose("0 0 1 0 0 0") +
                         "</collision>"))  // 8
      + "<plugin name='p'/>\n"             // 9
      + SdfModel(SdfLink("<collision name='c'><geometry><mesh><uri>absent.stl</uri></mesh></geometry></collision>"),
                 "rock"));  // 10
  EXPECT_THAT(LinesOf(world.mistakes), IsEmpty());
  EXPECT_THAT(world.bodies, IsEmpty());
  const auto notes = LinesOf(world.notes);
  EXPECT_THAT(notes,
              Contains("2:1: <include> of 'model://sun' is left out: copy the <model> of that file into this one"));
  EXPECT_THAT(notes, Contains(HasSubstr("3:1: a light of type 'spot'")));
  EXPECT_THAT(notes, Contains("4:1: the model 'robot' is left out: it has joints, so it is a robot or a mechanism"));
  EXPECT_THAT(notes, Contains(HasSubstr("5:19: 'two' is left out: it moves and has 2 collision shapes")));
  EXPECT_THAT(notes, Contains(HasSubstr("a <sphere> has no counterpart")));
  EXPECT_THAT(notes, Contains(HasSubstr("7:20: 'seen' is left out: it has a <visual>, but no <collision>")));
  EXPECT_THAT(notes, Contains(HasSubstr("a <plane> at the height 1 m")));
  EXPECT_THAT(notes, Contains("9:1: <plugin> of <world> has no counterpart: it is left out"));
  EXPECT_THAT(notes, Contains(HasSubstr("the mesh 'absent.stl' of 'rock' is left out: it is not there")));
}

TEST(SdfWorld, LongChainsOfFramesAreRefused)
{
  std::string chain;
  for (int k = 0; k < 5'000; ++k) chain += fmt::format("<frame name='f{}'><pose relative_to='f{}'/></frame>", k, k + 1);
  const World world = ReadSdf(SdfModel(chain + SdfLink(SdfPose("0 0 0 0 0 0", "relative_to='f0'") + SdfBox("1 1 1"))));
  EXPECT_THAT(LinesOf(world.mistakes), Contains(HasSubstr("more than 1000 frames are relative to each other")));
}

TEST(SdfWorld, ValuesBeyondTheLimitsOfExperimentsAreMistakes)
{
  const auto mistakes_of = [](const std::string& inside) { return LinesOf(ReadSdf(inside).mistakes); };
  EXPECT_THAT(mistakes_of(SdfModel(SdfPose("1e300 0 0 0 0 0") + SdfLink(SdfBox("1 1 1")))),
              ElementsAre(HasSubstr("<pose> of <model> is farther away than 1e+06 m")));
  EXPECT_THAT(mistakes_of(SdfModel(SdfLink(SdfBox("1e9 1 1")))), ElementsAre(HasSubstr("at most 1e+06 m")));
  EXPECT_THAT(mistakes_of("<gravity>0 0 -1e5</gravity>"), ElementsAre(HasSubstr("the gravity is more than 1000 m/s2")));
}

TEST(SdfWorld, MistakesNameTheirPlace)
{
  const auto mistakes_of = [](const std::string& inside) { return LinesOf(ReadSdf(inside).mistakes); };
  EXPECT_THAT(mistakes_of(SdfModel(SdfLink(SdfBox("1 1")))),
              ElementsAre(HasSubstr("<size> of <box> is '1 1'; it must be 3 numbers")));
  EXPECT_THAT(mistakes_of(SdfModel(SdfLink(SdfBox("1 -1 1")))), ElementsAre(HasSubstr("a length must be more than 0")));
  EXPECT_THAT(mistakes_of(SdfModel(SdfLink(SdfBox("1 nan 1")))), ElementsAre(HasSubstr("it must be 3 numbers")));
  EXPECT_THAT(mistakes_of(SdfModel(SdfPose("1 2 3") + SdfLink(""))),
              ElementsAre(HasSubstr("<pose> of <model> is '1 2 3'; it must be 6")));
  EXPECT_THAT(mistakes_of(SdfModel(SdfPose("0 0 0 0 0 0 0", "rotation_format='quat_xyzw'"))),
              Contains(HasSubstr("length 0")));
  EXPECT_THAT(
      mistakes_of(SdfModel(SdfLink(SdfPose("0 0 0 0 0 0", "relative_to='lo'") + SdfBox("1 1 1")) + SdfLink("", "log"))),
      ElementsAre(HasSubstr("<model> has no frame 'lo'; it has: l, log; did you mean")));
  EXPECT_THAT(mistakes_of(SdfModel(SdfLink(SdfPose("0 0 0 0 0 0", "relative_to='b'") + SdfBox("1 1 1"), "a") +
                                   SdfLink(SdfPose("0 0 0 0 0 0", "relative_to='a'"), "b"))),
              Contains(HasSubstr("is relative to itself")));
  EXPECT_THAT(mistakes_of(SdfModel(SdfLink("") + SdfLink(""))), ElementsAre(HasSubstr("the name 'l' is there twice")));
  EXPECT_THAT(mistakes_of(SdfModel(SdfLink("<collision name='c'/>"))), ElementsAre(HasSubstr("has no <geometry>")));
  EXPECT_THAT(
      mistakes_of("<model name='m'>" + SdfLink("<inertial><mass>-1</mass></inertial>" + SdfBox("1 1 1")) + "</model>"),
      ElementsAre(HasSubstr("a mass is -1 kg")));
  EXPECT_THAT(LinesOf(ReadSdfWorld(*ReadXml("<sdf/>", kSdfFile), kSdfFile).mistakes),
              ElementsAre(HasSubstr("neither a <world>")));
}

}  // namespace
}  // namespace swarmanoid
