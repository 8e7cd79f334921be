// The table of entity kinds: the required parts of a row, the derived ones, and the refused ones. Rows stay for the
// rest of a process. So these tests have a separate program, since those in unit/experiment list all kinds and engines.
#include "common/experiment/entity_kind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/experiment/load_experiment.h"
#include "common/math/elementary.h"
#include "tests/unit/engines/test_quadrotor.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

EntityKindDescription Robot(const std::string& tag)
{
  EntityKindDescription row;
  row.tag = tag;
  row.form = BodyForm::kCylinder;
  row.size = {0.05, 0.05, 0.1};
  return row;
}

EntityKindDescription Object(const std::string& tag, BodyForm form)
{
  EntityKindDescription row;
  row.tag = tag;
  row.role = EntityRole::kObject;
  row.form = form;
  return row;
}

std::vector<std::string> ParametersOf(EntityKind kind)
{
  std::vector<std::string> names;
  for (const ParameterSpec& parameter : DescriptionOf(kind).parameters) names.push_back(parameter.name);
  return names;
}

std::vector<std::string> AttributesOf(EntityKind kind)
{
  std::vector<std::string> names;
  for (const AttributeSpec& attribute : DescriptionOf(kind).attributes) names.emplace_back(attribute.name);
  return names;
}

// Returns the error message for a refused row.
std::string RefusalOf(EntityKindDescription row)
{
  return test::MessageOf<std::invalid_argument>([&] { RegisterEntityKind(std::move(row)); }, "it was taken");
}

TEST(EntityKinds, OfTheSimulatorAreFoundByAllTheirTags)
{
  EXPECT_EQ(KindOfTag("footbot"), EntityKind::kFootbot);
  EXPECT_EQ(KindOfTag("terrain"), EntityKind::kTerrain);
  EXPECT_EQ(KindOfTag("cyllindric_prej"), EntityKind::kCylindricPrey);
  EXPECT_EQ(KindOfTag("nest"), EntityKind::kGroundPatch);
  EXPECT_EQ(KindOfTag("submarine"), std::nullopt);
  for (std::size_t k = 0; k <= static_cast<std::size_t>(EntityKind::kChargingStation); ++k)
    EXPECT_EQ(KindOfTag(TagName(static_cast<EntityKind>(k))), static_cast<EntityKind>(k)) << "the order of the table";
  EXPECT_EQ(TableName(EntityKind::kCylindricPrey), "CylindricPrey");
}

TEST(EntityKinds, OfARobotWithAllDefaultsHaveAControllerAndNothingElse)
{
  RegisterEntityKind(Robot("plain_robot"));
  const auto kind = KindOfTag("plain_robot");
  ASSERT_TRUE(kind.has_value());
  EXPECT_FALSE(IsBuiltIn(*kind));
  EXPECT_TRUE(IsRobot(*kind));
  EXPECT_TRUE(HasBody(*kind));
  EXPECT_FALSE(IsFreeBox(*kind));
  EXPECT_TRUE(CanWait(*kind));
  EXPECT_THAT(ParametersOf(*kind), ElementsAre("controller"));
  EXPECT_THAT(AttributesOf(*kind), ElementsAre());
  EXPECT_EQ(TableName(*kind), "plain_robot");
  for (const char* device : {"wheels", "led_ring", "directional_leds", "proximity", "ground", "footbot_wheels"})
    EXPECT_FALSE(Carries(*kind, device)) << device;
}

TEST(EntityKinds, CarryTheDevicesOfTheirPartsAndThoseThatTheyName)
{
  EntityKindDescription row = Robot("equipped_robot");
  row.wheels = WheelDrive{0.05, 0.02, 0.2};
  row.leds = LedLayout{PlacesOnCircle(3, 0.05, 0), 0.05, false};
  row.beacon_height_m = 0.11;
  row.proximity = ProximityRing{{{{0.05, 0}, 0}}, 0.02, 0.1};
  row.ground_points = {{0.03, 0}};
  row.devices = {"compass"};
  row.attributes = {{"mood", 2, 1, "how it feels"}};
  RegisterEntityKind(row);
  const EntityKind kind = *KindOfTag("equipped_robot");
  for (const char* device : {"wheels", "led_ring", "directional_leds", "proximity", "ground", "compass"})
    EXPECT_TRUE(Carries(kind, device)) << device;
  EXPECT_THAT(AttributesOf(kind), ElementsAre("led", "beacon", "mood"));
  EXPECT_EQ(DescriptionOf(kind).attributes[0].count, 3);
}

