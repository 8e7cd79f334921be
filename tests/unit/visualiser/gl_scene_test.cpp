// Pictures of the GL renderer, drawn without X. Golden pictures lie in tests/golden, and SWARMANOID_WRITE_GOLDEN=1
// writes them again. SWARMANOID_PICTURES=FOLDER writes larger pictures to look at.
#include "visualiser/gl/gl_scene.h"

#include <gtest/gtest.h>

#include <octomap/octomap.h>

#include <cstdlib>

#include "common/configuration/xml_reader.h"
#include "test_folders.h"
#include "tests/unit/visualiser/look_at.h"
#include "tests/unit/visualiser/read_png.h"
#include "tests/unit/visualiser/small_world.h"
#include "tests/world/temporary_folder.h"
#include "visualiser/image/offscreen_context.h"
#include "visualiser/scene/enlargement.h"
#include "visualiser/scene/viewpoints.h"

namespace swarmanoid
{
namespace
{

constexpr int kWidth = 320;
constexpr int kHeight = 240;

// One context for all cases: as in a renderer, and quicker.
OffscreenContext& Context()
{
  static OffscreenContext context;
  return context;
}

Picture DrawWorld(SmallWorld& world, const Camera& camera, const SceneOptions& scene_options = {},
                  const DrawOptions& options = {}, int width = kWidth, int height = kHeight)
{
  Context();
  Scene scene(world.Space());
  scene.Update(scene_options);
  GlScene renderer;
  const PictureBuffer buffer(width, height);
  renderer.Draw(scene, camera, buffer.Framebuffer(), width, height, options);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  return buffer.Read();
}

std::uint32_t ColourAt(const Picture& picture, int x, int y)
{
  const std::uint8_t* pixel = picture.At(x, y);
  return static_cast<std::uint32_t>(pixel[0] << 16 | pixel[1] << 8 | pixel[2]);
}

int CountColour(const Picture& picture, std::uint32_t colour)
{
  int count = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) count += ColourAt(picture, x, y) == colour;
  return count;
}

// Pixels in which some channel differs by more than a tenth.
int CountDifferent(const Picture& a, const Picture& b)
{
  int count = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
    {
      int most = 0;
      for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(a.At(x, y)[c] - b.At(x, y)[c]));
      count += most > 25;
    }
  return count;
}

void ExpectGolden(SmallWorld& world, const Camera& camera, const std::string& name, const SceneOptions& options = {})
{
  if (const char* folder = std::getenv("SWARMANOID_PICTURES"))
    WritePng(DrawWorld(world, camera, options, {}, 1200, 900), std::string(folder) + "/" + name + ".png");
  const Picture picture = DrawWorld(world, camera, options);
  const std::string path = std::string(SWARMANOID_SOURCE_FOLDER) + "/tests/golden/" + name + ".png";
  if (std::getenv("SWARMANOID_WRITE_GOLDEN") != nullptr) WritePng(picture, path);
  const Picture golden = ReadPng(path);
  ASSERT_EQ(golden.width, picture.width);
  ASSERT_EQ(golden.height, picture.height);
  const int different = CountDifferent(picture, golden);
  // Other versions of Mesa and other cards place edges a little differently.
  EXPECT_LE(different, kWidth * kHeight / 50) << "the picture drawn is in " << name << "_drawn.png";
  if (different > kWidth * kHeight / 50) WritePng(picture, name + "_drawn.png");
}

