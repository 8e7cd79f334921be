// The drawings of experiment functions in the form for renderers of pictures.
#include "visualiser/scene/drawn_marks.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "common/space/drawn_state.h"
#include "tests/unit/visualiser/small_world.h"

namespace swarmanoid
{
namespace
{

using Eigen::Vector3f;

class DrawnMarksTest : public ::testing::Test
{
protected:
  DrawnMarksTest() : world_({4, 4, 1}) { world_.Add(EntityKind::kFootbot, "fb", {1, 2, 0}, 90); }
  const DrawnMarks& Cut()
  {
    Drawing drawing = drawing_;
    world_.Space().SwapDrawing(drawing);
    CutDrawing(world_.Space(), marks_);
    return marks_;
  }

  SmallWorld world_;
  Drawing drawing_;
  DrawnMarks marks_;
};

TEST_F(DrawnMarksTest, AreInTheSpaceOrInTheFrameOfAnEntity)
{
  drawing_.Segment({0, 0, 0}, {1, 0, 0}, {0x123456, 0.5, 2});
  drawing_.InFrameOf(0);
  drawing_.Segment({0, 0, 0.1}, {1, 0, 0.1});
  drawing_.Text({0, 0, 0.3}, "fb");
  const DrawnMarks& marks = Cut();
  ASSERT_EQ(marks.lines.size(), 2U);
  EXPECT_EQ(marks.lines[0].to, Vector3f(1, 0, 0));
  EXPECT_EQ(marks.lines[0].colour, 0x123456U);
  EXPECT_NEAR(marks.lines[0].opacity, 0.5, 0.01);
  EXPECT_EQ(marks.lines[0].width, 2);
  // It is turned by a quarter.
  EXPECT_TRUE(marks.lines[1].from.isApprox(Vector3f(1, 2, 0.1F), 1e-5F));
  EXPECT_TRUE(marks.lines[1].to.isApprox(Vector3f(1, 3, 0.1F), 1e-5F)) << marks.lines[1].to.transpose();
  ASSERT_EQ(marks.texts.size(), 1U);
  EXPECT_TRUE(marks.texts[0].place.isApprox(Vector3f(1, 2, 0.3F), 1e-5F));
  EXPECT_EQ(marks.texts[0].text, "fb");
}

TEST_F(DrawnMarksTest, MoveWithTheirEntityAndGoWithIt)
{
  drawing_.InFrameOf(0);
  drawing_.Point({0.5, 0, 0});
  Cut();
  world_.Space().SetPose(0, {{3, 3, 0}, Quaternion::Identity()});
  CutDrawing(world_.Space(), marks_);
  ASSERT_EQ(marks_.dots.size(), 1U);
  EXPECT_TRUE(marks_.dots[0].place.isApprox(Vector3f(3.5F, 3, 0), 1e-5F));
  world_.Space().SetAttribute(world_.Space().PresenceSlot(0), 0);
  CutDrawing(world_.Space(), marks_);
  EXPECT_TRUE(marks_.dots.empty());
}

TEST_F(DrawnMarksTest, BodiesAreClosedAndTurnOutwards)
{
  drawing_.Box({{1, 1, 1}, QuaternionFromYaw(0.3)}, {1, 2, 3});
  drawing_.Cylinder({{2, 2, 0.5}, Quaternion::Identity()}, 0.5, 1);
  Cut();
  EXPECT_EQ(marks_.triangles.size(), 12U + 4 * 36);
  // Twice the volume of tetrahedra to a place inside: of the box 6, of the cylinder nearly pi/4.
  double volumes[2] = {};
  for (std::size_t k = 0; k < marks_.triangles.size(); ++k)
  {
    const auto& [a, b, c] = marks_.triangles[k].corners;
    const Vector3f middle = k < 12 ? Vector3f(1, 1, 1) : Vector3f(2, 2, 0.5F);
    volumes[k < 12 ? 0 : 1] += static_cast<double>((a - middle).dot((b - middle).cross(c - middle))) / 6;
  }
  EXPECT_NEAR(volumes[0], 6, 1e-4);
  EXPECT_NEAR(volumes[1], kPi / 4, 0.01);
}

TEST_F(DrawnMarksTest, AreasHaveTheirColourAndLinesCloseCircles)
{
  const Vector3 corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  drawing_.Polygon(corners, {0x00ff00});
  drawing_.Disc({{2, 2, 0}, Quaternion::Identity()}, 1, {0x0000ff, 0.5});
  drawing_.Circle({{2, 2, 0}, Quaternion::Identity()}, 1);
  drawing_.Arrow({0, 0, 0}, {1, 0, 0});
  Cut();
  EXPECT_EQ(marks_.triangles.size(), 2U + 36 + 1);
  EXPECT_EQ(marks_.triangles[0].colour, 0x00ff00U) << "without light";
  ASSERT_EQ(marks_.lines.size(), 36U + 1);
  EXPECT_TRUE(marks_.lines[0].from.isApprox(marks_.lines[35].to, 1e-5F));
}

TEST(DrawnWind, IsAnArrowWithItsSpeedInTheCornerAtTheOrigin)
{
  SmallWorld calm({4, 4, 1});
  DrawnMarks marks;
  CutDrawing(calm.Space(), marks);
  EXPECT_TRUE(marks.lines.empty());
  EXPECT_FALSE(DrawnState(calm.Space()).Changes());

  SmallWorld world({4, 6, 1});
  world.GetExperiment().wind = WindConfiguration{{-0.3, 0.4, 0}, 0, 3};
  CutDrawing(world.Space(), marks);
  ASSERT_EQ(marks.lines.size(), 1U);
  const Vector3f way = marks.lines[0].to - marks.lines[0].from;
  EXPECT_TRUE(way.isApprox(0.8F * Vector3f(-0.6F, 0.8F, 0), 1e-4F)) << way.transpose();
  for (const Vector3f& end : {marks.lines[0].from, marks.lines[0].to})
    EXPECT_TRUE((end.array() > 0).all() && end.x() < 1.2F && end.y() < 1.2F) << end.transpose();
  ASSERT_EQ(marks.texts.size(), 1U);
  EXPECT_EQ(marks.texts[0].text, "wind 0.50 m/s");
}

TEST(DrawnWind, FollowsItsGusts)
{
  SmallWorld world({4, 4, 1});
  world.GetExperiment().wind = WindConfiguration{{1, 0, 0}, 5, 3};
  const DrawnState state(world.Space());
  DrawnMarks before, after;
  CutDrawing(state, before);
  world.Space().SetTick(100);
  CutDrawing(state, after);
  const Vector3 air = Wind(world.GetExperiment()).At({2, 2, 0.5}, world.Space().GetTime());
  EXPECT_EQ(after.texts.at(0).text, fmt::format("wind {:.2f} m/s", air.norm()));
  EXPECT_NE(after.texts.at(0).text, before.texts.at(0).text);
}

}  // namespace
}  // namespace swarmanoid
