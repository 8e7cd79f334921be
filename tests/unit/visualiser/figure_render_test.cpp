// Tests figure_render in an experiment file: the layout of the page, measured in its pixels and its text.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "common/configuration/xml_reader.h"
#include "tests/unit/visualiser/read_png.h"
#include "tests/unit/visualiser/small_world.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"
#include "visualiser/figure/plan_page.h"
#include "visualiser/figure/plan_scene.h"
#include "visualiser/scene/drawn_picture.h"
#include "visualiser/visualiser.h"

namespace swarmanoid
{
namespace
{

using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr double kMargin = 1.5;  // mm, of the page
constexpr double kDots = 10;     // a mm, at 254 dpi
constexpr std::uint32_t kFirstRobots = 0x0072b2;

class FigureRender : public ::testing::Test
{
protected:
  FigureRender() : world_({4, 2, 1})
  {
    RegisterBuiltinRenderers();
    world_.Add(EntityKind::kFootbot, "fb", {3, 1.5, 0}, 90);
  }

  std::unique_ptr<Visualiser> Make(const std::string& attributes)
  {
    RenderConfiguration configuration;
    configuration.tag = "figure_render";
    configuration.id = "plan";
    configuration.tree = TConfigurationTree(ReadXml("<figure_render " + attributes + "/>", "plan.xml"));
    return std::make_unique<Visualiser>(configuration, world_.Space(), assignment_, folder_.Path(), nullptr, nullptr);
  }
  // The robot goes from x = 3 by 1 cm a tick. Returns the tick after which the renderer wanted the end, or -1.
  int Run(const std::string& attributes, int ticks)
  {
    const auto visualiser = Make(attributes);
    int ended = -1;
    for (int tick = 0; tick <= ticks && ended < 0; ++tick)
    {
      world_.Space().SetTick(static_cast<std::uint64_t>(tick));
      world_.Space().SetPose(0, {{3 - 0.01 * tick, 1.5, 0}, QuaternionFromYaw(DegreesToRadians(90))});
      if (visualiser->Draw()) ended = tick;
    }
    visualiser->Finish();
    return ended;
  }
  // The page is 103 mm wide, and 100 without margins: 25 mm a metre, 10 pixels a mm.
  Picture Page(const std::string& attributes, int ticks = 0)
  {
    Run("file=\"plan.png\" width=\"103\" dpi=\"254\" show_legend=\"false\" show_scale=\"false\" " + attributes, ticks);
    return ReadPng(Path("plan.png"));
  }
  static std::uint32_t ColourAt(const Picture& picture, double x_mm, double y_mm)
  {
    const auto* const pixel =
        picture.At(static_cast<int>(std::lround(kDots * x_mm)), static_cast<int>(std::lround(kDots * y_mm)));
    return static_cast<std::uint32_t>(pixel[0] << 16 | pixel[1] << 8 | pixel[2]);
  }
  // Returns the colour in a plan of the whole arena without captions.
  static std::uint32_t ColourIn(const Picture& picture, double x_m, double y_m)
  {
    return ColourAt(picture, kMargin + 25 * x_m, kMargin + 25 * (2 - y_m));
  }
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  std::string Read(const std::string& name) const { return folder_.Read(name); }
  std::string ErrorOf(const std::string& attributes)
  {
    return test::MessageOf<std::runtime_error>([&] { Make(attributes); });
  }

