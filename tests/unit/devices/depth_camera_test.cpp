// The depth camera against rays that are computed here: planes, cylinders and boxes met by formulas of their own.
#include "common/control_interface/ci_depth_camera_sensor.h"

#include <cmath>
#include <random>

#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const CCI_DepthCameraSensor& Image(TestSensor& camera) { return camera.Of<CCI_DepthCameraSensor>(0); }

TEST(DepthCamera, MeasuresAlongItsAxisNotAlongTheRay)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  world.AddBlock({7.1, 5, 1}, {0.2, 8, 2});  // its face at 7
  TestSensor camera(world, "depth_camera", "generic_depth_camera", {robot},
                    {{"position", "0.1, 0, 0.5"}, {"field_of_view", "80"}, {"width", "9"}, {"height", "5"}});
  camera.Update();
  const double of_pixel = 2 * std::tan(40 * kPi / 180) / 9;
  for (unsigned row = 0; row < 5; ++row)
    for (unsigned column = 0; column < 9; ++column)
    {
      const double down = of_pixel * (row - 2.0);
      const double floor = down > 0 ? 0.5 / down : kInfinity;
      const double expected = std::min(1.9, floor);
      EXPECT_NEAR(Image(camera).GetPixel(column, row).depth_m, expected, 1e-12) << column << ", " << row;
      EXPECT_EQ(Image(camera).GetPixel(column, row).colour, expected < 1.9 ? 0xffffffU : 0xc0c0c0U);
    }
  EXPECT_THROW((void)Image(camera).GetPixel(9, 0), std::out_of_range);
  EXPECT_THROW((void)Image(camera).GetPixel(0, 5), std::out_of_range);
}

TEST(DepthCamera, HasRowsFromTheTopAndColumnsFromTheLeft)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5, kPi / 2);
  const auto left = world.AddPrey(4, 7, 0.1, 2);  // looking along y, x falls to the left
  const auto right = world.AddPrey(6, 7, 0.1, 2);
  TestSensor camera(world, "depth_camera", "generic_depth_camera", {robot}, {{"range", "4"}, {"width", "64"}});
  world.Space().GetEntity(left).SetAttribute("colour", 0x00ff00);
  world.Space().GetEntity(right).SetAttribute("colour", 0x0000ff);
  camera.Update();
  const auto middle = [&](std::uint32_t colour)
  {
    double sum = 0, count = 0;
    for (unsigned column = 0; column < 64; ++column)
      if (Image(camera).GetPixel(column, 0).colour == colour)
      {
        sum += column + 0.5;
        ++count;
      }
    return sum / count;
  };
  const double per_tangent = 32 / std::tan(kPi / 6);
  EXPECT_NEAR(middle(0x00ff00), 32 - 0.5 * per_tangent, 1);
  EXPECT_NEAR(middle(0x0000ff), 32 + 0.5 * per_tangent, 1);
  EXPECT_EQ(Image(camera).GetPixel(32, 0).colour, 0U);
  EXPECT_EQ(Image(camera).GetPixel(32, 0).depth_m, kInfinity) << "above the horizon, and nothing in range";
  EXPECT_EQ(Image(camera).GetPixel(32, 23).colour, 0xffffffU) << "the floor";
}

// An upright cylinder: where a ray from `from` enters it, as a multiple of `way`.
double EnterCylinder(const Vector3& from, const Vector3& way, const Vector3& base, double radius, double height)
{
  const Vector3 offset = from - base;
  double low = 0, high = kInfinity;
  const double a = way.x() * way.x() + way.y() * way.y();
  const double b = offset.x() * way.x() + offset.y() * way.y();
  const double c = offset.x() * offset.x() + offset.y() * offset.y() - radius * radius;
  const double root = b * b - a * c;
  if (root < 0) return kInfinity;
  low = std::max(low, (-b - std::sqrt(root)) / a);
  high = std::min(high, (-b + std::sqrt(root)) / a);
  const double at_base = -offset.z() / way.z(), at_top = (height - offset.z()) / way.z();
  low = std::max(low, std::min(at_base, at_top));
  high = std::min(high, std::max(at_base, at_top));
  return low <= high ? low : kInfinity;
}

