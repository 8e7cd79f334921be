#include "visualiser/scene/picking.h"

#include <gtest/gtest.h>

#include "tests/unit/visualiser/small_world.h"
#include "visualiser/scene/scene.h"

namespace swarmanoid
{
namespace
{

SmallWorld TwoRobotsAndAWall()
{
  SmallWorld world({4, 4, 2});
  world.Add(EntityKind::kFootbot, "near", {2, 1, 0});
  world.Add(EntityKind::kFootbot, "far", {2, 3, 0});
  world.Add(EntityKind::kEyebot, "above", {1, 2, 1});
  world.AddBody(EntityKind::kWall, "south", {2, 0, 0.5}, {4, 0.1, 1});
  world.AddBody(EntityKind::kGroundPatch, "nest", {3, 3, 0}, {1, 1, 0});
  world.Space();
  return world;
}

TEST(Picking, ClickOnAPixelMeetsTheEntityThatIsDrawnThere)
{
  SmallWorld world = TwoRobotsAndAWall();
  const Camera camera = Camera::LookAt({2.3, -2, 2}, {2, 2, 0});
  for (const char* id : {"near", "far", "above"})
  {
    const CSwarmanoidSpaceEntity& entity = world[id];
    const Vector3 pixel = camera.Project(entity.GetPosition() + Vector3(0, 0, entity.GetSize().z() / 2), 800, 600);
    const auto pick = PickEntity(world.Space(), camera.RayThrough(pixel.x(), pixel.y(), 800, 600));
    ASSERT_TRUE(pick.has_value()) << id;
    EXPECT_EQ(world.Space().GetEntity(pick->entity).GetId(), id);
    EXPECT_NEAR((pick->point - entity.GetPosition()).norm(), entity.GetSize().z() / 2, entity.GetSize().x() + 0.05);
  }
}

TEST(Picking, TheNearestBodyOnTheRayWins)
{
  SmallWorld world = TwoRobotsAndAWall();
  const auto pick = PickEntity(world.Space(), {{2, 0.2, 0.1}, Vector3::UnitY()});
  ASSERT_TRUE(pick.has_value());
  EXPECT_EQ(pick->entity, world["near"].GetIndex());
  EXPECT_NEAR(pick->point.y(), 1 - 0.085, 0.012);
}

TEST(Picking, PatchesAndTheFloorAreNotPicked)
{
  SmallWorld world = TwoRobotsAndAWall();
  EXPECT_FALSE(PickEntity(world.Space(), {{3, 3, 2}, -Vector3::UnitZ()}).has_value());
}

TEST(Picking, AWallIsLookedThroughFromOutsideOnly)
{
  SmallWorld world = TwoRobotsAndAWall();
  const auto outside = PickEntity(world.Space(), {{2, -1, 0.1}, Vector3::UnitY()});
  ASSERT_TRUE(outside.has_value());
  EXPECT_EQ(outside->entity, world["near"].GetIndex());
  const auto inside = PickEntity(world.Space(), {{3, 1, 0.3}, -Vector3::UnitY()});
  ASSERT_TRUE(inside.has_value());
  EXPECT_EQ(inside->entity, world["south"].GetIndex());
}

const SceneItem& FirstItemOf(const Scene& scene, std::uint32_t entity)
{
  for (const SceneItem& item : scene.Items())
    if (item.entity == entity) return item;
  throw std::out_of_range("no item");
}

TEST(Scene, ItemsFollowTheSpace)
{
  SmallWorld world = TwoRobotsAndAWall();
  Scene scene(world.Space());
  scene.Update({});
  const std::size_t count = scene.Items().size();
  world.Space().SetPose(0, {{1, 1.5, 0}, QuaternionFromYaw(1)});
  world.Set("near", "turret_angle", 0.5);
  world.Set("near", "led", 0x00ff00, 3);
  world.Set("nest", "colour", 0xff0000);
  scene.Update({});
  EXPECT_EQ(scene.Items().size(), count);
  const SceneItem* base = &FirstItemOf(scene, 0);
  EXPECT_NEAR(base->position.y(), 1.5, 1e-6);
  EXPECT_NEAR((base + 1)->orientation.angularDistance(base->orientation), 0.5, 1e-5);
  EXPECT_EQ(scene.Lights()[static_cast<std::size_t>(base->lights + 3)], 0x00ff00U);
  EXPECT_EQ(FirstItemOf(scene, world["nest"].GetIndex()).tint, Paint(0xff0000));
}

TEST(Scene, ABeamEndsOnTheFirstBodyOrTheFloor)
{
  SmallWorld world({4, 4, 2});
  world.Add(EntityKind::kEyebot, "eb", {1, 2, 1});
  world.Add(EntityKind::kFootbot, "fb", {1, 3, 0});
  world.Set("eb", "laser", 1);
  Scene scene(world.Space());
  scene.Update({});
  ASSERT_EQ(scene.Glows().size(), 1U);
  EXPECT_LT((scene.Glows()[0].position - Eigen::Vector3f(1, 2, 0)).norm(), 1e-5);
  // Tilted by atan(0.9): towards a point 0.1 m above the floor, within the footbot.
  world.Set("eb", "laser_pan", kPi / 2);
  world.Set("eb", "laser_tilt", kPi / 4);
  scene.Update({});
  ASSERT_EQ(scene.Glows().size(), 1U);
  EXPECT_NEAR(scene.Glows()[0].position.y(), 2.915, 1e-3);
  world.Set("eb", "laser", 0);
  scene.Update({});
  EXPECT_TRUE(scene.Glows().empty());
}

TEST(Scene, TrailsAreThePlacesThatWerePassed)
{
  SmallWorld world({4, 4, 2});
  world.Add(EntityKind::kFootbot, "fb", {1, 1, 0});
  Scene scene(world.Space());
  SceneOptions options;
  options.trails = true;
  for (int tick = 0; tick <= 10; ++tick)
  {
    world.Space().SetPose(0, {{1 + 0.1 * tick, 1, 0}, Quaternion::Identity()});
    // States that are not drawn count too.
    if (tick % 5 == 0)
      scene.Update(options);
    else
      scene.Track();
  }
  ASSERT_EQ(scene.Lines().size(), 10U);
  EXPECT_NEAR(scene.Lines().front().from.x(), 2, 1e-5);
  EXPECT_NEAR(scene.Lines().back().to.x(), 1, 1e-5);
  EXPECT_GT(scene.Lines().front().opacity_from, scene.Lines().back().opacity_to);
}

TEST(Scene, RaysOfProximitySensorsStopAtBodies)
{
  SmallWorld world({4, 4, 2});
  ControllerConfiguration& controller = world.GetExperiment().controllers.emplace_back();
  controller.id = "c";
  controller.sensors.push_back({"footbot_proximity", "generic_footbot_proximity", {}});
  world.Add(EntityKind::kFootbot, "fb", {1, 1, 0}).controller = "c";
  world.AddBody(EntityKind::kBlock, "block", {1.235, 1, 0.1}, {0.2, 1, 0.2});
  Scene scene(world.Space());
  SceneOptions options;
  options.rays = true;
  scene.Update(options);
  ASSERT_EQ(scene.Lines().size(), 24U);
  int hits = 0;
  for (const SceneLine& line : scene.Lines()) hits += line.colour == palette::kRayHit;
  // Those within acos(0.135 / 0.185) = 43 degrees of the front.
  EXPECT_EQ(hits, 6);
}

TEST(Scene, AGripIsDrawnAndTheRopeOfAHandbot)
{
  SmallWorld world({4, 4, 2});
  world.Add(EntityKind::kFootbot, "fb", {1, 1, 0});
  world.Add(EntityKind::kHandbot, "hb", {2, 2, 0.5});
  world.AddBody(EntityKind::kCylindricPrey, "prey", {1.19, 1, 0}, {0.1, 0.1, 0.1});
  Scene scene(world.Space());
  scene.Update({});
  EXPECT_TRUE(scene.Lines().empty());
  world.Set("fb", "gripped", world["prey"].GetIndex() + 1);
  world.Set("hb", "rope_attached", 1);
  scene.Update({});
  ASSERT_EQ(scene.Lines().size(), 2U);
  EXPECT_NEAR(scene.Lines()[1].to.z(), 2, 1e-6);
}

}  // namespace
}  // namespace swarmanoid