TEST(EntityKinds, WithPropellersCarryTheDevicesOfFlight)
{
  RegisterEntityKind(test::QuadrotorRow("flying_robot"));
  const EntityKind kind = *KindOfTag("flying_robot");
  for (const char* device : {"eyebot_propellers", "eyebot_altitude", "eyebot_camera"})
    EXPECT_TRUE(Carries(kind, device)) << device;
  for (const char* device : {"eyebot_attachment", "eyebot_laser", "wheels"}) EXPECT_FALSE(Carries(kind, device));
  EXPECT_THAT(AttributesOf(kind), ElementsAre());
  EntityKindDescription row = test::QuadrotorRow("hanging_robot");
  row.propellers->magnet_reach_m = 0.02;
  RegisterEntityKind(row);
  EXPECT_TRUE(Carries(*KindOfTag("hanging_robot"), "eyebot_attachment"));
  EXPECT_THAT(AttributesOf(*KindOfTag("hanging_robot")), ElementsAre("attached"));
}

TEST(EntityKinds, ThatCannotFlyAreRefusedByName)
{
  const auto changed = [](auto change)
  {
    EntityKindDescription row = test::QuadrotorRow("wrong_quadrotor");
    change(row);
    return RefusalOf(std::move(row));
  };
  using Row = EntityKindDescription;
  EXPECT_THAT(changed([](Row& row) { row.mass_kg = 0; }), HasSubstr("needs a mass_kg"));
  EXPECT_THAT(changed([](Row& row) { row.wheels = WheelDrive{0.05, 0.02, 0.2}; }), HasSubstr("wheels or propellers"));
  EXPECT_THAT(changed([](Row& row) { row.propellers->inertia_kg_m2.z() = 1; }), HasSubstr("inertia_kg_m2"));
  EXPECT_THAT(changed([](Row& row) { row.propellers->centre_of_mass_m = 0.2; }), HasSubstr("centre_of_mass_m is 0.2"));
  EXPECT_THAT(changed([](Row& row) { row.propellers->tilt_rad_s = 0; }), HasSubstr("frequencies"));
  EXPECT_THAT(changed([](Row& row) { row.propellers->max_thrust_n = 1; }), HasSubstr("without rotors"));
  EXPECT_THAT(changed([](Row& row) { row.propellers->rotors.reset(); }), HasSubstr("0 N do not lift 0.03 kg"));
  EXPECT_THAT(changed([](Row& row) { row.propellers->rotors->max_thrust_n = 0.07; }),
              HasSubstr("4 rotors of 0.07 N do not lift 0.03 kg"));
  EXPECT_THAT(changed([](Row& row) { row.propellers->rotors->count = 3; }),
              HasSubstr("3 rotors; there may be 4 to 16"));
  EXPECT_THAT(changed([](Row& row) { row.propellers->rotors->thrust_of_speed.z() = 0; }), HasSubstr("thrust_of_speed"));
  EXPECT_THAT(changed([](Row& row) { row.propellers->rotors->drag.x() = -1; }), HasSubstr("drag of rotors"));
  EXPECT_THAT(changed([](Row& row) { row.propellers->drag_in_wind.x() = 1; }), HasSubstr("drag_in_wind"));
  EXPECT_THAT(changed([](Row& row) { row.solids = {SolidPart{}}; }), HasSubstr("a solid needs a size"));
  EXPECT_THAT(changed(
                  [](Row& row)
                  {
                    row.propellers.reset();
                    row.solids = {SolidPart{}};
                  }),
              HasSubstr("solids are for robots with propellers"));
}

TEST(EntityKinds, OfObjectsHaveTheParametersThatTheirBodyNeeds)
{
  EntityKindDescription crate = Object("test_crate", BodyForm::kBox);
  crate.mobility = Mobility::kIfAsked;
  RegisterEntityKind(crate);
  EXPECT_THAT(ParametersOf(*KindOfTag("test_crate")),
              ElementsAre("size", "movable", "mass", "friction", "restitution", "ground_friction", "ground_torque",
                          "colour", "mesh", "mesh_orientation", "convex", "corners"));
  EntityKindDescription pillar = Object("test_pillar", BodyForm::kCylinder);
  pillar.mobility = Mobility::kNever;
  RegisterEntityKind(pillar);
  EXPECT_THAT(ParametersOf(*KindOfTag("test_pillar")),
              ElementsAre("radius", "height", "friction", "restitution", "colour", "mesh", "mesh_orientation"));
  EXPECT_FALSE(CanWait(*KindOfTag("test_pillar")));
  EntityKindDescription ball = Object("test_drum", BodyForm::kCylinder);
  ball.size = {0.1, 0.1, 0.2};
  ball.colour = 0x102030;
  RegisterEntityKind(ball);
  EXPECT_THAT(ParametersOf(*KindOfTag("test_drum")),
              ElementsAre("mass", "friction", "restitution", "ground_friction", "ground_torque", "colour", "mesh",
                          "mesh_orientation"));
  EXPECT_EQ(DescriptionOf(*KindOfTag("test_drum")).parameters[5].default_value, "#102030");
  EXPECT_THAT(AttributesOf(*KindOfTag("test_drum")), ElementsAre("colour"));
}

