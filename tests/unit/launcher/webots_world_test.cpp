// Worlds of Webots become bodies and lights: VRML with DEF and USE, frames, bounding objects, masses, and a note for
// each part that has no counterpart.
#include "launcher/worlds/webots_world.h"

#include <gmock/gmock.h>

#include "common/math/elementary.h"
#include "launcher/worlds/webots_file.h"
#include "test_folders.h"
#include "tests/unit/launcher/world_lines.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using test::LinesOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kWebotsFile = SWARMANOID_SOURCE_FOLDER "/tests/worlds/test.wbt";

World ReadWebots(const std::string& inside, const std::string& version = "R2023b")
{
  return ReadWebotsWorld("#VRML_SIM " + version + " utf8\n" + inside, kWebotsFile);
}

TEST(WebotsWorld, FramesFollowEachOther)
{
  const World world = ReadWebots(
      "Pose { translation 1 2 0 rotation 0 0 1 1.5707963267948966 children [\n"
      "  Solid { translation 0.5 0 0.25 name \"crate\" boundingObject Box { size 1 2 3 } } ] }");
  EXPECT_THAT(LinesOf(world.mistakes), IsEmpty());
  EXPECT_THAT(LinesOf(world.notes), IsEmpty());
  ASSERT_EQ(world.bodies.size(), 1U);
  const WorldBody& body = world.bodies[0];
  EXPECT_EQ(body.name, "crate");
  EXPECT_TRUE(body.pose.position.isApprox(Vector3(1, 2.5, 0.25), 1e-12));
  EXPECT_NEAR(YawOf(body.pose.orientation), kPi / 2, 1e-12);
  EXPECT_EQ(body.size, Vector3(1, 2, 3));
  EXPECT_FALSE(body.movable);
}

TEST(WebotsWorld, PhysicsMakesABodyMoveWithItsMassOrDensity)
{
  const auto mass_of = [](const std::string& physics, const std::string& shape)
  {
    const World world = ReadWebots("Solid { boundingObject " + shape + " physics Physics { " + physics + " } }");
    EXPECT_TRUE(world.bodies.at(0).movable);
    return world.bodies.at(0).mass_kg;
  };
  EXPECT_DOUBLE_EQ(mass_of("mass 0.3 density -1", "Box { size 1 1 1 }"), 0.3);
  EXPECT_DOUBLE_EQ(mass_of("density 500", "Box { size 0.1 0.2 0.5 }"), 5);
  EXPECT_DOUBLE_EQ(mass_of("", "Cylinder { radius 0.1 height 0.5 }"), 1000 * kPi * 0.01 * 0.5);
  EXPECT_NEAR(mass_of("density 8", "Mesh { url \"wedge.obj\" }"), 8 * 0.25, 1e-9) << "half of a box";
}

TEST(WebotsWorld, USERepeatsANode)
{
  const World world = ReadWebots(
      "DEF A Solid { translation 1 0 1 children [ DEF S Shape { appearance PBRAppearance { baseColor 1 0 0.2 } "
      "geometry "
      "Cylinder { radius 0.1 height 0.4 } } ] boundingObject USE S }\n"
      "Pose { translation 0 2 0 children [ USE A ] }");
  EXPECT_THAT(LinesOf(world.notes), IsEmpty());
  ASSERT_EQ(world.bodies.size(), 2U);
  EXPECT_EQ(world.bodies[1].form, WorldBody::Form::kCylinder);
  EXPECT_EQ(world.bodies[1].pose.position, Vector3(1, 2, 1));
  EXPECT_EQ(world.bodies[1].size, Vector3(0.1, 0.1, 0.4));
  EXPECT_EQ(world.bodies[1].colour, 0xff0033U);
  EXPECT_EQ(world.bodies[1].name, "A");
}

TEST(WebotsWorld, AnArenaHasWallsAroundItsFloor)
{
  const World world = ReadWebots("RectangleArena { translation 1 0 0 floorSize 3 2 wallThickness 0.1 wallHeight 0.4 }");
  EXPECT_THAT(LinesOf(world.notes), IsEmpty());
  ASSERT_EQ(world.bodies.size(), 4U);
  EXPECT_TRUE(world.bodies[0].pose.position.isApprox(Vector3(1 + 1.55, 0, 0.2)));
  EXPECT_TRUE(world.bodies[0].size.isApprox(Vector3(0.1, 2, 0.4)));
  EXPECT_TRUE(world.bodies[3].pose.position.isApprox(Vector3(1, -1.05, 0.2)));
  EXPECT_TRUE(world.bodies[3].size.isApprox(Vector3(3.2, 0.1, 0.4)));
}