double EnterBox(const Vector3& from, const Vector3& way, const Vector3& centre, const Vector3& size, double yaw)
{
  double low = 0, high = kInfinity;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Vector3 normal = axis == 0   ? Vector3(std::cos(yaw), std::sin(yaw), 0)
                           : axis == 1 ? Vector3(-std::sin(yaw), std::cos(yaw), 0)
                                       : Vector3(0, 0, 1);
    const double offset = normal.dot(from - centre), speed = normal.dot(way);
    const double first = (-size[axis] / 2 - offset) / speed, second = (size[axis] / 2 - offset) / speed;
    low = std::max(low, std::min(first, second));
    high = std::min(high, std::max(first, second));
  }
  return low <= high ? low : kInfinity;
}

TEST(DepthCamera, AgreesWithRaysThroughRandomScenes)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  int bodies = 0, floors = 0, nothing = 0;
  for (int trial = 0; trial < 60; ++trial)
  {
    const double yaw = 2 * kPi * unit(random), pan = 360 * unit(random) - 180, tilt = -70 + 100 * unit(random);
    const Vector3 place(0.1 * unit(random), 0.1 * unit(random), 0.3 + unit(random));
    const double field = 30 + 90 * unit(random), range = 1 + 3 * unit(random), nearest = 0.3 * unit(random);
    TestWorld world;
    const auto robot = world.AddFootbot(5, 5, yaw);
    struct Body
    {
      bool is_box;
      Vector3 place, size;
      double yaw;
    };
    std::vector<Body> all;
    for (int i = 0; i < 12; ++i)
    {
      const double away = 0.6 + 3 * unit(random), bearing = 2 * kPi * unit(random);
      const double x = 5 + away * std::cos(bearing), y = 5 + away * std::sin(bearing);
      const int engine = i % 3 == 0 ? -1 : 0;
      if (i % 2 == 0)
      {
        const Vector3 size(0.1 + 0.4 * unit(random), 0.1 + 0.4 * unit(random), 0.2 + unit(random));
        all.push_back({true, {x, y, size.z() / 2}, size, 2 * kPi * unit(random)});
        world.AddBlock(all.back().place, size, all.back().yaw, engine);
      }
      else
      {
        const Vector3 size(0.05 + 0.2 * unit(random), 0, 0.2 + unit(random));
        all.push_back({false, {x, y, 0}, size, 0});
        world.AddPrey(x, y, size.x(), size.z(), engine);
      }
    }
    TestSensor camera(
        world, "depth_camera", "generic_depth_camera", {robot},
        {{"position", std::to_string(place.x()) + "," + std::to_string(place.y()) + "," + std::to_string(place.z())},
         {"pan", std::to_string(pan)},
         {"tilt", std::to_string(tilt)},
         {"field_of_view", std::to_string(field)},
         {"range", std::to_string(range)},
         {"nearest", std::to_string(nearest)},
         {"width", "16"},
         {"height", "12"}});
    camera.Update();
    // Angles and places have six digits in the parameters.
    const auto six = [](double value) { return std::stod(std::to_string(value)); };
    const Eigen::Matrix3d turn = (Eigen::AngleAxisd(yaw + six(pan) * kPi / 180, Vector3::UnitZ()) *
                                  Eigen::AngleAxisd(-six(tilt) * kPi / 180, Vector3::UnitY()))
                                     .toRotationMatrix();
    const Vector3 eye = Vector3(5, 5, 0) + Eigen::AngleAxisd(yaw, Vector3::UnitZ()) *
                                               Vector3(six(place.x()), six(place.y()), six(place.z()));
    const double of_pixel = 2 * std::tan(six(field) * kPi / 360) / 16;
    for (unsigned row = 0; row < 12; ++row)
      for (unsigned column = 0; column < 16; ++column)
      {
        const Vector3 way = turn * Vector3(1, of_pixel * (7.5 - column), of_pixel * (5.5 - row));
        double body = kInfinity;
        const Vector3 start = eye + six(nearest) * way;
        for (const Body& other : all)
          body = std::min(body, six(nearest) + (other.is_box ? EnterBox(start, way, other.place, other.size, other.yaw)
                                                             : EnterCylinder(start, way, other.place, other.size.x(),
                                                                             other.size.z())));
        if (body > six(range)) body = kInfinity;
        double floor = way.z() < 0 ? eye.z() / -way.z() : kInfinity;
        if (floor > six(range) || floor < six(nearest)) floor = kInfinity;
        const double depth = Image(camera).GetPixel(column, row).depth_m;
        const double expected = std::min(body, floor);
        if (expected == kInfinity)
          EXPECT_EQ(depth, kInfinity) << trial << ": " << column << ", " << row;
        else
          EXPECT_NEAR(depth, expected, 1e-9) << trial << ": " << column << ", " << row;
        ++(expected == kInfinity ? nothing : body < floor ? bodies : floors);
      }
  }
  EXPECT_GT(bodies, 500);
  EXPECT_GT(floors, 500);
  EXPECT_GT(nothing, 500);
}