TEST(EntityKinds, ThatContradictThemselvesAreRefusedByName)
{
  const auto changed = [](auto change)
  {
    EntityKindDescription row = Robot("wrong_robot");
    change(row);
    return RefusalOf(std::move(row));
  };
  using Row = EntityKindDescription;
  EXPECT_THAT(changed([](Row& row) { row.tag = "9lives"; }), HasSubstr("'9lives' has no good tag"));
  EXPECT_THAT(changed([](Row& row) { row.tag = "footbot"; }), HasSubstr("that the simulator knows already"));
  EXPECT_THAT(changed([](Row& row) { row.tag = "distribute"; }), HasSubstr("that the simulator knows already"));
  EXPECT_THAT(changed([](Row& row) { row.further_tags = {"nest"}; }), HasSubstr("cannot also be called 'nest'"));
  EXPECT_THAT(changed([](Row& row) { row.form = BodyForm::kNone; }), HasSubstr("needs a body"));
  EXPECT_THAT(changed([](Row& row) { row.size.setZero(); }), HasSubstr("a robot has a size"));
  EXPECT_THAT(changed([](Row& row) { row.size.z() = -1; }), HasSubstr("size is 0.05, 0.05, -1"));
  EXPECT_THAT(changed([](Row& row) { row.size.x() = 0.1; }), HasSubstr("radius, radius, height"));
  EXPECT_THAT(changed([](Row& row) { row.mobility = Mobility::kNever; }), HasSubstr("mobility kAlways"));
  EXPECT_THAT(changed([](Row& row) { row.origin = BodyOrigin::kCentre; }), HasSubstr("origin kCentre"));
  EXPECT_THAT(changed([](Row& row) { row.mass_kg = -1; }), HasSubstr("mass_kg is -1"));
  EXPECT_THAT(changed([](Row& row) { row.mechanism = Mechanism::kArms; }), HasSubstr("mechanisms and grippers"));
  EXPECT_THAT(changed([](Row& row) { row.wheels = WheelDrive{0.05, 0, 0.3}; }), HasSubstr("a radius of 0 m"));
  EXPECT_THAT(changed(
                  [](Row& row) {
                    row.leds = LedLayout{PlacesOnCircle(17, 0.05, 0), 0, false};
                  }),
              HasSubstr("17 LEDs; there may be 1 to 16"));
  EXPECT_THAT(changed(
                  [](Row& row) {
                    row.leds = LedLayout{PlacesOnCircle(4, 0.07, 0), 0, false};
                  }),
              HasSubstr("stands out of the body by more than 0.01 m"));
  for (const std::vector<Vector3>& directions :
       {std::vector<Vector3>{{1, 0, 0}}, std::vector<Vector3>{{1, 0, 0}, {0, 0, 0}}})
    EXPECT_THAT(changed(
                    [&](Row& row) {
                      row.leds = LedLayout{PlacesOnCircle(2, 0.05, 0), 0, false, directions};
                    }),
                HasSubstr("directions of 2 LEDs; there must be one for each, finite and not 0"));
  EXPECT_THAT(changed([](Row& row) { row.beacon_height_m = 0.1; }), HasSubstr("a beacon is for robots with LEDs"));
  EXPECT_THAT(changed([](Row& row) { row.proximity.emplace(); }), HasSubstr("0 proximity sensors"));
  EXPECT_THAT(changed([](Row& row) { row.mesh = {{.paint = MeshPart::Paint::kLed}}; }), HasSubstr("there are 0"));
  EXPECT_THAT(changed([](Row& row) { row.mesh = {{.form = MeshPart::Form::kFile}}; }), HasSubstr("needs a file"));
  EXPECT_THAT(changed([](Row& row) { row.attributes = {{"mood", 0, 0, ""}}; }), HasSubstr("'mood' has 0 slots"));
  EXPECT_THAT(changed(
                  [](Row& row) {
                    row.attributes = {{"a", 1, 0, ""}, {"a", 1, 0, ""}};
                  }),
              HasSubstr("'a' is there twice"));
  EXPECT_EQ(KindOfTag("wrong_robot"), std::nullopt);
  RegisterEntityKind(Robot("twin_robot"));
  EXPECT_THAT(RefusalOf(Robot("twin_robot")), HasSubstr("the entity kind 'twin_robot' is registered twice"));
}

// Another experiment of this process may have loaded its library; the other processes of this one would not know it.
TEST(EntityKinds, OfALibraryThatTheExperimentDoesNotNameAreRefused)
{
  RegisterEntityKind(Robot("unnamed_robot"));
  const std::string text =
      "<ahss-config>\n<framework/>\n<arena size='1,1,1' optimization='2D'>\n"
      "<unnamed_robot id='r' position='0.5, 0.5, 0'/>\n</arena></ahss-config>";
  const LoadedExperiment loaded = LoadExperimentText(text, "f.xml", "/experiments");
  ASSERT_EQ(loaded.errors.size(), 1U);
  EXPECT_EQ(loaded.errors[0].Text(),
            "f.xml:4:1: the kind <unnamed_robot> is of a user's library; name it as <entity_kinds><unnamed_robot "
            "library=\"…\"/></entity_kinds>");
}

}  // namespace
}  // namespace swarmanoid
