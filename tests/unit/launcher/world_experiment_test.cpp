// The experiment that is made of a world: it is valid, its arena holds everything, and it can be turned back into the
// world's poses.
#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "common/math/elementary.h"
#include "launcher/worlds/imported_world.h"
#include "simulation/register_all.h"
#include "tests/unit/launcher/world_lines.h"

namespace swarmanoid
{
namespace
{

using test::LinesOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

LoadedExperiment LoadedWorld(World& world)
{
  RegisterBuiltins();
  return LoadExperimentText(ExperimentOfWorld(world, {"/", "a--b.sdf"}), "made.xml", "/");
}

WorldBody BodyAt(const std::string& name, const Vector3& place, const Vector3& size)
{
  WorldBody body;
  body.name = name;
  body.pose.position = place;
  body.size = size;
  return body;
}

TEST(WorldExperiment, TheArenaHoldsAllBodiesAndIsShiftedByWholeMetres)
{
  World world;
  world.bodies = {BodyAt("west", {-3.2, 0.4, 0.5}, {1, 1, 1}), BodyAt("north", {0, 2.5, 1}, {2, 1, 2})};
  world.lights = {{"lamp", {}, {1.5, -0.5, 4.5}, 2, 0xff0000}};
  const LoadedExperiment loaded = LoadedWorld(world);
  EXPECT_THAT(LinesOf(loaded.errors), IsEmpty());
  ASSERT_TRUE(loaded.experiment);
  EXPECT_EQ(loaded.experiment->arena_size, Vector3(4 + 2, 1 + 3, 5));
  ASSERT_EQ(loaded.experiment->entities.size(), 3U);
  EXPECT_TRUE(loaded.experiment->entities[0].pose.position.isApprox(Vector3(0.8, 1.4, 0.5), 1e-9));
  EXPECT_TRUE(loaded.experiment->entities[2].pose.position.isApprox(Vector3(5.5, 0.5, 4.5), 1e-9));
  EXPECT_EQ(loaded.experiment->entities[2].intensity, 2);
}

TEST(WorldExperiment, RotationsAboutAllAxesAreKept)
{
  World world;
  const std::vector<std::array<double, 3>> all_angles{
      {0.3, -0.4, 2.5}, {kPi / 2, 0, 0}, {0, kPi / 2, 0}, {1, -kPi / 2, 0.4}};
  for (const auto& [roll, pitch, yaw] : all_angles)
  {
    WorldBody body = BodyAt("log", {2, 2, 3}, {0.1, 0.1, 0.6});
    body.form = world.bodies.size() % 2 == 0 ? WorldBody::Form::kCylinder : WorldBody::Form::kBox;
    body.pose.orientation = QuaternionFromEuler({roll, pitch, yaw});
    world.bodies.push_back(body);
  }
  const LoadedExperiment loaded = LoadedWorld(world);
  EXPECT_THAT(LinesOf(loaded.errors), IsEmpty());
  ASSERT_TRUE(loaded.experiment);
  for (std::size_t k = 0; k < world.bodies.size(); ++k)
  {
    const EntityConfiguration& entity = loaded.experiment->entities[k];
    const Pose& wanted = world.bodies[k].pose;
    EXPECT_LT(entity.pose.orientation.angularDistance(wanted.orientation), 1e-7) << entity.id;
    // The position of a cylinder is the centre of its base; the arena begins at 1, 1.
    const Vector3 to_centre(0, 0, k % 2 == 0 ? 0.3 : 0);
    const Vector3 shift = entity.pose.Apply(to_centre) - wanted.position;
    EXPECT_NEAR(shift.x(), std::round(shift.x()), 1e-7);
    EXPECT_NEAR(shift.z(), 0, 1e-7);
  }
}

TEST(WorldExperiment, NamesBecomeUniqueIds)
{
  World world;
  const Vector3 size(0.1, 0.1, 0.1);
  world.bodies = {BodyAt("a box", {0, 0, 1}, size),
                  BodyAt("a_box", {1, 0, 1}, size),
                  BodyAt("", {2, 0, 1}, size),
                  BodyAt(".x", {3, 0, 1}, size),
                  BodyAt(std::string(100, 'n'), {0, 1, 1}, size),
                  BodyAt(std::string(100, 'n'), {0, 2, 1}, size),
                  BodyAt("a_box_2", {0, 3, 1}, size)};
  const LoadedExperiment loaded = LoadedWorld(world);
  EXPECT_THAT(LinesOf(loaded.errors), IsEmpty());
  ASSERT_TRUE(loaded.experiment);
  std::vector<std::string> ids;
  for (const EntityConfiguration& entity : loaded.experiment->entities) ids.push_back(entity.id);
  EXPECT_THAT(
      ids, ElementsAre("a_box", "a_box_2", "_", "_.x", std::string(60, 'n'), std::string(53, 'n') + "_2", "a_box_2_2"));
}

TEST(WorldExperiment, MovableBodiesKeepTheirMassAndSurface)
{
  World world;
  WorldBody crate = BodyAt("crate", {0, 0, 0.5}, {1, 1, 1});
  crate.movable = true;
  crate.mass_kg = 2.5;
  crate.friction = 0.25;
  crate.colour = 0x112233;
  world.bodies = {crate};
  world.gravity = {0, 0, -1.62};
  const LoadedExperiment loaded = LoadedWorld(world);
  EXPECT_THAT(LinesOf(loaded.errors), IsEmpty());
  ASSERT_TRUE(loaded.experiment);
  const EntityConfiguration& entity = loaded.experiment->entities[0];
  EXPECT_TRUE(entity.movable);
  EXPECT_EQ(entity.mass_kg, 2.5);
  EXPECT_EQ(entity.colour, 0x112233U);
  EXPECT_EQ(entity.tree.GetNumber("friction"), 0.25);
  EXPECT_EQ(loaded.experiment->engines[0].tree.GetVector3("gravity"), Vector3(0, 0, -1.62));
}

TEST(WorldExperiment, BodiesBelowTheFloorAreLeftOut)
{
  World world;
  world.bodies = {BodyAt("slab", {0, 0, -0.05}, {10, 10, 0.1}), BodyAt("box", {0, 0, 0.5}, {1, 1, 1})};
  world.lights = {{"deep", {}, {0, 0, -1}, 1, 0xffffff}};
  const LoadedExperiment loaded = LoadedWorld(world);
  ASSERT_TRUE(loaded.experiment);
  EXPECT_EQ(loaded.experiment->entities.size(), 1U);
  EXPECT_THAT(LinesOf(world.notes), ElementsAre(HasSubstr("the body 'slab' lies below the floor z = 0"),
                                                HasSubstr("the light 'deep' lies below the floor z = 0")));
}

TEST(WorldExperiment, AnEmptyWorldIsAnEmptyArena)
{
  World world;
  const LoadedExperiment loaded = LoadedWorld(world);
  EXPECT_THAT(LinesOf(loaded.errors), IsEmpty());
  ASSERT_TRUE(loaded.experiment);
  EXPECT_EQ(loaded.experiment->arena_size, Vector3(1, 1, 1));
}

}  // namespace
}  // namespace swarmanoid