TEST(WebotsWorld, BoxesAndWallsOfTheLibraryArePlacedByCentreAndBase)
{
  const World world = ReadWebots(
      "WoodenBox { translation 1 2 0.05 size 0.1 0.1 0.1 mass 0.4 }\nWoodenBox { }\n"
      "Wall { translation 3 0 0 size 0.2 2 1 }");
  EXPECT_THAT(LinesOf(world.notes), IsEmpty());
  ASSERT_EQ(world.bodies.size(), 3U);
  EXPECT_EQ(world.bodies[0].pose.position, Vector3(1, 2, 0.05));
  EXPECT_TRUE(world.bodies[0].movable);
  EXPECT_EQ(world.bodies[0].mass_kg, 0.4);
  EXPECT_FALSE(world.bodies[1].movable);
  EXPECT_EQ(world.bodies[1].size, Vector3(0.6, 0.6, 0.6));
  EXPECT_EQ(world.bodies[1].pose.position, Vector3(0, 0, 0.3));
  EXPECT_EQ(world.bodies[2].pose.position, Vector3(3, 0, 0.5));
}

TEST(WebotsWorld, ALightHasItsPlaceColourAndStrength)
{
  const World world =
      ReadWebots("Pose { translation 0 0 1 children [ PointLight { location 1 2 3 color 0 1 0 intensity 4 } ] }");
  ASSERT_EQ(world.lights.size(), 1U);
  EXPECT_EQ(world.lights[0].position, Vector3(1, 2, 4));
  EXPECT_EQ(world.lights[0].colour, 0x00ff00U);
  EXPECT_EQ(world.lights[0].intensity, 4);
}

TEST(WebotsWorld, NamesEachPartWithoutCounterpart)
{
  const World world = ReadWebots(
      "Viewpoint { position 1 2 3 }\n"                                                                      // 2
      "Robot { name \"walker\" }\n"                                                                         // 3
      "Solid { name \"ball\" boundingObject Sphere { } }\n"                                                 // 4
      "Solid { name \"two\" physics Physics { } boundingObject Group { children [ Box { } Box { } ] } }\n"  // 5
      "Solid { name \"seen\" children [ Shape { } ] }\n"                                                    // 6
      "Solid { contactMaterial \"ice\" children [ HingeJoint { } ] }\n"                                     // 7
      "Solid { name \"far\" boundingObject Mesh { url \"https://example.org/a.obj\" } }\n"                  // 8
      "WorldInfo { basicTimeStep 32 }\n"                                                                    // 9
      "Solid { name \"slope\" boundingObject Plane { } rotation 1 0 0 0.1 }\n"                              // 10
      "Solid { physics Physics { } children [ Solid { name \"arm\" boundingObject Box { } } ] }\n");        // 11
  EXPECT_THAT(LinesOf(world.mistakes), IsEmpty());
  EXPECT_THAT(world.bodies, IsEmpty());
  const auto notes = LinesOf(world.notes);
  EXPECT_THAT(notes, Contains("2:1: Viewpoint is left out: it has no counterpart"));
  EXPECT_THAT(notes, Contains(HasSubstr("3:1: Robot 'walker' is left out: it is a robot")));
  EXPECT_THAT(notes, Contains(HasSubstr("4:36: Sphere is left out: as a boundingObject")));
  EXPECT_THAT(notes, Contains(HasSubstr("5:1: Solid 'two' is left out: it moves and its boundingObject has 2 shapes")));
  EXPECT_THAT(notes, Contains(HasSubstr("6:1: Solid 'seen' is left out: it has no boundingObject")));
  EXPECT_THAT(notes, Contains(HasSubstr("7:9: contactMaterial of Solid has no counterpart")));
  EXPECT_THAT(notes, Contains(HasSubstr("HingeJoint is left out")));
  EXPECT_THAT(notes, Contains(HasSubstr("the mesh 'https://example.org/a.obj' of 'far' is left out")));
  EXPECT_THAT(notes, Contains(HasSubstr("basicTimeStep of WorldInfo has no counterpart")));
  EXPECT_THAT(notes, Contains(HasSubstr("10:37: Plane is left out: it is at the height 0 m")));
  EXPECT_THAT(notes, Contains(HasSubstr("Solid 'arm' is left out: it is a part of a Solid that moves")));
}