SmallWorld ThreeRobots()
{
  SmallWorld world({3, 3, 2});
  world.Add(EntityKind::kFootbot, "fb_1", {1.25, 1.30, 0}, 200);
  world.Add(EntityKind::kFootbot, "fb_2", {1.75, 1.18, 0}, -60);
  world.Add(EntityKind::kHandbot, "hb", {1.60, 1.68, 0}, 250);
  world.Add(EntityKind::kEyebot, "eb", {1.12, 1.95, 0.45}, 20);
  world.AddBody(EntityKind::kCylindricPrey, "prey", {1.83, 1.04, 0}, {0.05, 0.05, 0.12}, 0xffff00);
  constexpr std::array<std::uint32_t, 12> kRainbow{0xff0000, 0xff8000, 0xffff00, 0x80ff00, 0x00ff00, 0x00ff80,
                                                   0x00ffff, 0x0080ff, 0x0000ff, 0x8000ff, 0xff00ff, 0xff0080};
  for (int led = 0; led < 12; ++led) world.Set("fb_1", "led", kRainbow[static_cast<std::size_t>(led)], led);
  world.Set("fb_1", "beacon", 0xff0000);
  world.SetLeds("fb_2", 12, 0x0000ff);
  world.Set("fb_2", "gripped", world["prey"].GetIndex() + 1);
  world.Set("fb_2", "gripper_aperture", 0.6);
  world.SetLeds("hb", 12, 0xff8000);
  world.Set("hb", "arm", 0.5, 0);
  world.Set("hb", "arm", 0.3, 1);
  world.Set("hb", "hand_aperture", 1.2, 0);
  world.Set("hb", "hand_aperture", 0.8, 1);
  world.SetLeds("eb", 16, 0x00ff00);
  world.Set("eb", "laser", 1);
  return world;
}

Camera CloseView() { return LookAt({0.75, 0.22, 0.75}, {1.46, 1.5, 0.15}); }

TEST(GlScene, DrawsTheThreeRobots)
{
  SmallWorld world = ThreeRobots();
  ExpectGolden(world, CloseView(), "robots");
}

SmallWorld Arena()
{
  SmallWorld world({4, 4, 2});
  world.AddBody(EntityKind::kWall, "west", {0, 2, 0.5}, {0.1, 4, 1});
  world.AddBody(EntityKind::kWall, "east", {4, 2, 0.5}, {0.1, 4, 1});
  world.AddBody(EntityKind::kWall, "south", {2, 0, 0.5}, {4, 0.1, 1});
  world.AddBody(EntityKind::kWall, "north", {2, 4, 0.5}, {4, 0.1, 1});
  world.AddBody(EntityKind::kGroundPatch, "nest", {3.2, 3.2, 0}, {1, 1, 0}, 0x00ff00);
  world.AddBody(EntityKind::kGroundPatch, "disc", {0.8, 3.2, 0}, {0.4, 0, 0}, 0xffa500);
  world.AddBody(EntityKind::kHole, "hole", {2, 2.7, 0}, {0.6, 0.3, 0});
  world.AddBody(EntityKind::kBlock, "block", {2.6, 1.6, 0.15}, {0.5, 0.3, 0.3}, 0x4060c0);
  world.AddBody(EntityKind::kCylindricPrey, "prey", {1.2, 1.0, 0}, {0.1, 0.1, 0.1}, 0xff00ff);
  world.AddBody(EntityKind::kLightBulb, "light", {3.4, 0.7, 0.8}, Vector3::Zero(), 0xffff00);
  world.Add(EntityKind::kSoundSource, "sound", {0.6, 1.8, 0.07});
  for (int i = 0; i < 5; ++i)
    world.Add(EntityKind::kFootbot, "fb_" + std::to_string(i), {0.8 + 0.5 * i, 2.0 + 0.1 * i, 0}, 70 * i);
  world.Space();
  return world;
}

TEST(GlScene, DrawsAnArenaWithWallsAndPatches)
{
  SmallWorld world = Arena();
  SceneOptions options;
  options.ids = true;
  ExpectGolden(world, DefaultView(world.GetExperiment(), 4.0 / 3), "arena", options);
}

