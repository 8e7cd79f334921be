// Directional LEDs: cameras see them from within their cones only. Compared with the angle between the axis of an LED
// and the way to the eye, computed here from the places of the documentation.
#include <cmath>
#include <random>

#include "common/control_interface/ci_colour_blob_sensor.h"
#include "common/control_interface/ci_directional_leds_actuator.h"
#include "common/control_interface/ci_pie_camera_sensor.h"
#include "common/plugin_descriptions/led_cones.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

constexpr double kRing = 0.085036758 + 0.005;  // m
constexpr double kLedHeight = 0.085;
constexpr double kEye = 0.2887;

// All robots added so far that are listed get a controller with directional LEDs.
void MakeDirectional(TestWorld& world, const std::vector<std::uint32_t>& robots, const TestParameters& parameters)
{
  ControllerConfiguration controller;
  controller.id = "directional" + std::to_string(world.Configuration().controllers.size());
  controller.actuators.push_back({"directional_leds", "generic_directional_leds", TreeOf(parameters)});
  world.Configuration().controllers.push_back(controller);
  for (const std::uint32_t robot : robots) world.Configuration().entities[robot].controller = controller.id;
}

std::vector<std::uint32_t> ColoursOf(TestSensor& camera, std::size_t k)
{
  std::vector<std::uint32_t> colours;
  for (const CCI_ColourBlob& blob : camera.Of<CCI_ColourBlobSensor>(k).GetAllBlobs()) colours.push_back(blob.colour);
  std::ranges::sort(colours);
  return colours;
}

const TestParameters kWideView{{"aperture", "89"}, {"range", "3"}};

TEST(DirectionalLeds, AreSeenFromWithinTheirConesOnly)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  int seen = 0, unseen = 0;
  for (int trial = 0; trial < 200; ++trial)
  {
    const double limit = 10 + 160 * unit(random);
    const double elevation = -80 + 160 * unit(random);
    const double bearing = 2 * kPi * unit(random), distance = 0.3 + unit(random);
    const double yaw = 2 * kPi * unit(random), turret = 2 * kPi * unit(random);
    const double watcher_yaw = 2 * kPi * unit(random);
    TestWorld world;
    const auto watcher = world.AddFootbot(5, 5, watcher_yaw);
    const auto robot = world.AddFootbot(5 + distance * std::cos(bearing), 5 + distance * std::sin(bearing), yaw);
    MakeDirectional(world, {robot},
                    {{"observable_angle", std::to_string(limit)}, {"elevation", std::to_string(elevation)}});
    TestSensor camera(world, "footbot_omnidirectional_camera", "generic_footbot_omnidirectional_camera", {watcher},
                      kWideView);
    CSwarmanoidSpaceEntity& lit = world.Space().GetEntity(robot);
    lit.SetAttribute("turret_angle", turret);
    std::vector<std::uint32_t> expected;
    bool is_close = false;
    const Vector3 eye(5, 5, kEye);
    for (int led = 0; led < 12; ++led)
    {
      const std::uint32_t colour = 0x100000U + static_cast<std::uint32_t>(led);
      lit.SetAttribute("led", colour, led);
      const double angle = yaw + turret + (led + 0.5) * kPi / 6;
      const Vector3 place = lit.GetPosition() + Vector3(kRing * std::cos(angle), kRing * std::sin(angle), kLedHeight);
      const double up = elevation * kPi / 180;
      const Vector3 axis(std::cos(up) * std::cos(angle), std::cos(up) * std::sin(angle), std::sin(up));
      const double off = std::acos(std::clamp(axis.dot((eye - place).normalized()), -1.0, 1.0)) * 180 / kPi;
      is_close |= std::abs(off - limit) < 1e-6;
      if (off <= limit) expected.push_back(colour);
    }
    if (is_close) continue;
    camera.Update();
    EXPECT_EQ(ColoursOf(camera, 0), expected) << trial;
    seen += static_cast<int>(expected.size());
    unseen += 12 - static_cast<int>(expected.size());
  }
  EXPECT_GT(seen, 400);
  EXPECT_GT(unseen, 400);
}

