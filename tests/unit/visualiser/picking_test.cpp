#include "visualiser/scene/picking.h"

#include <gtest/gtest.h>

#include "tests/unit/visualiser/look_at.h"
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
  const Camera camera = LookAt({2.3, -2, 2}, {2, 2, 0});
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

TEST(Scene, ALampShinesInItsColourWhileItIsOn)
{
  SmallWorld world({4, 4, 2});
  world.AddBody(EntityKind::kLightBulb, "lamp", {1, 1, 0.5}, Vector3::Zero(), 0xffff00);
  Scene scene(world.Space());
  const auto light = [&](double intensity)
  {
    world.Set("lamp", "intensity", intensity);
    scene.Update({});
    return scene.Lights()[static_cast<std::size_t>(FirstItemOf(scene, 0).lights)];
  };
  EXPECT_EQ(light(1), 0xffff00U);
  EXPECT_EQ(light(0), 0U);
  EXPECT_EQ(light(0.1), 0xffff00U);
}

// Returns a part of a robot. The parts are in the order of RestingParts.
const SceneItem& PartOf(const Scene& scene, std::uint32_t entity, std::size_t part)
{
  return (&FirstItemOf(scene, entity))[part];
}

// Returns the direction in which an axis of a part looks.
Eigen::Vector3f Looks(const SceneItem& part, const Eigen::Vector3f& axis) { return part.orientation * axis; }

void ExpectNear(const Eigen::Vector3f& is, const Eigen::Vector3f& expected)
{
  EXPECT_LT((is - expected).norm(), 1e-5) << is.transpose() << " instead of " << expected.transpose();
}

TEST(Scene, ATurretTurnsToTheLeftWithItsJaws)
{
  SmallWorld world({4, 4, 2});
  world.Add(EntityKind::kFootbot, "fb", {1, 1, 0}, 90);
  world.Set("fb", "turret_angle", kPi / 6);
  world.Set("fb", "gripper_aperture", kPi / 4);
  Scene scene(world.Space());
  scene.Update({});
  const auto at = [](double degrees)
  {
    const auto angle = static_cast<float>(DegreesToRadians(degrees));
    return Eigen::Vector3f(std::cos(angle), std::sin(angle), 0);
  };
  ExpectNear(Looks(PartOf(scene, 0, 1), Eigen::Vector3f::UnitX()), at(120));
  // The left jaw opens to the left, the right one to the right, each from its side of the turret.
  ExpectNear(Looks(PartOf(scene, 0, 2), Eigen::Vector3f::UnitX()), at(165));
  ExpectNear(Looks(PartOf(scene, 0, 3), Eigen::Vector3f::UnitX()), at(75));
  const Eigen::Vector3f hinge(1, 1, 0.085F);
  ExpectNear(PartOf(scene, 0, 2).position, hinge + 0.086F * at(120) + 0.008F * at(210));
  ExpectNear(PartOf(scene, 0, 3).position, hinge + 0.086F * at(120) - 0.008F * at(210));
}

// Positive angles of head and wrists turn about the forward axis as a right hand does, those of arms and hands open
// outwards (docs/devices.md). Each joint by itself, and each side for itself.
TEST(Scene, HeadArmsWristsAndFingersTurnToTheirOwnSides)
{
  SmallWorld world({4, 4, 2});
  world.Add(EntityKind::kHandbot, "hb", {1, 1, 0});
  Scene scene(world.Space());
  const Eigen::Vector3f x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), chest(1.06F, 1, 0.1F);
  constexpr std::size_t kHead = 1, kLeftArm = 2, kRightArm = 5;
  const auto fingers_of = [](std::size_t arm) { return arm + 1; };

  world.Set("hb", "head_angle", kPi / 2);
  scene.Update({});
  ExpectNear(Looks(PartOf(scene, 0, kHead), y), z);
  ExpectNear(PartOf(scene, 0, kLeftArm).position, chest + 0.05F * z);
  ExpectNear(PartOf(scene, 0, kRightArm).position, chest - 0.05F * z);
  world.Set("hb", "head_angle", 0);

  for (const int side : {0, 1})
  {
    const std::size_t arm = side == 0 ? kLeftArm : kRightArm;
    const std::size_t other = side == 0 ? kRightArm : kLeftArm;
    const float sign = side == 0 ? 1.0F : -1.0F;
    world.Set("hb", "arm", kPi / 2, side);
    scene.Update({});
    ExpectNear(Looks(PartOf(scene, 0, arm), x), sign * y);
    ExpectNear(Looks(PartOf(scene, 0, other), x), x);
    world.Set("hb", "arm", 0, side);

    world.Set("hb", "wrist", kPi / 2, side);
    scene.Update({});
    ExpectNear(Looks(PartOf(scene, 0, fingers_of(arm)), y), z);
    ExpectNear(Looks(PartOf(scene, 0, fingers_of(other)), y), y);
    world.Set("hb", "wrist", 0, side);

    world.Set("hb", "hand_aperture", kPi / 2, side);
    scene.Update({});
    const float half = std::sqrt(0.5F);
    ExpectNear(Looks(PartOf(scene, 0, fingers_of(arm)), x), half * x + half * y);
    ExpectNear(Looks(PartOf(scene, 0, fingers_of(arm) + 1), x), half * x - half * y);
    ExpectNear(Looks(PartOf(scene, 0, fingers_of(other)), x), x);
    world.Set("hb", "hand_aperture", 0, side);
  }
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
  // It is tilted by atan(0.9): towards a point 0.1 m above the floor, within the footbot.
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
  // Rays meet the bodies of the robot's engine, as for the sensors.
  world.GetExperiment().engines.emplace_back().entities = {0, 1};
  Scene scene(world.Space());
  SceneOptions options;
  options.rays = true;
  scene.Update(options);
  ASSERT_EQ(scene.Lines().size(), 24U);
  int hits = 0;
  for (const SceneLine& line : scene.Lines()) hits += line.colour == palette::kRayHit;
  // The hits are those within acos(0.135 / 0.185) = 43 degrees of the front.
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

TEST(Picking, AWallIsTallByTheSizeOfTheArenaToo)
{
  SmallWorld world({2, 2, 1});
  world.AddBody(EntityKind::kWall, "low", {1, 0, 0.1}, {2, 0.02, 0.2});
  world.AddBody(EntityKind::kWall, "kerb", {1, 0, 0.05}, {2, 0.02, 0.1});
  EXPECT_TRUE(IsBoundaryWall(world["low"].GetConfiguration(), {2, 2, 1}));
  EXPECT_FALSE(IsBoundaryWall(world["kerb"].GetConfiguration(), {2, 2, 1}));
  EXPECT_FALSE(IsBoundaryWall(world["low"].GetConfiguration(), {4, 2, 1})) << "a wall as high as a robot, around many";
}

TEST(Picking, AWallIsCutLowerWhereItHidesTheArena)
{
  SmallWorld world = TwoRobotsAndAWall();
  const EntityConfiguration& wall = world["south"].GetConfiguration();
  const Vector3 arena(4, 4, 2);
  EXPECT_FLOAT_EQ(SolidHeight(wall, arena, {2, -1, 1}), 0.04F);
  EXPECT_FLOAT_EQ(SolidHeight(wall, arena, {2, 1, 1}), 0.35F);
  // In a large arena more of it is left.
  EXPECT_FLOAT_EQ(SolidHeight(wall, {10, 4, 2}, {2, 1, 1}), 0.7F);
}

}  // namespace
}  // namespace swarmanoid