// Hills from a picture, and a stair of cubes.
TEST(GlScene, DrawsTerrain)
{
  const test::TemporaryFolder folder;
  Picture heights{33, 33, {}};
  for (int y = 0; y < 33; ++y)
    for (int x = 0; x < 33; ++x)
    {
      const double wave = Sin(0.45 * x) * Cos(0.37 * y);
      for (int c = 0; c < 4; ++c) heights.pixels.push_back(static_cast<std::uint8_t>(128 + 120 * wave));
    }
  WritePng(heights, (folder / "hills.png").string());
  octomap::OcTree tree(0.1);
  for (int step = 0; step < 6; ++step)
    for (int y = 0; y < 12; ++y)
      for (int z = 0; z <= step; ++z)
        tree.updateNode(octomap::point3d(0.05F + 0.1F * static_cast<float>(step), 0.05F + 0.1F * static_cast<float>(y),
                                         0.05F + 0.1F * static_cast<float>(z)),
                        true);
  tree.writeBinary((folder / "stair.bt").string());

  SmallWorld world({4, 2, 1});
  const auto terrain = [&](const std::string& id, const Vector3& position, const std::string& element)
  {
    world.Add(EntityKind::kTerrain, id, position).tree =
        TConfigurationTree(ReadXml("<terrain>" + element + "</terrain>", "terrain.xml"));
  };
  terrain("hills", {0, 0, 0}, "<heightmap file=\"hills.png\" size=\"2,2\" height=\"0.3\"/>");
  terrain("stair", {2.8, 0.4, 0}, "<octomap file=\"stair.bt\"/>");
  world.Add(EntityKind::kFootbot, "fb_1", {1, 0.2, 0.115}, 90);
  world.Add(EntityKind::kFootbot, "fb_2", {3.35, 0.8, 0.6}, 180);
  world.GetExperiment().folder = folder.Path();
  ExpectGolden(world, DefaultView(world.GetExperiment(), 4.0 / 3), "terrain");
}

TEST(GlScene, DrawsTheSameBitsTwice)
{
  SmallWorld world = Arena();
  const Camera camera = DefaultView(world.GetExperiment(), 4.0 / 3);
  EXPECT_EQ(DrawWorld(world, camera).pixels, DrawWorld(world, camera).pixels);
}

// From straight above an eyebot's ring is hidden; a footbot from the side shows its LEDs in their own colours.
TEST(GlScene, LedsShineInExactlyTheirColour)
{
  SmallWorld world({2, 2, 1});
  world.Add(EntityKind::kFootbot, "fb", {1, 1, 0}, 0);
  world.SetLeds("fb", 12, 0x12c4e7);
  const Camera camera = LookAt({1.6, 1, 0.2}, {1, 1, 0.1});
  DrawOptions options;
  options.samples = 0;
  const int lit = CountColour(DrawWorld(world, camera, {}, options), 0x12c4e7);
  EXPECT_GT(lit, 200);
  // Half of the visible LEDs are switched off.
  for (int led = 0; led < 6; ++led) world.Set("fb", "led", 0, led);
  const int half = CountColour(DrawWorld(world, camera, {}, options), 0x12c4e7);
  EXPECT_NEAR(half, lit / 2.0, lit * 0.12);
  world.SetLeds("fb", 12, 0);
  EXPECT_EQ(CountColour(DrawWorld(world, camera, {}, options), 0x12c4e7), 0);
}

TEST(GlScene, ShadowsTexturesAndSmoothEdgesCanBeSwitchedOff)
{
  SmallWorld world({2, 2, 1});
  world.AddBody(EntityKind::kBlock, "block", {1, 1, 0.3}, {0.3, 0.3, 0.6});
  const Camera camera = LookAt({1, -1.5, 1.5}, {1, 1, 0.2});
  const Picture full = DrawWorld(world, camera);
  DrawOptions options;
  options.shadows = false;
  const Picture unshadowed = DrawWorld(world, camera, {}, options);
  EXPECT_GT(CountDifferent(full, unshadowed), 500);
  options.textures = false;
  const Picture plain = DrawWorld(world, camera, {}, options);
  EXPECT_NE(plain.pixels, unshadowed.pixels);
  options.samples = 0;
  const Picture jagged = DrawWorld(world, camera, {}, options);
  EXPECT_NE(plain.pixels, jagged.pixels);
  EXPECT_LT(CountDifferent(plain, jagged), 1500);
}