TEST(WebotsWorld, MistakesNameTheirPlace)
{
  const auto mistakes_of = [](const std::string& inside) { return LinesOf(ReadWebots(inside).mistakes); };
  EXPECT_THAT(mistakes_of("Solid { translation 1 2 }"),
              ElementsAre("2:9: translation of Solid is '1 2'; it must be 3 numbers"));
  EXPECT_THAT(mistakes_of("Solid { rotation 0 0 0 1 }"), ElementsAre(HasSubstr("an axis of length 0")));
  EXPECT_THAT(mistakes_of("Pose { scale 2 2 2 }"), ElementsAre(HasSubstr("scale of Pose is '2 2 2'")));
  EXPECT_THAT(mistakes_of("Solid { boundingObject Box { size 1 0 1 } }"),
              ElementsAre(HasSubstr("a length must be more")));
  EXPECT_THAT(mistakes_of("WorldInfo { coordinateSystem \"NUE\" }"), ElementsAre(HasSubstr("only worlds with z up")));
  EXPECT_THAT(mistakes_of("Solid { boundingObject Box { } physics Physics { density -1 } }"),
              ElementsAre(HasSubstr("neither a mass nor a density")));
  EXPECT_THAT(LinesOf(ReadWebots("", "R2021b").mistakes), ElementsAre(HasSubstr("the world is of Webots R2021b")));
  EXPECT_THAT(LinesOf(ReadWebots("", "V8.6").mistakes), ElementsAre(HasSubstr("the world is of Webots V8.6")));
}

TEST(WebotsFile, MistakesOfSyntaxNameTheirPlace)
{
  const auto mistake_of = [](const std::string& text)
  { return test::MessageOf<ConfigurationError>([&] { ReadWebotsFile(text, "w.wbt"); }); };
  EXPECT_EQ(mistake_of("Solid {"), "w.wbt:1:8: the end of the file instead of a field of Solid, or '}'");
  EXPECT_EQ(mistake_of("Solid\n}"), "w.wbt:2:1: '}' instead of '{' after 'Solid'");
  EXPECT_EQ(mistake_of("Solid { name }"), "w.wbt:1:14: '}' instead of a value of 'name'");
  EXPECT_EQ(mistake_of("Solid { name \"a"), "w.wbt:1:14: a text without a closing quote");
  EXPECT_EQ(mistake_of("Box { size 1 2x 3 }"), "w.wbt:1:14: '2x' is no number");
  EXPECT_EQ(mistake_of("Solid { children [ Solid { } "),
            "w.wbt:1:30: the end of the file within the list of 'children'");
  EXPECT_EQ(mistake_of("USE A"), "w.wbt:1:5: USE 'A': no DEF before it has this name");
  EXPECT_EQ(mistake_of("DEF A Solid { boundingObject USE A }"), "w.wbt:1:34: USE 'A': no DEF before it has this name");
  EXPECT_THAT(mistake_of("PROTO A [ ] { }"), HasSubstr("a PROTO in a world cannot be read"));
  EXPECT_THAT(mistake_of("Solid { name IS name }"), HasSubstr("IS belongs to a PROTO"));
  EXPECT_THAT(mistake_of("EXTERNPROTO x }"), HasSubstr("instead of the address of a PROTO"));
  std::string deep;
  for (int k = 0; k < 100; ++k) deep += "Group { children [ ";
  EXPECT_THAT(mistake_of(deep), HasSubstr("more than 64 nodes within each other"));
}

TEST(WebotsFile, NodesThatRepeatEachOtherAreBounded)
{
  // Each DEF uses the one before it ten times.
  std::string text = "DEF A0 Group { }\n";
  for (int k = 1; k < 20; ++k)
  {
    text += fmt::format("DEF A{} Group {{ children [", k);
    for (int i = 0; i < 10; ++i) text += fmt::format(" USE A{}", k - 1);
    text += " ] }\n";
  }
  EXPECT_THAT(test::MessageOf<ConfigurationError>([&] { ReadWebotsFile(text, "w.wbt"); }),
              HasSubstr("more than 2000000 nodes, with those of USE"));
}

TEST(WebotsFile, HiddenFieldsAndCommentsAreSkipped)
{
  const auto root = ReadWebotsFile(
      "#VRML_SIM R2023b utf8\nSolid { # a comment }\n hidden linearVelocity_0 1 2 3\n"
      " name \"a # b \\\" c\", children [ ] url [ \"x\" \"y\" ] locked TRUE physics NULL }",
      "w.wbt");
  ASSERT_EQ(root->children.size(), 1U);
  const ConfigurationNode& solid = *root->children[0];
  ASSERT_EQ(solid.attributes.size(), 4U);
  EXPECT_EQ(solid.attributes[0].value, "a # b \" c");
  EXPECT_EQ(solid.attributes[2].value, "x\ny");
  EXPECT_EQ(solid.attributes[3].value, "TRUE");
}

}  // namespace
}  // namespace swarmanoid
