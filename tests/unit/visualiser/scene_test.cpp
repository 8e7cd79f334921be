// The items and marks of a scene, which all renderers with a camera draw.
#include "visualiser/scene/scene.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/unit/visualiser/small_world.h"
#include "visualiser/scene/material.h"

namespace swarmanoid
{
namespace
{

using Eigen::Vector3f;

void ExpectPlace(const Vector3f& a, const Vector3f& b, float tolerance = 1e-5F)
{
  EXPECT_LE((a - b).norm(), tolerance) << a.transpose() << " and " << b.transpose();
}

SceneOptions SceneWith(bool SceneOptions::*option, bool value = true)
{
  SceneOptions options;
  options.*option = value;
  return options;
}

SceneOptions Selecting(std::uint32_t entity)
{
  SceneOptions options;
  options.selected = entity;
  return options;
}

class SceneTest : public testing::Test
{
protected:
  SceneTest() : world_({4, 4, 2})
  {
    world_.Add(EntityKind::kFootbot, "fb", {1, 1, 0}, 90);
    world_.Add(EntityKind::kEyebot, "eb", {2, 2, 1.5});
    world_.Add(EntityKind::kHandbot, "hb", {3, 3, 0});
    world_.AddBody(EntityKind::kCylindricPrey, "prey", {3, 1, 0}, {0.1, 0.1, 0.2}, 0xff0000);
    world_.AddBody(EntityKind::kBlock, "block", {1, 3, 0.2}, {0.2, 0.6, 0.4});
  }
  Scene& Made()
  {
    if (scene_ == nullptr) scene_ = std::make_unique<Scene>(world_.Space());
    return *scene_;
  }
  const Scene& Updated(const SceneOptions& options = {})
  {
    Made().Update(options);
    return *scene_;
  }
  std::uint32_t Index(const std::string& id) { return world_[id].GetIndex(); }
  std::vector<SceneItem> ItemsOf(const std::string& id)
  {
    std::vector<SceneItem> items;
    for (const SceneItem& item : Updated().Items())
      if (item.entity == Index(id)) items.push_back(item);
    return items;
  }
  std::vector<SceneLine> LinesOf(Colour colour, const SceneOptions& options = {})
  {
    std::vector<SceneLine> lines;
    for (const SceneLine& line : Updated(options).Lines())
      if (line.colour == colour) lines.push_back(line);
    return lines;
  }