TEST(DepthCamera, SeesTheColoursOfTheFloorOfBodiesAndOfLitLeds)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  const auto other = world.AddFootbot(5.4, 5, kPi);
  const auto patch = world.Add(EntityKind::kGroundPatch, {5.2, 5, 0}, 0, {0.1, 0.1, 0}, false, -1);
  world.Add(EntityKind::kHole, {5.2, 5, 0}, 0, {0.01, 0, 0}, false, -1);
  ControllerConfiguration controller;
  controller.id = "directional";
  controller.actuators.push_back(
      {"directional_leds", "generic_directional_leds", TreeOf({{"observable_angle", "20"}})});
  world.Configuration().controllers.push_back(controller);
  const auto colour_at = [&](const char* position, const char* tilt)
  {
    TestSensor camera(world, "depth_camera", "generic_depth_camera", {robot},
                      {{"position", position}, {"tilt", tilt}, {"width", "1"}, {"height", "1"}});
    camera.Update();
    return Image(camera).GetPixel(0, 0).colour;
  };
  world.Space().GetEntity(patch).SetAttribute("colour", 0x204060);
  EXPECT_EQ(colour_at("0.24, 0, 0.5", "-90"), 0x204060U);
  EXPECT_EQ(colour_at("0.2, 0, 0.5", "-90"), 0U) << "the hole";
  EXPECT_EQ(colour_at("0.14, 0, 0.5", "-90"), 0xffffffU) << "beside the patch";
  EXPECT_EQ(colour_at("0.1, 0, 0.02", "0"), 0xc0c0c0U) << "the body";
  // The robot looks at us; its first LED is at 15 degrees of it, at our right.
  world.Space().GetEntity(other).SetAttribute("led", 0xff8000, 0);
  EXPECT_EQ(colour_at("0.1, -0.0233, 0.085", "0"), 0xff8000U);
  EXPECT_EQ(colour_at("0.1, 0.0233, 0.085", "0"), 0xc0c0c0U) << "the other one is off";
  EXPECT_EQ(colour_at("0.1, -0.0233, 0.05", "0"), 0xc0c0c0U) << "below it";
}

TEST(DepthCamera, DoesNotSeeDirectionalLedsFromAside)
{
  for (const char* angle : {"10", "20"})  // the first LED is 15 degrees off
  {
    TestWorld world;
    const auto robot = world.AddFootbot(5, 5);
    const auto other = world.AddFootbot(5.4, 5, kPi);
    ControllerConfiguration controller;
    controller.id = "directional";
    controller.actuators.push_back(
        {"directional_leds", "generic_directional_leds", TreeOf({{"observable_angle", angle}})});
    world.Configuration().controllers.push_back(controller);
    world.Configuration().entities[other].controller = "directional";
    TestSensor camera(world, "depth_camera", "generic_depth_camera", {robot},
                      {{"position", "0.1, -0.0233, 0.085"}, {"width", "1"}, {"height", "1"}});
    world.Space().GetEntity(other).SetAttribute("led", 0xff8000, 0);
    camera.Update();
    EXPECT_EQ(Image(camera).GetPixel(0, 0).colour, angle[0] == '2' ? 0xff8000U : 0xc0c0c0U) << angle;
  }
}

TEST(DepthCamera, DisturbsWhatIsSeenAlone)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  world.AddBlock({6.1, 5, 0.25}, {0.2, 8, 0.5});
  TestSensor camera(world, "depth_camera", "generic_depth_camera", {robot},
                    {{"depth_noise_kind", "uniform"},
                     {"depth_noise_range", "0.1"},
                     {"colour_noise_kind", "uniform"},
                     {"colour_noise_range", "20"},
                     {"position", "0, 0, 0.3"},
                     {"tilt", "10"}});
  camera.Update();
  int wall = 0, sky = 0;
  double least = kInfinity, most = 0;
  for (const auto& pixel : Image(camera).GetAllPixels())
  {
    if (pixel.depth_m == kInfinity)
    {
      EXPECT_EQ(pixel.colour, 0U);
      ++sky;
      continue;
    }
    least = std::min(least, pixel.depth_m);
    most = std::max(most, pixel.depth_m);
    wall += pixel.colour != 0xc0c0c0;
  }
  EXPECT_GT(sky, 50);
  EXPECT_GT(wall, 50);
  EXPECT_GT(most - least, 0.1);
}

}  // namespace
}  // namespace swarmanoid
