// Kinds of robots from URDF files: body, mass, wheels, mesh, and the messages about unreadable parts.
#include "common/experiment/urdf_kind.h"

#include <gmock/gmock.h>

#include "common/configuration/xml_reader.h"
#include "test_folders.h"

namespace swarmanoid
{
namespace
{

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string Wheel(const std::string& name, const std::string& y, const std::string& more = "",
                  const std::string& radius = "0.05", const std::string& x = "0.1")
{
  return "<link name='" + name + "'><collision><origin rpy='1.5707963267948966 0 0'/><geometry><cylinder radius='" +
         radius + "' length='0.02'/></geometry></collision></link>\n<joint name='" + name +
         "_joint' type='continuous'><parent link='base'/><child link='" + name + "'/><origin xyz='" + x + " " + y +
         " 0'/><axis xyz='0 1 0'/>" + more + "</joint>\n";
}

const std::string kWheels = Wheel("left", "0.15") + Wheel("right", "-0.15");

UrdfKind Read(const std::string& inside)
{
  return KindFromUrdf("cart", "<robot name='r'>\n" + inside + "</robot>", "r.urdf");
}

UrdfKind WithBase(const std::string& base, const std::string& wheels = kWheels, const std::string& more = "")
{
  return Read("<link name='base'>" + base + "</link>\n" + wheels + more);
}

std::string Box(const std::string& size, const std::string& origin = "", const char* element = "collision")
{
  return std::string("<") + element + ">" + origin + "<geometry><box size='" + size + "'/></geometry></" + element +
         ">";
}

std::vector<std::string> TextsOf(const std::vector<Diagnostic>& all)
{
  std::vector<std::string> texts;
  for (const Diagnostic& one : all) texts.push_back(one.location.Text() + ": " + one.message);
  return texts;
}

TEST(UrdfKind, HasItsOriginInTheMiddleOfTheAxleOnTheGround)
{
  // The axle is 0.1 m ahead of the root link and at its height: with 0.05 m of radius the ground is 0.05 m below it.
  const UrdfKind read =
      WithBase("<inertial><mass value='2.5'/></inertial>" + Box("0.2 0.4 0.1", "<origin xyz='0.1 0 0.05'/>") +
                   Box("0.1 0.1 0.1", "<origin xyz='0.3 0 0'/>", "visual"),
               Wheel("left", "0.15", "<limit velocity='8'/>") + Wheel("right", "-0.15", "<limit velocity='6'/>"));
  EXPECT_THAT(TextsOf(read.errors), IsEmpty());
  EXPECT_THAT(TextsOf(read.notes), IsEmpty());
  const EntityKindDescription& kind = read.kind;
  EXPECT_EQ(kind.tag, "cart");
  ASSERT_TRUE(kind.wheels.has_value());
  EXPECT_DOUBLE_EQ(kind.wheels->axle_m, 0.3);
  EXPECT_DOUBLE_EQ(kind.wheels->radius_m, 0.05);
  EXPECT_DOUBLE_EQ(kind.wheels->max_speed_m_s, 6 * 0.05);
  EXPECT_DOUBLE_EQ(kind.mass_kg, 2.5);
  EXPECT_EQ(kind.form, BodyForm::kBox);
  EXPECT_TRUE(kind.size.isApprox(Vector3(0.2, 0.4, 0.15), 1e-9)) << kind.size.transpose();
  ASSERT_EQ(kind.mesh.size(), 1U);
  EXPECT_TRUE(kind.mesh[0].from.isApprox(Vector3(0.15, -0.05, 0), 1e-9)) << kind.mesh[0].from.transpose();
  EXPECT_TRUE(kind.mesh[0].to.isApprox(Vector3(0.25, 0.05, 0.1), 1e-9)) << kind.mesh[0].to.transpose();
}

TEST(UrdfKind, OfAnUprightCylinderAboutTheAxleIsRound)
{
  const std::string body =
      "<collision><origin xyz='0.1 0 0.02'/><geometry><cylinder radius='0.2' length='0.1'/></geometry></collision>";
  EXPECT_EQ(WithBase(body).kind.form, BodyForm::kCylinder);
  EXPECT_TRUE(WithBase(body).kind.size.isApprox(Vector3(0.2, 0.2, 0.12), 1e-9));
  // Wheels that extend beyond the body collide, too.
  const UrdfKind wide = WithBase(body, Wheel("left", "0.25") + Wheel("right", "-0.25"));
  EXPECT_EQ(wide.kind.form, BodyForm::kBox);
  EXPECT_TRUE(wide.kind.size.isApprox(Vector3(0.4, 0.52, 0.12), 1e-9)) << wide.kind.size.transpose();
}

TEST(UrdfKind, HoldsAllShapesInABoxAboutTheAxleAndSaysSo)
{
  const UrdfKind read = WithBase(Box("0.4 0.2 0.1", "<origin xyz='0 0 0.05'/>"));
  // The body reaches from 0.3 m behind the axle to 0.1 m ahead of it.
  EXPECT_TRUE(read.kind.size.isApprox(Vector3(0.6, 0.32, 0.15), 1e-9)) << read.kind.size.transpose();
  EXPECT_THAT(
      TextsOf(read.notes),
      Contains(HasSubstr("r.urdf:1:1: its shapes are not about the middle of the axle; the body is the box of 0.6 x "
                         "0.32 m about it")));
}

TEST(UrdfKind, FollowsJointsAndTurns)
{
  // A post that hangs on a frame that is turned by a right angle: its way along x is to the left.
  const UrdfKind read = WithBase(
      Box("0.2 0.4 0.1", "<origin xyz='0.1 0 0.05'/>"), kWheels,
      "<link name='frame'/><joint name='f' type='fixed'><parent link='base'/><child link='frame'/><origin xyz='0.1 0 "
      "0.2' "
      "rpy='0 0 1.5707963267948966'/></joint><link name='post'><visual><geometry><cylinder radius='0.01' length='0.1'/>"
      "</geometry></visual></link><joint name='p' type='fixed'><parent link='frame'/><child link='post'/><origin "
      "xyz='0.05 "
      "0 0'/></joint>");
  EXPECT_THAT(TextsOf(read.errors), IsEmpty());
  ASSERT_EQ(read.kind.mesh.size(), 1U);
  EXPECT_EQ(read.kind.mesh[0].form, MeshPart::Form::kRod);
  EXPECT_TRUE(read.kind.mesh[0].from.isApprox(Vector3(0, 0.05, 0.2), 1e-9)) << read.kind.mesh[0].from.transpose();
  EXPECT_TRUE(read.kind.mesh[0].to.isApprox(Vector3(0, 0.05, 0.3), 1e-9)) << read.kind.mesh[0].to.transpose();
}

TEST(UrdfKind, NotesWhatHasNoEffect)
{
  const std::string body = Box("0.2 0.4 0.1", "<origin xyz='0.1 0 0.05'/>");
  const std::string limited = Wheel("left", "0.15", "<limit velocity='8'/>") + Wheel("right", "-0.15");
  const std::string mass = "<inertial><mass value='1'/></inertial>";
  const auto notes = [&](const std::string& in_base, const std::string& more)
  { return TextsOf(WithBase(mass + body + in_base, limited, more).notes); };
  EXPECT_THAT(notes("", "<gazebo/>"), ElementsAre("r.urdf:7:1: <gazebo> has no effect here"));
  EXPECT_THAT(notes("<visual><geometry><mesh filename='a.stl'/></geometry></visual>", ""),
              ElementsAre(HasSubstr("the mesh 'a.stl' is not drawn: it is not there")));
  EXPECT_THAT(notes("<visual><geometry><mesh filename='package://none/a.stl'/></geometry></visual>", ""),
              ElementsAre(HasSubstr("package://NAME/… is looked for in the folder NAME beside or above this file")));
  EXPECT_THAT(
      notes("", "<link name='arm'/><joint name='a' type='revolute'><parent link='base'/><child link='arm'/></joint>"),
      ElementsAre(HasSubstr("the joint 'a' (revolute) has no effort in its <limit>: on a robot with driven wheels it "
                            "stands still at zero")));
  EXPECT_THAT(notes(Box("0.1 0.1 0.1", "<origin rpy='0 0 0.5'/>", "visual"), ""),
              ElementsAre(HasSubstr("a box that is turned is drawn as the upright one")));
  EXPECT_THAT(TextsOf(WithBase(body).notes),
              ElementsAre(HasSubstr("no <limit velocity="), HasSubstr("no link has a mass")));
}

TEST(UrdfKind, IsDrawnAsItsMeshesWhereItsLinksAre)
{
  const std::string folder = SWARMANOID_SOURCE_FOLDER "/configs/urdf";
  const std::vector<std::string> names{"scout.glb", "../urdf/scout.glb", "package://urdf/scout.glb",
                                       "package://configs/urdf/scout.glb", "file://" + folder + "/scout.glb"};
  for (const std::string& name : names)
  {
    const std::string visual =
        "<visual><origin xyz='0.1 0 0.2' rpy='0 0 1.5707963267948966'/><geometry><mesh filename='" + name +
        "' scale='1 2 3'/></geometry><material name='m'><color rgba='1 0 0 1'/></material></visual>";
    const UrdfKind read =
        KindFromUrdf("cart",
                     "<robot name='r'><link name='base'><inertial><mass value='1'/></inertial>" + visual +
                         Box("0.2 0.4 0.1", "<origin xyz='0.1 0 0.05'/>") + "</link>" + kWheels + "</robot>",
                     folder + "/r.urdf");
    EXPECT_THAT(TextsOf(read.errors), IsEmpty()) << name;
    ASSERT_EQ(read.kind.mesh.size(), 1U) << name;
    const MeshPart& part = read.kind.mesh[0];
    EXPECT_EQ(part.form, MeshPart::Form::kFile);
    EXPECT_EQ(part.file, folder + "/scout.glb");
    EXPECT_TRUE(part.from.isApprox(Vector3(0, 0, 0.25), 1e-9)) << part.from.transpose();
    EXPECT_TRUE(part.scale.isApprox(Vector3(1, 2, 3)));
    EXPECT_NEAR((part.orientation * Vector3::UnitX()).y(), 1, 1e-9);
    EXPECT_EQ(read.kind.colour, 0xff0000U);
  }
}

TEST(UrdfKind, PartsHaveTheirOwnColours)
{
  const auto visual = [](const std::string& colour)
  {
    return "<visual><geometry><sphere radius='0.1'/></geometry><material name='" + colour + "'><color rgba='" + colour +
           " 1'/></material></visual>";
  };
  const UrdfKind read = WithBase(Box("0.2 0.4 0.1") + visual("0 1 0") + visual("0 0 1"));
  ASSERT_EQ(read.kind.mesh.size(), 2U);
  EXPECT_EQ(read.kind.colour, 0x00ff00U);
  EXPECT_EQ(read.kind.mesh[0].paint, MeshPart::Paint::kBody);
  EXPECT_EQ(read.kind.mesh[1].paint, MeshPart::Paint::kOwn);
  EXPECT_EQ(read.kind.mesh[1].colour, 0x0000ffU);
}

TEST(UrdfKind, HasLinksOnTheJointsThatAreNotItsWheels)
{
  const std::string inertial =
      "<inertial><origin xyz='0.1 0 0'/><mass value='0.3'/><inertia ixx='0.001' ixy='0' ixz='0' iyy='0.002' iyz='0' "
      "izz='0.003'/></inertial>";
  const std::string limit = "<limit lower='0.2' upper='0.9' effort='2' velocity='3'/><dynamics damping='0.1'/>";
  // An arm on a post that is turned to the left, and a finger fixed at its end.
  const UrdfKind read = WithBase(
      "<inertial><mass value='2'/></inertial>" + Box("0.2 0.4 0.1", "<origin xyz='0.1 0 0.05'/>"), kWheels,
      "<link name='post'/><joint name='p' type='fixed'><parent link='base'/><child link='post'/><origin xyz='0.1 0 "
      "0.2' "
      "rpy='0 0 1.5707963267948966'/></joint><link name='arm'>" +
          inertial + Box("0.2 0.02 0.02", "<origin xyz='0.1 0 0'/>") +
          "</link><joint name='shoulder' type='revolute'><parent link='post'/><child link='arm'/><axis xyz='0 2 0'/>" +
          limit + "</joint><link name='finger'>" + inertial +
          "</link><joint name='f' type='fixed'><parent link='arm'/><child link='finger'/><origin xyz='0.2 0 "
          "0'/></joint>");
  EXPECT_THAT(TextsOf(read.errors), IsEmpty());
  ASSERT_EQ(read.kind.links.size(), 1U);
  EXPECT_FALSE(read.kind.base.has_value());
  EXPECT_TRUE(read.kind.size.isApprox(Vector3(0.2, 0.4, 0.15), 1e-9)) << "without the arm";
  const MovingLink& arm = read.kind.links[0];
  EXPECT_EQ(arm.joint, "shoulder");
  EXPECT_EQ(arm.attribute, "joint_shoulder");
  EXPECT_EQ(arm.parent, MovingLink::kBase);
  EXPECT_FALSE(arm.slides);
  EXPECT_TRUE(arm.anchor.isApprox(Vector3(0, 0, 0.25), 1e-9)) << arm.anchor.transpose();
  EXPECT_TRUE(arm.axis.isApprox(Vector3(-1, 0, 0), 1e-9)) << arm.axis.transpose();
  EXPECT_EQ(arm.lowest, 0.2);
  EXPECT_EQ(arm.Start(), 0.2);
  EXPECT_EQ(arm.highest, 0.9);
  EXPECT_EQ(arm.effort, 2);
  EXPECT_EQ(arm.max_speed, 3);
  EXPECT_EQ(arm.damping, 0.1);
  // Arm and finger: 0.1 and 0.3 m along the arm, which points to the left.
  EXPECT_DOUBLE_EQ(arm.body.mass_kg, 0.6);
  EXPECT_TRUE(arm.body.centre_of_mass.isApprox(Vector3(0, 0.2, 0.25), 1e-9)) << arm.body.centre_of_mass.transpose();
  const Vector3 moments(2 * 0.002 + 0.6 * 0.01, 2 * 0.001, 2 * 0.003 + 0.6 * 0.01);
  EXPECT_TRUE(arm.body.inertia.isApprox(Eigen::Matrix3d(moments.asDiagonal()), 1e-9)) << arm.body.inertia;
  ASSERT_EQ(arm.body.shapes.size(), 1U);
  EXPECT_TRUE(arm.body.shapes[0].pose.position.isApprox(Vector3(0, 0.1, 0.25), 1e-9));
}

TEST(UrdfKind, StandsOnItsLinksWithoutDrivenWheels)
{
  const std::string inertial = "<inertial><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.01'/></inertial>";
  const std::string leg = "<link name='leg'>" + inertial + Box("0.02 0.02 0.3", "<origin xyz='0 0 -0.15'/>") +
                          "</link><link name='foot'>" + inertial + "</link>";
  const std::string joints =
      "<joint name='toe' type='continuous'><parent link='leg'/><child link='foot'/><origin xyz='0 0 -0.3'/><axis "
      "xyz='0 1 "
      "0'/></joint><joint name='knee' type='prismatic'><parent link='body'/><child link='leg'/><origin xyz='0.1 0 0'/>"
      "<axis xyz='0 0 1'/><limit lower='0.1' upper='0.2' effort='5' velocity='1'/></joint>";
  const UrdfKind read = Read("<link name='body'>" + inertial + Box("0.4 0.2 0.1") + "</link>" + leg + joints);
  EXPECT_THAT(TextsOf(read.errors), IsEmpty());
  const EntityKindDescription& kind = read.kind;
  ASSERT_TRUE(kind.base.has_value());
  EXPECT_FALSE(kind.wheels.has_value());
  // The leg starts 0.1 m up: it reaches from 0.2 m below the frame of the body to 0.1 m above it.
  EXPECT_TRUE(kind.size.isApprox(Vector3(0.4, 0.2, 0.3), 1e-9)) << kind.size.transpose();
  EXPECT_TRUE(kind.base->centre_of_mass.isApprox(Vector3(0, 0, 0.2), 1e-9)) << kind.base->centre_of_mass.transpose();
  // A joint comes after the one that carries it.
  ASSERT_EQ(kind.links.size(), 2U);
  EXPECT_EQ(kind.links[0].joint, "knee");
  EXPECT_TRUE(kind.links[0].slides);
  EXPECT_EQ(kind.links[1].joint, "toe");
  EXPECT_EQ(kind.links[1].parent, 0);
  EXPECT_EQ(kind.links[1].effort, 0);
  EXPECT_TRUE(kind.links[1].IsEndless());
}

TEST(UrdfKind, RefusesJointsThatCannotMove)
{
  const std::string good = "<inertial><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.01'/></inertial>";
  const auto refusal = [&](const std::string& type, const std::string& more, const std::string& inertial,
                           const std::string& name = "hip")
  {
    const UrdfKind read = Read("<link name='body'>" + good + Box("0.4 0.2 0.1") + "</link>\n<link name='leg'>" +
                               inertial + "</link>\n<joint name='" + name + "' type='" + type +
                               "'><parent link='body'/><child link='leg'/>" + more + "</joint>\n");
    const std::vector<std::string> texts = TextsOf(read.errors);
    return texts.empty() ? std::string("none") : texts.front();
  };
  const std::string limit = "<limit lower='-1' upper='1' effort='2' velocity='3'/>";
  EXPECT_EQ(refusal("revolute", limit, good), "none");
  EXPECT_EQ(refusal("continuous", "", good), "none");
  EXPECT_THAT(
      refusal("revolute", "", good),
      HasSubstr("r.urdf:4:1: the joint 'hip' (revolute) needs a <limit> with lower, upper, effort and velocity"));
  EXPECT_THAT(
      refusal("prismatic", "<limit lower='0' upper='1' velocity='3'/>", good),
      HasSubstr("the <limit> of the joint 'hip' needs an 'effort' of 0 or more, and a 'velocity' of more than 0"));
  EXPECT_THAT(refusal("revolute", "<limit lower='0' upper='1' effort='2' velocity='0'/>", good),
              HasSubstr("unless the effort is 0"));
  EXPECT_THAT(refusal("revolute", "<limit effort='2' velocity='3'/>", good),
              HasSubstr("goes from 0 to 0; 'lower' must be less than 'upper'"));
  EXPECT_THAT(refusal("revolute", "<limit lower='-4' upper='1' effort='2' velocity='3'/>", good),
              HasSubstr("goes from -4 to 1 rad; it must be within -3.12 and 3.12, or the joint continuous"));
  EXPECT_THAT(
      refusal("revolute", limit, ""),
      HasSubstr("r.urdf:3:1: the link 'leg' moves by the joint 'hip' and needs an <inertial> with a <mass> of more"));
  EXPECT_THAT(refusal("revolute", limit, "<inertial><mass value='1'/></inertial>"),
              HasSubstr("the link 'leg' moves by the joint 'hip' and needs an <inertia>"));
  EXPECT_THAT(
      refusal("revolute", limit, "<inertial><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.05'/></inertial>"),
      HasSubstr("has the principal moments 0.01, 0.01 and 0.05 kg m²"));
  EXPECT_THAT(refusal("revolute", limit + "<mimic joint='other'/>", good), HasSubstr("follows another one by <mimic>"));
  EXPECT_THAT(refusal("revolute", limit + "<dynamics damping='-1'/>", good), HasSubstr("must be at least 0"));
  EXPECT_THAT(refusal("floating", "", good), HasSubstr("is of type floating, which no engine moves"));
  EXPECT_THAT(refusal("planar", "", good), HasSubstr("is of type planar"));
  EXPECT_THAT(refusal("revolute", limit, good, "a b"), HasSubstr("its name consists of 1 to 64 letters"));
}

TEST(UrdfKind, RefusesWithThePlaceInTheFile)
{
  const std::string body = Box("0.2 0.4 0.1", "<origin xyz='0.1 0 0.05'/>");
  const auto refusal = [](const UrdfKind& read)
  {
    const std::vector<std::string> texts = TextsOf(read.errors);
    return texts.empty() ? std::string("none") : texts.front();
  };
  EXPECT_THAT(
      refusal(WithBase(body, Wheel("left", "0.15"))),
      HasSubstr("r.urdf:1:1: a robot has two driven wheels, which are continuous joints about y; this one has 1: "));
  EXPECT_THAT(refusal(WithBase(body, kWheels + Wheel("third", "0"))), HasSubstr("this one has 3: "));
  EXPECT_THAT(refusal(WithBase(body, Wheel("left", "0.15") + Wheel("right", "-0.15", "", "0.04"))),
              HasSubstr("the wheels have radii of 0.05 and 0.04 m; they must be equal"));
  EXPECT_THAT(refusal(WithBase(body, Wheel("left", "0.15") + Wheel("right", "-0.15", "", "0.05", "0.2"))),
              HasSubstr("must face each other"));
  EXPECT_THAT(refusal(WithBase("")), HasSubstr("it needs a <collision>"));
  EXPECT_THAT(refusal(WithBase("<collision><geometry><mesh filename='a.stl'/></geometry></collision>")),
              HasSubstr("r.urdf:2:40: the mesh 'a.stl': it is not there"));
  EXPECT_THAT(refusal(WithBase("<collision><geometry><capsule radius='1'/></geometry></collision>")),
              HasSubstr("r.urdf:2:40: <capsule> cannot be read; boxes, cylinders, spheres and meshes can"));
  EXPECT_THAT(refusal(WithBase(Box("0.2 0.4"))), HasSubstr("'size' of <box> is '0.2 0.4'; it must be 3 numbers"));
  EXPECT_THAT(refusal(WithBase(Box("0.2 -0.4 1"))), HasSubstr("needs a 'size' of three lengths of more than 0"));
  EXPECT_THAT(refusal(WithBase(body, kWheels, "<link name='base'/>")), HasSubstr("the link 'base' is there twice"));
  EXPECT_THAT(refusal(WithBase(body, kWheels, "<link name='loose'/>")),
              HasSubstr("several links that hang on no joint"));
  EXPECT_THAT(refusal(WithBase(body, kWheels, "<joint name='j' type='hinge'/>")),
              HasSubstr("is of type 'hinge'; the types are "));
  EXPECT_THAT(
      refusal(WithBase(body, kWheels, "<joint name='j' type='fixed'><parent link='base'/><child link='top'/></joint>")),
      HasSubstr("the joint 'j' names the link 'top', which is not there"));
  EXPECT_THAT(refusal(WithBase(body, kWheels, "<xacro:include/>")), HasSubstr("is of xacro; make a URDF file of it"));
  EXPECT_THAT(refusal(KindFromUrdf("cart", "<sdf/>", "r.urdf")), HasSubstr("begins with <robot>, not with <sdf>"));
  EXPECT_THAT(refusal(KindFromUrdf("cart", "<robot>", "r.urdf")), HasSubstr("r.urdf:1:"));
}

}  // namespace
}  // namespace swarmanoid
