#include "visualiser/scene/camera.h"

#include <gtest/gtest.h>

#include "common/configuration/xml_reader.h"
#include "common/plugin_descriptions/describe_builtins.h"
#include "common/plugin_descriptions/renderers.h"
#include "tests/unit/visualiser/look_at.h"
#include "visualiser/scene/viewpoints.h"

namespace swarmanoid
{
namespace
{

void ExpectNear(const Vector3& a, const Vector3& b, double tolerance = 1e-9)
{
  EXPECT_LE((a - b).norm(), tolerance) << a.transpose() << " and " << b.transpose();
}

Camera Somewhere()
{
  Camera camera;
  camera.position = {3.3, 3.4, 1.2};
  camera.heading = 39;
  camera.pitch = -34;
  camera.roll = 5;
  return camera;
}

TEST(Camera, HeadingPitchAndRollAreThoseOfTheExperimentFiles)
{
  Camera camera;
  ExpectNear(camera.Forward(), {1, 0, 0});
  ExpectNear(camera.Right(), {0, -1, 0});
  camera.heading = 90;
  ExpectNear(camera.Forward(), {0, 1, 0});
  camera.pitch = -90;
  ExpectNear(camera.Forward(), {0, 0, -1});
  ExpectNear(camera.Up(), {0, 1, 0});
}

TEST(Camera, RayThroughAPixelMeetsThePointThatIsProjectedThere)
{
  const Camera camera = Somewhere();
  const Vector3 point(4.1, 4.0, 0.2);
  const Vector3 pixel = camera.Project(point, 800, 600);
  const Ray ray = camera.RayThrough(pixel.x(), pixel.y(), 800, 600);
  ExpectNear(ray.direction, (point - camera.position).normalized());
  EXPECT_LT(camera.Project(camera.position - camera.Forward(), 800, 600).z(), 0);
}

TEST(Camera, MatricesAgreeWithProject)
{
  const Camera camera = Somewhere();
  const Vector3 point(4.1, 4.0, 0.2);
  const Eigen::Vector4f clip =
      camera.Projection(800.0 / 600, 0.1, 50) * camera.View() * point.cast<float>().homogeneous();
  const Vector3 pixel = camera.Project(point, 800, 600);
  EXPECT_NEAR((clip.x() / clip.w() + 1) * 400, pixel.x(), 1e-2);
  EXPECT_NEAR((1 - clip.y() / clip.w()) * 300, pixel.y(), 1e-2);
  EXPECT_NEAR(clip.w(), pixel.z(), 1e-4);
}

TEST(Camera, LookAtPutsThePointInTheMiddle)
{
  const Camera camera = LookAt({5, -2, 3}, {1, 1, 0.5});
  ExpectNear(camera.Project({1, 1, 0.5}, 640, 480), {320, 240, Vector3(4, -3, 2.5).norm()}, 1e-6);
}

TEST(Camera, OrbitKeepsThePointInPlace)
{
  Camera camera = Somewhere();
  camera.roll = 0;
  const Vector3 about = PointOnFloor(camera.RayThrough(320, 240, 640, 480), 0, 5);
  const double distance = (camera.position - about).norm();
  camera.Orbit(about, 40, 12);
  EXPECT_NEAR((camera.position - about).norm(), distance, 1e-9);
  const Vector3 pixel = camera.Project(about, 640, 480);
  EXPECT_NEAR(pixel.x(), 320, 1e-6);
  EXPECT_NEAR(pixel.y(), 240, 1e-6);
  camera.Orbit(about, 0, 500);
  EXPECT_GE(camera.pitch, -89.5);
}

TEST(Camera, OrbitTurnsTheNearSideWithTheDrag)
{
  Camera camera = LookAt({4, 1, 2}, {4, 4, 0});
  const Vector3 about(4, 4, 0);
  const Vector3 near(4, 3, 0);
  const double pitch = camera.pitch;
  camera.Orbit(about, 20, 10);
  EXPECT_NEAR(camera.heading, 70, 1e-9);
  EXPECT_NEAR(camera.pitch, pitch - 10, 1e-9);
  EXPECT_GT(camera.Project(near, 640, 480).x(), 320);
}

TEST(Camera, TheFieldOfViewIsTheAngleOfThePicturesHeight)
{
  Camera camera;
  camera.field_of_view = 60;
  ExpectNear(camera.RayThrough(400, 0, 800, 600).direction, {std::sqrt(0.75), 0, 0.5});
  ExpectNear(camera.RayThrough(400, 600, 800, 600).direction, {std::sqrt(0.75), 0, -0.5});
}

TEST(Camera, ZoomMovesAlongTheLineToThePoint)
{
  Camera camera = Somewhere();
  const Vector3 at(4, 4, 0);
  const Vector3 before = camera.Project(at, 640, 480);
  camera.Zoom(at, 0.5);
  const Vector3 after = camera.Project(at, 640, 480);
  EXPECT_NEAR(after.x(), before.x(), 1e-6);
  EXPECT_NEAR(after.y(), before.y(), 1e-6);
  EXPECT_NEAR(after.z(), before.z() / 2, 1e-9);
}

TEST(Camera, FrameBoxShowsAllCornersAndFillsThePicture)
{
  for (const double aspect : {0.6, 1.0, 1.333, 2.4})
    for (const double heading : {0.0, 62.0, 200.0})
      for (const double pitch : {-90.0, -38.0, -5.0})
      {
        const Vector3 low(-1, 2, 0), high(7, 5, 1.5);
        const Camera camera = FrameBox(low, high, aspect, heading, pitch);
        double widest = 0;
        for (int corner = 0; corner < 8; ++corner)
        {
          const Vector3 point(corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(),
                              corner & 4 ? high.z() : low.z());
          const Vector3 pixel = camera.Project(point, 1000 * aspect, 1000);
          ASSERT_GT(pixel.z(), 0);
          const double x = std::abs(pixel.x() / (500 * aspect) - 1);
          const double y = std::abs(pixel.y() / 500 - 1);
          widest = std::max({widest, x, y});
        }
        EXPECT_LT(widest, 1) << aspect << " " << heading << " " << pitch;
        EXPECT_GT(widest, 0.85) << aspect << " " << heading << " " << pitch;
      }
}

TEST(Camera, FrameBoxShowsAllCornersBesideHiddenEdges)
{
  for (const HiddenEdges& hidden : {HiddenEdges{0.3, 0, 0.1}, HiddenEdges{0.1, 0.35, 0}, HiddenEdges{0, 0, 0.5}})
    for (const double pitch : {-90.0, -38.0})
    {
      const Vector3 low(0, 0, 0), high(3, 3, 0.35);
      const Camera camera = FrameBox(low, high, 4.0 / 3, 62, pitch, 45, hidden);
      double left = 1, right = 0, upper = 1, lower = 0;  // as shares of the picture
      for (int corner = 0; corner < 8; ++corner)
      {
        const Vector3 point(corner & 1 ? 3 : 0, corner & 2 ? 3 : 0, corner & 4 ? 0.35 : 0);
        const Vector3 share = camera.Project(point, 4.0 / 3, 1);
        left = std::min(left, share.x() * 0.75);
        right = std::max(right, share.x() * 0.75);
        upper = std::min(upper, share.y());
        lower = std::max(lower, share.y());
      }
      EXPECT_GT(left, hidden.left);
      EXPECT_LT(right, 1 - hidden.right);
      EXPECT_GT(upper, 0);
      EXPECT_LT(lower, 1 - hidden.bottom);
      // It fills the free area in one direction, and stands in its middle.
      const double width = 1 - hidden.left - hidden.right;
      EXPECT_GT(std::max((right - left) / width, (lower - upper) / (1 - hidden.bottom)), 0.9);
      EXPECT_NEAR(left - hidden.left, 1 - hidden.right - right, 0.25 * width);
    }
}

TConfigurationTree Tree(const std::string& inner)
{
  return TConfigurationTree(ReadXml("<r>" + inner + "</r>", "views.xml"));
}

TEST(Viewpoints, AreReadAsInTheSampleAndWrittenAgain)
{
  const std::string xml =
      "<camera_view_XYZ_0>3.30811, 3.36071, 1</camera_view_XYZ_0>\n<camera_view_HPR_0>39, -34, 0</camera_view_HPR_0>";
  const auto specs = ViewpointParameters();
  const Viewpoints views(Parameters(Tree(xml + "<camera_view_XYZ_2>1,2,3</camera_view_XYZ_2>"), specs));
  ASSERT_TRUE(views.At(0).has_value());
  EXPECT_DOUBLE_EQ(views.At(0)->position.y(), 3.36071);
  EXPECT_DOUBLE_EQ(views.At(0)->pitch, -34);
  EXPECT_FALSE(views.At(1).has_value());
  EXPECT_DOUBLE_EQ(views.At(2)->heading, 0);
  EXPECT_DOUBLE_EQ(views.First()->heading, 39);
  EXPECT_EQ(ViewpointXml(0, *views.At(0)), xml);
}

TEST(Viewpoints, OfAnExperimentAreThoseOfItsFirstVisualisationThatHasSome)
{
  DescribeBuiltinRenderers();
  Experiment experiment;
  const auto add = [&](const char* tag, const std::string& inner) {
    experiment.visualisations.push_back({tag, tag, Tree(inner), {}});
  };
  EXPECT_FALSE(Viewpoints::Of(experiment).First().has_value());
  add("text_render", "<camera_view_XYZ_0>9, 9, 9</camera_view_XYZ_0>");  // it knows no such thing
  add("image_render", "");
  add("opengl_render", "<camera_view_XYZ_3>1, 2, 3</camera_view_XYZ_3>");
  add("ogre_render", "<camera_view_XYZ_0>7, 7, 7</camera_view_XYZ_0>");
  const Viewpoints views = Viewpoints::Of(experiment);
  EXPECT_FALSE(views.At(0).has_value());
  ASSERT_TRUE(views.At(3).has_value());
  EXPECT_EQ(views.At(3)->position, Vector3(1, 2, 3));
}

TEST(Viewpoints, CameraIsANumberOrAPlaceOrTop)
{
  const auto specs = ViewpointParameters();
  const Viewpoints views(Parameters(Tree("<camera_view_XYZ_4>1,2,3</camera_view_XYZ_4>"), specs));
  Experiment experiment;
  experiment.arena_size = {4, 4, 2};
  const auto camera = [&](const std::string& text) { return CameraFromText(text, views, experiment, 1.5, {}); };
  ExpectNear(camera("4").position, {1, 2, 3});
  ExpectNear(camera("1, 2, 3.5/90,-20,0").position, {1, 2, 3.5});
  EXPECT_DOUBLE_EQ(camera("1,2,3/90,-20,0").heading, 90);
  ExpectNear(camera("top").Forward(), {0, 0, -1});
  ExpectNear(camera("top").Right(), {1, 0, 0});  // the view is that of a map
  EXPECT_THROW(camera("5"), ConfigurationError);
  EXPECT_THROW(camera("above"), ConfigurationError);
  EXPECT_THROW(camera("1,2"), ConfigurationError);
  ExpectNear(camera("1, 2, 3.5 /90,-20,0 ").position, {1, 2, 3.5});
  EXPECT_THROW(camera("1,2,3 m/90,-20,0"), ConfigurationError);
  EXPECT_THROW(camera("1,2,3/90,-20,0 x"), ConfigurationError);
}

}  // namespace
}  // namespace swarmanoid