  SmallWorld world_;
  std::unique_ptr<Scene> scene_;
};

TEST_F(SceneTest, ALaserShinesDownToTheFloorOrTheFirstBody)
{
  EXPECT_TRUE(Updated().Lines().empty());
  world_.Set("eb", "laser", 1);
  const SceneLine beam = LinesOf(0xff0000).at(0);
  ExpectPlace(beam.from, {2, 2, 1.5F});
  ExpectPlace(beam.to, {2, 2, 0});
  EXPECT_EQ(beam.width, 2.5F);
  EXPECT_EQ(beam.opacity_from, 0.35F);
  EXPECT_EQ(beam.opacity_to, 0.8F);
  ASSERT_EQ(scene_->Glows().size(), 1U);
  ExpectPlace(scene_->Glows()[0].position, {2, 2, 0});
  EXPECT_EQ(scene_->Glows()[0].radius, 0.09F);
  EXPECT_EQ(scene_->Glows()[0].colour, 0xff0000U);
  EXPECT_TRUE(scene_->Glows()[0].flat);
  EXPECT_TRUE(Updated(SceneWith(&SceneOptions::beams, false)).Lines().empty());

  world_.Space().SetPose(Index("prey"), {{2, 2, 0}, Quaternion::Identity()});
  ExpectPlace(LinesOf(0xff0000).at(0).to, {2, 2, 0.2F});
  EXPECT_EQ(scene_->Glows().size(), 1U);
  world_.Space().SetPose(Index("prey"), {{3, 1, 0}, Quaternion::Identity()});
  world_.Set("eb", "laser_tilt", std::atan2(0.5, 1.5));
  world_.Set("eb", "laser_pan", kPi / 2);
  ExpectPlace(LinesOf(0xff0000).at(0).to, {2, 2.5F, 0});
  world_.Set("eb", "laser_tilt", kPi);
  ExpectPlace(LinesOf(0xff0000).at(0).to, {2, 2, 31.5F}, 1e-3F);
  EXPECT_TRUE(scene_->Glows().empty()) << "it meets nothing";
  world_.Set("eb", "laser_colour", 0);
  EXPECT_TRUE(Updated().Lines().empty());
}

TEST_F(SceneTest, ARopeHangsStraightFromTheCeiling)
{
  world_.Set("hb", "rope_attached", 1);
  ASSERT_EQ(Updated().Lines().size(), 1U);
  const SceneLine rope = scene_->Lines()[0];
  EXPECT_FLOAT_EQ(rope.from.z(), 0.16F);
  ExpectPlace(rope.to, {rope.from.x(), rope.from.y(), 2});
  EXPECT_LT((rope.from - Vector3f(3, 3, 0.16F)).norm(), 0.12F);
  EXPECT_EQ(rope.width, 2);
  EXPECT_EQ(rope.opacity_from, 1);
  EXPECT_FALSE(rope.on_top);
}

TEST_F(SceneTest, GripsAreShortLinesTowardsWhatIsHeld)
{
  world_.Set("fb", "gripped", 1 + Index("prey"));
  const SceneLine grip = LinesOf(palette::kSelection).at(0);
  EXPECT_NEAR((grip.to - grip.from).norm(), 0.035, 1e-5);
  EXPECT_GT((grip.to - grip.from).dot(Vector3f(2, 0, 0)), 0);
  EXPECT_FLOAT_EQ(grip.to.z(), grip.from.z());
  EXPECT_LT((grip.from - Vector3f(1, 1, 0)).norm(), 0.2F);
  EXPECT_EQ(grip.width, 4);
  world_.Set("fb", "gripped", 0);
  world_.Set("hb", "gripped", 1 + Index("block"), 0);
  world_.Set("hb", "gripped", 1 + Index("prey"), 1);
  const std::vector<SceneLine> hands = LinesOf(palette::kSelection);
  ASSERT_EQ(hands.size(), 2U);
  EXPECT_GT((hands[0].to - hands[0].from).dot(Vector3f(-2, 0, 0)), 0);
  EXPECT_GT((hands[1].to - hands[1].from).dot(Vector3f(0, -2, 0)), 0);
}

TEST_F(SceneTest, LightsGlowInTheirColourWhileTheyAreOn)
{
  world_.Add(EntityKind::kLightBulb, "light", {1, 2, 1});
  world_.Set("light", "colour", 0x102030);
  ASSERT_EQ(Updated().Glows().size(), 1U);
  ExpectPlace(scene_->Glows()[0].position, {1, 2, 1});
  EXPECT_EQ(scene_->Glows()[0].radius, 0.35F);
  EXPECT_EQ(scene_->Glows()[0].colour, 0x102030U);
  EXPECT_FALSE(scene_->Glows()[0].flat);
  world_.Set("light", "intensity", 0);
  EXPECT_TRUE(Updated().Glows().empty());
}

TEST_F(SceneTest, LabelsAreAboveWhatMovesAndAboveTheSelected)
{
  EXPECT_TRUE(Updated().Labels().empty());
  ASSERT_EQ(Updated(SceneWith(&SceneOptions::ids)).Labels().size(), 4U) << "the block cannot move";
  EXPECT_EQ(scene_->Labels()[0].text, "fb");
  EXPECT_EQ(scene_->Labels()[0].entity, Index("fb"));
  ExpectPlace(scene_->Labels()[0].position, {1, 1, 0.33F});
  EXPECT_EQ(scene_->Labels()[3].text, "prey");
  ExpectPlace(scene_->Labels()[3].position, {3, 1, 0.26F});
  const std::vector<std::string> names{"a", "b", "c", "d", "e"};
  SceneOptions named = SceneWith(&SceneOptions::ids);
  named.names = names;
  EXPECT_EQ(Updated(named).Labels()[1].text, "b");
  ASSERT_EQ(Updated(Selecting(Index("block"))).Labels().size(), 1U);
  EXPECT_EQ(scene_->Labels()[0].text, "block");
  world_.Space().SetAttribute(world_.Space().PresenceSlot(Index("fb")), 0);
  EXPECT_EQ(Updated(SceneWith(&SceneOptions::ids)).Labels().size(), 3U);
}

TEST_F(SceneTest, TheSelectedHasItsOutlineOverAllBodies)
{
  const auto box_of = [](const std::vector<SceneLine>& lines)
  {
    Eigen::AlignedBox3f box;
    for (const SceneLine& line : lines) box.extend(line.from).extend(line.to);
    return box;
  };
  const std::vector<SceneLine> block = LinesOf(palette::kSelection, Selecting(Index("block")));
  EXPECT_EQ(block.size(), 12U) << "the edges of a box";
  ExpectPlace(box_of(block).min(), {0.9F, 2.7F, 0});
  ExpectPlace(box_of(block).max(), {1.1F, 3.3F, 0.4F});
  EXPECT_EQ(block[0].width, 2.5F);
  EXPECT_EQ(block[0].opacity_from, 0.9F);
  EXPECT_TRUE(block[0].on_top);
  const std::vector<SceneLine> prey = LinesOf(palette::kSelection, Selecting(Index("prey")));
  EXPECT_EQ(prey.size(), 2U * 24 + 4) << "two circles and four lines between them";
  ExpectPlace(box_of(prey).min(), {2.9F, 0.9F, 0});
  ExpectPlace(box_of(prey).max(), {3.1F, 1.1F, 0.2F});
}

TEST_F(SceneTest, CollisionModelsAreThoseOfTheEngines)
{
  EXPECT_TRUE(LinesOf(palette::kCollision).empty());
  const std::vector<SceneLine> lines = LinesOf(palette::kCollision, SceneWith(&SceneOptions::collision_models));
  EXPECT_FALSE(lines.empty());
  const auto near = [&](const Vector3f& place, float reach)
  {
    return std::ranges::count_if(lines,
                                 [&](const SceneLine& line) { return (line.from - place).head<2>().norm() < reach; });
  };
  for (const Vector3f& place : {Vector3f(1, 1, 0), Vector3f(3, 1, 0), Vector3f(1, 3, 0), Vector3f(3, 3, 0)})
    EXPECT_GE(near(place, 0.5F), 12) << place.transpose();
  EXPECT_EQ(lines[0].width, 1.5F);
  EXPECT_TRUE(lines[0].on_top);
}

TEST_F(SceneTest, TrailsHaveThePlacesOfTheLastMetresAndFade)
{
  const SceneOptions options = SceneWith(&SceneOptions::trails);
  const Colour colour = LookOf(Material::kFootbot).colour;
  const auto go = [&](double x)
  {
    world_.Space().SetPose(Index("fb"), {{x, 1, 0}, Quaternion::Identity()});
    return LinesOf(colour, options);
  };
  EXPECT_TRUE(go(1).empty());
  EXPECT_TRUE(go(1.02).empty()) << "too near";
  ASSERT_EQ(go(1.04).size(), 1U);
  const std::vector<SceneLine> two = go(1.1);
  ASSERT_EQ(two.size(), 2U);
  ExpectPlace(two[0].from, {1.1F, 1, 0.012F});
  ExpectPlace(two[0].to, {1.04F, 1, 0.012F});
  ExpectPlace(two[1].to, {1, 1, 0.012F});
  EXPECT_EQ(two[0].width, 2);
  EXPECT_FLOAT_EQ(two[0].opacity_from, 0.75F);
  EXPECT_FLOAT_EQ(two[0].opacity_to, 0.75F * (1 - 1 / 160.0F));
  EXPECT_FLOAT_EQ(two[1].opacity_from, two[0].opacity_to);
  for (int step = 0; step < 200; ++step) go(1.2 + 0.04 * step);
  EXPECT_EQ(LinesOf(colour, options).size(), 159U) << "160 places";
  EXPECT_TRUE(LinesOf(colour).empty());
  world_.Space().SetAttribute(world_.Space().PresenceSlot(Index("fb")), 0);
  Updated(options);
  world_.Space().SetAttribute(world_.Space().PresenceSlot(Index("fb")), 1);
  EXPECT_TRUE(LinesOf(colour, options).empty()) << "it ended where the robot left the arena";
  go(1);
  EXPECT_EQ(go(2).size(), 2U);
  scene_->ForgetTrails();
  EXPECT_TRUE(LinesOf(colour, options).empty());
}

TEST_F(SceneTest, ATrailIsRecordedBetweenPicturesToo)
{
  Updated(SceneWith(&SceneOptions::trails));
  for (const double x : {1.1, 1.2, 1.3})
  {
    world_.Space().SetPose(Index("fb"), {{x, 1, 0}, Quaternion::Identity()});
    scene_->Track();
  }
  EXPECT_EQ(LinesOf(LookOf(Material::kFootbot).colour, SceneWith(&SceneOptions::trails)).size(), 3U);
}

TEST_F(SceneTest, RaysOfProximitySensorsHaveTheirRange)
{
  Experiment& experiment = world_.GetExperiment();
  test::AddController(experiment, "c", "c", {}, {"footbot_proximity"});
  experiment.controllers[0].sensors[0].type = "footbot_proximity";
  experiment.entities[0].controller = "c";
  EXPECT_TRUE(LinesOf(palette::kRayFree).empty());
  for (const SceneOptions& options : {SceneWith(&SceneOptions::rays), Selecting(0)})
  {
    const std::vector<SceneLine> rays = LinesOf(palette::kRayFree, options);
    EXPECT_EQ(rays.size(), 24U);
    for (const SceneLine& ray : rays)
    {
      EXPECT_NEAR((ray.to - ray.from).norm(), 0.1, 1e-5);
      EXPECT_FLOAT_EQ(ray.from.z(), 0.06F);
      EXPECT_EQ(ray.opacity_to, 0.7F);
    }
  }
}

TEST_F(SceneTest, ItemsStandWhereTheirEntitiesDo)
{
  const std::vector<SceneItem> footbot = ItemsOf("fb");
  ASSERT_EQ(footbot.size(), 4U) << "base, turret, two jaws";
  ExpectPlace(footbot[0].position, {1, 1, 0});
  EXPECT_NEAR(footbot[1].orientation.angularDistance(footbot[0].orientation), 0, 1e-3);
  world_.Set("fb", "turret_angle", 0.5);
  world_.Set("fb", "gripper_aperture", 0.25);
  const std::vector<SceneItem> turned = ItemsOf("fb");
  EXPECT_NEAR(turned[1].orientation.angularDistance(turned[0].orientation), 0.5, 1e-3);
  EXPECT_NEAR(turned[2].orientation.angularDistance(turned[1].orientation), 0.25, 1e-3);
  EXPECT_GT((turned[1].orientation * Vector3f::UnitX()).dot(Vector3f(-1, 0, 0)), 0) << "to the left";
  const SceneItem prey = ItemsOf("prey").at(0);
  ExpectPlace(prey.scale, {0.1F, 0.1F, 0.2F});
  EXPECT_EQ(prey.tint, Paint(0xff0000));
  EXPECT_EQ(prey.role, SceneItem::Role::kBody);
  EXPECT_TRUE(prey.present);
  world_.Set("prey", "colour", 0x00ff00);
  EXPECT_EQ(ItemsOf("prey").at(0).tint, Paint(0x00ff00));
  world_.Space().SetAttribute(world_.Space().PresenceSlot(Index("prey")), 0);
  EXPECT_FALSE(ItemsOf("prey").at(0).present);
  const SceneItem& floor = scene_->Items()[0];
  EXPECT_EQ(floor.entity, kNoEntity);
  EXPECT_EQ(floor.role, SceneItem::Role::kFloor);
  ExpectPlace(floor.position, {2, 2, 0});
  ExpectPlace(floor.scale, {4, 4, 1});
}

TEST_F(SceneTest, HandsOfAHandbotMoveWithHeadArmsWristsAndFingers)
{
  const std::vector<SceneItem> before = ItemsOf("hb");
  ASSERT_EQ(before.size(), 2U + 2 * 3) << "body, head, and an arm with two fingers on each side";
  const auto turn = [&](const char* attribute, int element)
  {
    world_.Set("hb", attribute, 0.3, element);
    const std::vector<SceneItem> after = ItemsOf("hb");
    world_.Set("hb", attribute, 0, element);
    std::string moved;
    for (std::size_t k = 0; k < after.size(); ++k)
      moved += after[k].orientation.angularDistance(before[k].orientation) > 0.01F ? '1' : '0';
    return moved;
  };
  EXPECT_EQ(turn("head_angle", 0), "01111111");
  EXPECT_EQ(turn("arm", 0), "00111000");
  EXPECT_EQ(turn("arm", 1), "00000111");
  EXPECT_EQ(turn("wrist", 0), "00011000");
  EXPECT_EQ(turn("wrist", 1), "00000011");
  EXPECT_EQ(turn("hand_aperture", 0), "00011000");
  EXPECT_EQ(turn("hand_aperture", 1), "00000011");
  EXPECT_GT(before[2].position.y(), before[5].position.y()) << "the left arm is on the left";
}

TEST_F(SceneTest, LightsOfARobotAreItsLedsAndItsBeacon)
{
  world_.Set("fb", "led", 0x112233, 5);
  world_.Set("fb", "beacon", 0x445566);
  const std::vector<SceneItem> items = ItemsOf("fb");
  const auto light = [&](int number) { return scene_->Lights()[static_cast<std::size_t>(items[0].lights + number)]; };
  EXPECT_EQ(light(5), 0x112233U);
  EXPECT_EQ(light(4), 0U);
  EXPECT_EQ(light(kBeaconLight), 0x445566U);
  for (const SceneItem& item : items) EXPECT_EQ(item.lights, items[0].lights);
  EXPECT_EQ(ItemsOf("prey").at(0).lights, -1);
}

TEST_F(SceneTest, AreasLieOnOneAnotherInTheOrderOfTheFile)
{
  world_.AddBody(EntityKind::kGroundPatch, "disc", {2, 2, 0}, {0.5, 0, 0}, 0x00ff00);
  world_.AddBody(EntityKind::kHole, "hole", {2, 2, 0}, {1, 0.5, 0});
  const SceneItem disc = ItemsOf("disc").at(0), hole = ItemsOf("hole").at(0);
  EXPECT_EQ(disc.role, SceneItem::Role::kPatch);
  ExpectPlace(disc.scale, {0.5F, 0.5F, 1});
  ExpectPlace(hole.scale, {1, 0.5F, 1});
  EXPECT_EQ(hole.tint, palette::kHole);
  EXPECT_NEAR(hole.position.z() - disc.position.z(), 0.0003, 1e-6);
  EXPECT_GE(disc.position.z(), 0);
}

TEST_F(SceneTest, WallsAtTheEdgeHaveARoleAndAPlainColourOfTheirOwn)
{
  world_.AddBody(EntityKind::kWall, "plain", {2, 0, 0.25}, {4, 0.1, 0.5}, 0xc0c0c0);
  world_.AddBody(EntityKind::kWall, "red", {2, 4, 0.25}, {4, 0.1, 0.5}, 0xff0000);
  world_.AddBody(EntityKind::kWall, "inside", {2, 2, 0.25}, {1, 0.1, 0.5}, 0xc0c0c0);
  world_.Set("red", "colour", 0xff0000);
  EXPECT_EQ(ItemsOf("plain").at(0).role, SceneItem::Role::kWall);
  EXPECT_EQ(ItemsOf("plain").at(0).tint, palette::kWall);
  EXPECT_EQ(ItemsOf("red").at(0).tint, Paint(0xff0000));
  EXPECT_EQ(ItemsOf("inside").at(0).role, SceneItem::Role::kBody);
  EXPECT_EQ(ItemsOf("inside").at(0).tint, Paint(0xc0c0c0));
}

TEST_F(SceneTest, BoundsHoldTheArenaAndAllBodiesThatAreInIt)
{
  Vector3 low, high;
  Updated().Bounds(low, high);
  EXPECT_LT(low.norm(), 0.01);
  EXPECT_EQ(high.x(), 4);
  EXPECT_GT(high.z(), 1.5) << "the eyebot";
  world_.Space().SetPose(Index("block"), {{5, -1, 0.2}, Quaternion::Identity()});
  Updated().Bounds(low, high);
  EXPECT_NEAR(low.y(), -1.3, 1e-5);
  EXPECT_NEAR(high.x(), 5.1, 1e-5);
  world_.Space().SetAttribute(world_.Space().PresenceSlot(Index("block")), 0);
  world_.Space().SetAttribute(world_.Space().PresenceSlot(Index("eb")), 0);
  Updated().Bounds(low, high);
  EXPECT_EQ(high.x(), 4);
  EXPECT_LT(high.z(), 1);
}

}  // namespace
}  // namespace swarmanoid