TEST(GlScene, MarksAreDrawnWhereAsked)
{
  SmallWorld world({2, 2, 1});
  world.Add(EntityKind::kFootbot, "fb", {1, 1, 0}, 0);
  const Camera camera = LookAt({1, -0.2, 0.8}, {1, 1, 0.1});
  const Picture bare = DrawWorld(world, camera);
  const auto difference = [&](bool SceneOptions::*mark)
  {
    SceneOptions options;
    options.*mark = true;
    return CountDifferent(bare, DrawWorld(world, camera, options));
  };
  EXPECT_GT(difference(&SceneOptions::ids), 60);
  EXPECT_GT(difference(&SceneOptions::collision_models), 60);
  SceneOptions selected;
  selected.selected = 0;
  EXPECT_GT(CountDifferent(bare, DrawWorld(world, camera, selected)), 60);
}

// The later patch of the file is on top, as for the ground sensors.
TEST(GlScene, OfPatchesThatOverlapTheLaterOneIsOnTop)
{
  for (const bool red_last : {false, true})
  {
    SmallWorld world({2, 2, 1});
    world.AddBody(EntityKind::kGroundPatch, "a", {1, 1, 0}, {1, 1, 0}, red_last ? 0x0000ff : 0xff0000);
    world.AddBody(EntityKind::kGroundPatch, "b", {1, 1, 0}, {1, 1, 0}, red_last ? 0xff0000 : 0x0000ff);
    const Picture picture = DrawWorld(world, LookAt({1, -3, 1.5}, {1, 1, 0}));
    int red = 0;
    int blue = 0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
      {
        const std::uint8_t* pixel = picture.At(x, y);
        red += pixel[0] > pixel[2] + 60;
        blue += pixel[2] > pixel[0] + 60;
      }
    EXPECT_GT(red_last ? red : blue, 500);
    EXPECT_EQ(red_last ? blue : red, 0);
  }
}

// Neither they nor their marks are drawn. The depth of the picture, which reaches as far as the bodies, does not change
// either.
TEST(GlScene, WhatIsNotInTheArenaChangesNoPixel)
{
  const auto picture = [](bool with_absent)
  {
    SmallWorld world({2, 2, 1});
    world.Add(EntityKind::kFootbot, "fb", {1, 1, 0}, 0);
    world.AddBody(EntityKind::kCylindricPrey, "prey", {1.3, 0.9, 0}, {0.1, 0.1, 0.1}, 0xffff00);
    if (with_absent)
    {
      const Vector3 nowhere = Vector3::Zero();
      world.Add(EntityKind::kEyebot, "late_eb", nowhere);
      world.Add(EntityKind::kFootbot, "late_fb", nowhere);
      world.AddBody(EntityKind::kCylindricPrey, "late_prey", nowhere, {0.1, 0.1, 0.1});
      world.Add(EntityKind::kLightBulb, "late_lamp", nowhere);
      world.AddBody(EntityKind::kGroundPatch, "late_mat", nowhere, {0.5, 0.5, 0}, 0xff0000);
      auto& entities = world.GetExperiment().entities;
      for (std::size_t e = 2; e < entities.size(); ++e) entities[e].waits = true;
      world.Set("late_eb", "laser", 1);
      world.Set("late_eb", "laser_colour", 0xff0000);
      world.SetLeds("late_fb", 12, 0x0000ff);
    }
    SceneOptions options;
    options.ids = options.collision_models = options.rays = true;
    if (with_absent) options.selected = 3;
    return DrawWorld(world, LookAt({1, -0.2, 0.8}, {1, 1, 0.1}), options);
  };
  EXPECT_EQ(picture(true).pixels, picture(false).pixels);
}

TEST(GlScene, AWallThatHidesTheArenaIsGlass)
{
  SmallWorld world({2, 2, 1});
  world.AddBody(EntityKind::kWall, "south", {1, 0, 0.5}, {2, 0.1, 1});
  world.Add(EntityKind::kFootbot, "fb", {1, 1, 0}, 0);
  world.SetLeds("fb", 12, 0xff0000);
  const Camera outside = LookAt({1, -2, 0.5}, {1, 1, 0.1});
  DrawOptions options;
  options.samples = 0;
  const auto red = [&](const Picture& picture)
  {
    int count = 0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
        count += picture.At(x, y)[0] > 220 && picture.At(x, y)[1] < 60 && picture.At(x, y)[2] < 60;
    return count;
  };
  EXPECT_GT(red(DrawWorld(world, outside, {}, options)), 10);
  options.glass_walls = false;
  EXPECT_EQ(red(DrawWorld(world, outside, {}, options)), 0);
}