  SmallWorld world_;
  Assignment assignment_;
  test::TemporaryFolder folder_;
};

TEST_F(FigureRender, EntitiesStandWhereTheyAreAndLookWhereTheyLook)
{
  world_.AddBody(EntityKind::kWall, "wall", {1, 1, 0.25}, {0.2, 1, 0.5}, 0xff0000);
  const Picture picture = Page("");
  EXPECT_EQ(picture.width, 1030);
  EXPECT_EQ(picture.height, 530);
  const double radius = DescriptionOf(EntityKind::kFootbot).size.x();
  EXPECT_EQ(ColourIn(picture, 3.04, 1.5), kFirstRobots);
  EXPECT_EQ(ColourIn(picture, 3, 1.5 - 0.6 * radius), kFirstRobots);
  EXPECT_EQ(ColourIn(picture, 3, 1.5 + 0.6 * radius), 0xffffffu);  // its front, at +y
  EXPECT_EQ(ColourIn(picture, 3 + 1.3 * radius, 1.5), 0xffffffu);
  EXPECT_EQ(ColourIn(picture, 3, 0.5), 0xffffffu);
  const std::uint32_t wall = ColourIn(picture, 1, 1);
  EXPECT_GT(wall >> 16, 2 * (wall & 0xff));
  for (const double y : {0.53, 1.47}) EXPECT_EQ(ColourIn(picture, 1, y), wall) << y;
  for (const double x : {0.86, 1.14}) EXPECT_EQ(ColourIn(picture, x, 1), 0xffffffu) << x;
}

TEST_F(FigureRender, ARegionFillsThePage)
{
  const Picture picture = Page("region=\"2, 1, 4, 2\"");
  EXPECT_EQ(picture.height, 530);  // 50 mm a metre
  EXPECT_EQ(ColourAt(picture, kMargin + 50 * 1.04, kMargin + 50 * 0.5), kFirstRobots);
}

TEST_F(FigureRender, AnInsetShowsItsPartLargerInItsCorner)
{
  const Picture picture = Page("inset=\"2.8, 1.3, 3.2, 1.7\" inset_corner=\"bottom_left\"");
  // Two fifths of the plan's 50 mm are 20 mm, so 50 mm a metre; the middle of the inset is the robot.
  EXPECT_EQ(ColourAt(picture, kMargin + 10 + 50 * 0.06, kMargin + 40), kFirstRobots);
  EXPECT_EQ(ColourAt(picture, kMargin + 10 + 50 * 0.1, kMargin + 40), 0xffffffu);
  EXPECT_EQ(ColourIn(picture, 3.04, 1.5), kFirstRobots);
}

TEST_F(FigureRender, LedsThatShineAndWhatIsHeldAreDrawn)
{
  world_.AddBody(EntityKind::kCylindricPrey, "prey", {3, 1.0, 0}, {0.1, 0.1, 0.1}, 0x00ff00);
  world_.Space();
  world_.Set("fb", "led", 0xff0000, 0);
  world_.Set("fb", "gripped", 2);
  const Picture picture = Page("");
  const Vector2 led = DescriptionOf(EntityKind::kFootbot).leds->places[0];
  EXPECT_EQ(ColourIn(picture, 3 - led.y(), 1.5 + led.x()), 0xff0000u);
  EXPECT_EQ(ColourIn(picture, 3, 1.25), 0xe69f00u);
}

TEST_F(FigureRender, WhatExperimentFunctionsDrawIsAboveIt)
{
  Drawing drawing;
  drawing.Disc({{1, 1, 0}, Quaternion::Identity()}, 0.3, {0xff00ff});
  drawing.Segment({1, 1, 0}, {2, 1, 0}, {0x00ff00, 1, 8});
  drawing.InFrameOf(0);
  drawing.Box({{0.3, 0, 0}, Quaternion::Identity()}, {0.2, 0.2, 0.2}, {0x00ffff});
  world_.Space().SwapDrawing(drawing);
  const Picture picture = Page("");
  EXPECT_EQ(ColourIn(picture, 0.8, 1.1), 0xff00ffU);
  EXPECT_EQ(ColourIn(picture, 1.8, 1), 0x00ff00U);
  // The robot at 3, 1.5 looks along y.
  EXPECT_EQ(ColourIn(picture, 3, 1.8), 0x00ffffU);
  EXPECT_NE(ColourIn(picture, 3.3, 1.5), 0x00ffffU);
}

TEST_F(FigureRender, DrawnLinesGoFromPointToPoint)
{
  Drawing drawing;
  const std::vector<Vector3> bend{{0.5, 0.5, 0}, {0.9, 0.5, 0}, {0.9, 0.9, 1}};
  const std::vector<Vector3> triangle{{1.2, 0.4, 0}, {1.8, 0.4, 0}, {1.2, 1, 0}};
  drawing.Polyline(bend, {0x00ff00, 1, 8});
  drawing.Polygon(triangle, {0xff00ff});
  drawing.Circle({{2.5, 0.7, 0}, Quaternion::Identity()}, 0.2, {0x00ffff, 1, 8});
  drawing.Point({3.5, 0.5, 0}, {0x0000ff, 1, 16});
  world_.Space().SwapDrawing(drawing);
  const Picture picture = Page("");
  EXPECT_EQ(ColourIn(picture, 0.7, 0.5), 0x00ff00U);
  EXPECT_EQ(ColourIn(picture, 0.9, 0.7), 0x00ff00U);
  EXPECT_EQ(ColourIn(picture, 0.7, 0.7), 0xffffffU) << "it is open";
  EXPECT_EQ(ColourIn(picture, 1.35, 0.55), 0xff00ffU);
  EXPECT_EQ(ColourIn(picture, 1.65, 0.85), 0xffffffU);
  for (const Vector2& side : {Vector2(-0.2, 0), Vector2(0, 0.2), Vector2(0, -0.2)})
    EXPECT_EQ(ColourIn(picture, 2.5 + side.x(), 0.7 + side.y()), 0x00ffffU) << side.transpose();
  EXPECT_EQ(ColourIn(picture, 2.5, 0.7), 0xffffffU);
  EXPECT_EQ(ColourIn(picture, 3.5, 0.5), 0x0000ffU);
}

// A head is a quarter of its arrow, at most 0.1 m, and four fifths as wide as it is long.
TEST_F(FigureRender, DrawnArrowsHaveAHeadAtTheirEnd)
{
  Drawing drawing;
  drawing.Arrow({0.5, 0.5, 0}, {0.9, 0.5, 0}, {0x00ff00, 1, 1});
  drawing.Arrow({2.5, 0.4, 0}, {2.5, 1.8, 0}, {0xff00ff, 1, 1});
  drawing.Arrow({1.5, 1, 0}, {1.5, 1, 0}, {0x0000ff, 1, 1});
  world_.Space().SwapDrawing(drawing);
  const Picture picture = Page("");
  for (const double side : {-0.025, 0.025})
  {
    EXPECT_EQ(ColourIn(picture, 0.815, 0.5 + side), 0x00ff00U);
    EXPECT_EQ(ColourIn(picture, 0.78, 0.5 + side), 0xffffffU) << "in front of the head";
    EXPECT_EQ(ColourIn(picture, 0.515, 0.5 + side), 0xffffffU) << "where it starts";
    EXPECT_EQ(ColourIn(picture, 2.5 + side, 1.715), 0xff00ffU);
    EXPECT_EQ(ColourIn(picture, 2.5 + side, 1.68), 0xffffffU);
  }
}

TEST_F(FigureRender, DrawnBoxesAndCylindersAreTurnedByTheirPoses)
{
  const auto turned = [](const Vector3& position, const Vector3& axis, double degrees) {
    return Pose{position, Quaternion(Eigen::AngleAxisd(DegreesToRadians(degrees), axis))};
  };
  Drawing drawing;
  drawing.Box(turned({1, 1, 0}, Vector3::UnitZ(), 30), {0.8, 0.1, 0.1}, {0xff00ff});
  // It is upright at first; turned about y it lies along x, turned about x along y.
  drawing.Cylinder(turned({2, 0.5, 0}, Vector3::UnitY(), 90), 0.05, 0.6, {0x00ff00});
  drawing.Cylinder(turned({3.5, 0.5, 0}, Vector3::UnitX(), 90), 0.05, 0.6, {0x0000ff});
  // Seen from its edge a disc is a line; a turn by 60 degrees halves one of its axes.
  drawing.Disc(turned({2, 1.5, 0}, Vector3::UnitY(), 60), 0.3, {0xff0000});
  world_.Space().SwapDrawing(drawing);
  const Picture picture = Page("");
  const double x = 0.35 * std::cos(DegreesToRadians(30)), y = 0.35 * std::sin(DegreesToRadians(30));
  for (const double side : {-1.0, 1.0})
  {
    EXPECT_EQ(ColourIn(picture, 1 + side * x, 1 + side * y), 0xff00ffU) << "counterclockwise, as seen from above";
    EXPECT_EQ(ColourIn(picture, 1 + side * x, 1 - side * y), 0xffffffU);
    EXPECT_EQ(ColourIn(picture, 2 + side * 0.25, 0.5), 0x00ff00U);
    EXPECT_EQ(ColourIn(picture, 2, 0.5 + side * 0.1), 0xffffffU);
    EXPECT_EQ(ColourIn(picture, 3.5, 0.5 + side * 0.25), 0x0000ffU);
    EXPECT_EQ(ColourIn(picture, 3.5 + side * 0.1, 0.5), 0xffffffU);
    EXPECT_EQ(ColourIn(picture, 2 + side * 0.12, 1.5), 0xff0000U);
    EXPECT_EQ(ColourIn(picture, 2 + side * 0.2, 1.5), 0xffffffU);
    EXPECT_EQ(ColourIn(picture, 2, 1.5 + side * 0.27), 0xff0000U);
  }
}

TEST_F(FigureRender, DrawnShapesTurnWithTheEntityWhoseFrameTheyAreIn)
{
  // The robot at 3, 1.5 looks along y: a box that is turned by 30 degrees in its frame lies at 120 in the arena.
  Drawing drawing;
  drawing.InFrameOf(0);
  drawing.Box({{0, 0, 0}, QuaternionFromYaw(DegreesToRadians(30))}, {0.8, 0.06, 0.1}, {0xff00ff});
  drawing.InSpace();
  drawing.Box({{1, 1.5, 0}, QuaternionFromYaw(DegreesToRadians(30))}, {0.8, 0.06, 0.1}, {0x00ff00});
  world_.Space().SwapDrawing(drawing);
  const Picture picture = Page("");
  const double x = 0.35 * std::cos(DegreesToRadians(30)), y = 0.35 * std::sin(DegreesToRadians(30));
  for (const double side : {-1.0, 1.0})
  {
    EXPECT_EQ(ColourIn(picture, 3 - side * y, 1.5 + side * x), 0xff00ffU);
    EXPECT_EQ(ColourIn(picture, 3 + side * x, 1.5 + side * y), 0xffffffU);
    EXPECT_EQ(ColourIn(picture, 1 + side * x, 1.5 + side * y), 0x00ff00U);
  }
}

TEST_F(FigureRender, TicksArePanelsWithTheirTimes)
{
  EXPECT_EQ(Run("file=\"sheet.pdf\" ticks=\"0, 50,100\" stop=\"true\"", 200), 100);
  EXPECT_EQ(Read("sheet.pdf").substr(0, 5), "%PDF-");
  // Three panels beside each other: (103 - 2 * 1.5 - 2 * 3) / 3 mm for 4 m each.
  const Picture picture = Page("ticks=\"0, 50, 100\"", 100);
  const double scale = 94.0 / 3 / 4, top = kMargin + 1.5 * 7 * 25.4 / 72;
  for (int panel = 0; panel < 3; ++panel)
  {
    const double left = kMargin + panel * (94.0 / 3 + 3);
    EXPECT_EQ(ColourAt(picture, left + scale * (3 - 0.5 * panel + 0.045), top + scale * 0.5), kFirstRobots) << panel;
  }
}

TEST_F(FigureRender, ARunThatEndsEarlierGivesWhatThereIs)
{
  testing::internal::CaptureStderr();
  Run("file=\"sheet.svg\" ticks=\"0, 500\"", 20);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("sheet.svg has 1 of 2 ticks: the run ended at tick 20, before tick 500"));
  EXPECT_THAT(Read("sheet.svg"), HasSubstr("</svg>"));
}

TEST_F(FigureRender, TrailsHaveAllOfTheWay)
{
  const Picture without = Page("", 100);
  const Picture with = Page("show_trails=\"true\"", 100);
  EXPECT_EQ(ColourIn(without, 2.7, 1.5), 0xffffffu);
  EXPECT_NE(ColourIn(with, 2.7, 1.5), 0xffffffu);
  EXPECT_NE(ColourIn(with, 2.98, 1.5), 0xffffffu);
}

TEST_F(FigureRender, LegendsNameWhatIsInTheArena)
{
  world_.Add(EntityKind::kFootbot, "fb_2", {1, 1, 0});
  world_.AddBody(EntityKind::kCylindricPrey, "prey", {2, 1.0, 0}, {0.1, 0.1, 0.1}, 0x00ff00);
  const PlanScene scene(world_.Space(), {});
  std::vector<std::string> texts;
  for (const PlanLegendEntry& entry : scene.Legend()) texts.push_back(entry.text);
  EXPECT_THAT(texts, testing::ElementsAre("2 footbots", "1 cylindric prey"));
}

TEST_F(FigureRender, LegendsSayIfRobotsAreDrawnWiderThanTheyAre)
{
  const std::vector<PlanLegendEntry> legend = PlanScene(world_.Space(), {}).Legend();
  ASSERT_EQ(legend.size(), 1U);
  EXPECT_EQ(LegendText(legend[0], 25), "1 footbot");
  // 100 m on 100 mm: the radius of 0.085 mm is drawn with 0.2, and an edge around it.
  EXPECT_EQ(LegendText(legend[0], 1), "1 footbot, 3.2 times as wide");
}

TEST_F(FigureRender, BarsOfScalesAreRoundAndAtMostAThird)
{
  for (const auto& [panel, bar] :
       {std::pair(4.0, 1.0), {6.0, 2.0}, {15.0, 5.0}, {2.9, 0.5}, {0.3, 0.1}, {1000.0, 200.0}})
    EXPECT_DOUBLE_EQ(ScaleBarLength(panel), bar) << panel;
}

TEST_F(FigureRender, MistakesAreTold)
{
  EXPECT_THAT(ErrorOf("file=\"plan.jpg\""), HasSubstr("it must end with .svg, .pdf or .png"));
  EXPECT_THAT(ErrorOf("ticks=\"10, 5\""), HasSubstr("at most 100 ticks that ascend"));
  EXPECT_THAT(ErrorOf("ticks=\"10,\""), HasSubstr("numbers with commas between them"));
  EXPECT_THAT(ErrorOf("ticks=\"soon\""), HasSubstr("numbers with commas between them"));
  EXPECT_THAT(ErrorOf("region=\"1, 1, 0, 2\""), HasSubstr("with x0 < x1 and y0 < y1"));
  EXPECT_THAT(ErrorOf("inset=\"1, 1, nan, 2\""), HasSubstr("x0, y0, x1, y1 in metres"));
  fs::create_directories(Path("taken.svg"));
  EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { Run("file=\"taken.svg\"", 0); }), HasSubstr("taken.svg"));
}

}  // namespace
}  // namespace swarmanoid