// An eyebot that leans sees fewer; one that is tilted itself shows them to others.
TEST(DirectionalLeds, TurnWithTheWholeRobot)
{
  for (const double lean : {0.0, kPi / 2})
  {
    TestWorld world;
    const auto watcher = world.AddEyebot(5, 5, 2.5);
    const auto robot = world.AddEyebot(5.3, 5, 1);
    world.Configuration().entities[robot].pose.orientation = Quaternion(Eigen::AngleAxisd(lean, Vector3::UnitY()));
    MakeDirectional(world, {robot}, {{"observable_angle", "30"}});
    TestSensor camera(world, "eyebot_camera", "generic_eyebot_camera", {watcher}, {{"aperture", "70"}});
    for (int led = 0; led < 16; ++led) world.Space().GetEntity(robot).SetAttribute("led", 0xff0000, led);
    camera.Update();
    int expected = 0;
    for (int led = 0; led < 16; ++led)
    {
      const double angle = (led + 0.5) * kPi / 8;
      const auto turned = [&](const Vector3& v)
      {
        return Vector3(std::cos(lean) * v.x() + std::sin(lean) * v.z(), v.y(),
                       std::cos(lean) * v.z() - std::sin(lean) * v.x());
      };
      const Vector3 axis(std::cos(angle), std::sin(angle), 0);
      const Vector3 place = Vector3(5.3, 5, 1) + turned(0.255 * axis + Vector3(0, 0, 0.1535));
      expected += turned(axis).dot((Vector3(5, 5, 2.5) - place).normalized()) >= std::cos(kPi / 6);
    }
    EXPECT_EQ(ColoursOf(camera, 0).size(), static_cast<std::size_t>(expected)) << lean;
    EXPECT_EQ(expected > 0, lean > 0);
  }
}

TEST(DirectionalLeds, OfOneColourAreBlobsOfTheirOwnAndABeaconIsSeenFromAllSides)
{
  TestWorld world;
  const auto watcher = world.AddFootbot(5, 5);
  const auto robot = world.AddFootbot(5.5, 5);
  const auto plain = world.AddFootbot(5, 5.5);
  MakeDirectional(world, {robot}, {{"observable_angle", "60"}});
  TestSensor camera(world, "footbot_omnidirectional_camera", "generic_footbot_omnidirectional_camera", {watcher},
                    kWideView);
  TestSensor pie(world, "pie_camera", "generic_pie_camera", {watcher}, {{"aperture", "89"}});
  for (const std::uint32_t who : {robot, plain})
    for (int led = 0; led < 12; ++led) world.Space().GetEntity(who).SetAttribute("led", CCI_Colour::RED, led);
  world.Space().GetEntity(robot).SetAttribute("beacon", CCI_Colour::BLUE);
  camera.Update();
  pie.Update();
  // The LEDs at 165 and 195 degrees are 15 degrees off the way to the watcher, and a little more upwards. Those at 135
  // and 225 degrees are 45 degrees off, and those at 105 degrees 75 degrees.
  const std::vector<std::uint32_t> expected{CCI_Colour::BLUE, CCI_Colour::RED, CCI_Colour::RED,
                                            CCI_Colour::RED,  CCI_Colour::RED, CCI_Colour::RED};
  EXPECT_EQ(ColoursOf(camera, 0), expected);
  unsigned red = 0;
  for (const auto& slice : pie.Of<CCI_PieCameraSensor>(0).GetAllSlices(CCI_Colour::RED)) red += slice.blobs;
  EXPECT_EQ(red, 5U);
}

TEST(DirectionalLeds, AreSetAsARing)
{
  TestWorld world;
  const auto footbot = world.AddFootbot(5, 5);
  TestActuator device(world, "directional_leds", "generic_directional_leds", {footbot}, {{"observable_angle", "45"}});
  auto& leds = device.Of<CCI_DirectionalLedsActuator>(0);
  EXPECT_EQ(leds.GetNumLeds(), 12U);
  EXPECT_NEAR(leds.GetObservableAngle(), kPi / 4, 1e-15);
  EXPECT_THROW(leds.SetColour(12, 0xff), std::out_of_range);
  leds.SetColour(3, 0xff00ff);
  device.Commit();
  ASSERT_EQ(device.changes.slots.size(), 1U);
  EXPECT_EQ(device.changes.slots[0], world.Space().GetEntity(footbot).SlotOf("led") + 3);
  EXPECT_EQ(device.changes.values[0], 0xff00ff);
}

TEST(DirectionalLeds, LookWhereTheirKindSays)
{
  LedLayout layout{PlacesOnCircle(2, 0.1, 0), 0.05, false, {{0, 0, 2}, {0, -1, 0}}};
  EXPECT_EQ(AxesOf(layout, 1), (std::vector<Vector3>{{0, 0, 1}, {0, -1, 0}}));
  layout.directions.clear();
  const std::vector<Vector3> outwards = AxesOf(layout, kPi / 6);
  EXPECT_LT((outwards[0] - Vector3(std::cos(kPi / 6), 0, 0.5)).norm(), 1e-15);
  EXPECT_LT((outwards[1] - Vector3(-std::cos(kPi / 6), 0, 0.5)).norm(), 1e-15);
}

}  // namespace
}  // namespace swarmanoid