TEST(GlScene, DistantRobotsAreDiscsOfALeastSizeInTheColourOfTheirLedsAndTheCaptionSaysSo)
{
  SmallWorld world({100, 100, 1});
  for (int i = 0; i < 40; ++i)
    world.Add(EntityKind::kFootbot, "fb_" + std::to_string(i), {20.0 + i % 10, 30.0 + i / 10, 0}, i);
  world.SetLeds("fb_0", 12, 0xff0000);
  Context();
  Scene scene(world.Space());
  scene.Update({});
  GlScene renderer;
  const PictureBuffer buffer(kWidth, kHeight);
  const auto draw = [&](const Camera& camera, bool says)
  {
    DrawOptions options;
    options.says_enlargement = says;
    renderer.Draw(scene, camera, buffer.Framebuffer(), kWidth, kHeight, options);
    return ReadPicture(buffer.Framebuffer(), kWidth, kHeight);
  };
  const Camera far = DefaultView(world.GetExperiment(), static_cast<double>(kWidth) / kHeight, true);
  const Picture picture = draw(far, false);
  EXPECT_EQ(renderer.Statistics().points, 40U);
  EXPECT_GT(renderer.Statistics().enlargement, 3);
  // The disc of 2.6 pixels covers about five.
  const auto count = [&](const Vector3& at, auto&& is_wanted)
  {
    const Vector3 pixel = far.Project(at, kWidth, kHeight);
    int found = 0;
    for (int y = -4; y <= 4; ++y)
      for (int x = -4; x <= 4; ++x)
        found += is_wanted(picture.At(static_cast<int>(pixel.x()) + x, static_cast<int>(pixel.y()) + y));
    return found;
  };
  const auto is_red = [](const auto& pixel) { return pixel[0] > pixel[1] + 60 && pixel[0] > pixel[2] + 60; };
  const auto is_dark = [](const auto& pixel) { return pixel[0] < 150; };
  EXPECT_GE(count({20, 30, 0}, is_red), 3);
  EXPECT_EQ(count({60, 60, 0}, is_red), 0);
  EXPECT_GE(count({25, 33, 0}, is_dark), 3);
  EXPECT_EQ(count({60, 60, 0}, is_dark), 0);
  EXPECT_NE(draw(far, true).pixels, picture.pixels);
  EXPECT_EQ(EnlargementText(renderer.Statistics().enlargement).substr(0, 13), "robots up to ");
  // From near by they are what they are.
  const Camera near = LookAt({22, 28, 3}, {24, 32, 0});
  EXPECT_EQ(draw(near, true).pixels, draw(near, false).pixels);
  EXPECT_EQ(renderer.Statistics().points, 0U);
  EXPECT_EQ(EnlargementText(renderer.Statistics().enlargement), "");
}

TEST(GlScene, DrawsTenThousandRobotsWithFewTriangles)
{
  SmallWorld world({100, 100, 1});
  for (int i = 0; i < 10000; ++i)
    world.Add(EntityKind::kFootbot, "fb_" + std::to_string(i), {0.5 + i % 100, 0.5 + i / 100, 0}, i);
  Context();
  Scene scene(world.Space());
  scene.Update({});
  GlScene renderer;
  const PictureBuffer buffer(kWidth, kHeight);
  renderer.Draw(scene, DefaultView(world.GetExperiment(), 4.0 / 3), buffer.Framebuffer(), kWidth, kHeight, {});
  EXPECT_EQ(renderer.Statistics().points, 10000U);
  EXPECT_EQ(renderer.Statistics().triangles, 0U);
  // Nearer robots have meshes.
  const Camera near = LookAt({50, 20, 6}, {50, 40, 0});
  renderer.Draw(scene, near, buffer.Framebuffer(), kWidth, kHeight, {});
  EXPECT_GT(renderer.Statistics().points, 100U);
  EXPECT_GT(renderer.Statistics().triangles, 1000U);
  EXPECT_LT(renderer.Statistics().triangles, 1'400'000U);
}

}  // namespace
}  // namespace swarmanoid
