// The positions of the LEDs and beacons of the three robots, measured with the camera of a handbot, are those of the
// documentation.
#include "common/control_interface/ci_colour_blob_sensor.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

struct Ring
{
  EntityKind robot;
  int leds;
  double radius, height;  // m
  double beacon_height;   // m, 0: none
};

class LedPlaces : public testing::TestWithParam<Ring>
{
};

TEST_P(LedPlaces, AreThoseOfTheDocumentation)
{
  const Ring& ring = GetParam();
  TestWorld world;
  world.Add(EntityKind::kHandbot, {5, 5, 0}, 0, {0.22, 0.17, 0.16});
  const Vector3 place(6, 5.1, 0.2);
  const double yaw = 0.4;
  const std::uint32_t robot = ring.robot == EntityKind::kFootbot ? world.AddFootbot(6, 5.1, yaw, 0.2)
                              : ring.robot == EntityKind::kEyebot
                                  ? world.AddEyebot(6, 5.1, 0.2, yaw)
                                  : world.Add(ring.robot, place, yaw, {0.22, 0.17, 0.16});
  TestSensor camera(world, "handbot_camera", "generic_handbot_camera", {0}, {{"aperture", "60"}});
  CSwarmanoidSpaceEntity& entity = world.Space().GetEntity(robot);
  const double turret = ring.robot == EntityKind::kFootbot ? 0.7 : 0;
  if (turret != 0) entity.SetAttribute("turret_angle", turret);

  // The one blob that is seen is there, from the eye 9 cm ahead of the axis and 10 cm high.
  const auto expect_blob_at = [&](const Vector3& expected)
  {
    camera.Update();
    const auto blobs = camera.Of<CCI_ColourBlobSensor>(0).GetAllBlobs();
    ASSERT_EQ(blobs.size(), 1U);
    const Vector3 seen(std::cos(blobs[0].elevation_rad) * std::cos(blobs[0].angle_rad),
                       std::cos(blobs[0].elevation_rad) * std::sin(blobs[0].angle_rad),
                       std::sin(blobs[0].elevation_rad));
    EXPECT_LT((Vector3(5.09, 5, 0.1) + blobs[0].distance_m * seen - expected).norm(), 1e-9);
  };
  for (int led = 0; led < ring.leds; ++led)
  {
    SCOPED_TRACE(led);
    entity.SetAttribute("led", CCI_Colour::RED, led);
    const double angle = yaw + turret + (led + 0.5) * 2 * kPi / ring.leds;
    expect_blob_at(place + Vector3(ring.radius * std::cos(angle), ring.radius * std::sin(angle), ring.height));
    entity.SetAttribute("led", 0, led);
  }
  if (ring.beacon_height == 0) return;
  entity.SetAttribute("beacon", CCI_Colour::BLUE);
  expect_blob_at(place + Vector3(0, 0, ring.beacon_height));
}

INSTANTIATE_TEST_SUITE_P(Robots, LedPlaces,
                         testing::Values(Ring{EntityKind::kFootbot, 12, 0.085036758 + 0.005, 0.085, 0.174},
                                         Ring{EntityKind::kEyebot, 16, 0.255, 0.1535, 0},
                                         Ring{EntityKind::kHandbot, 12, 0.09, 0.08, 0.17}),
                         [](const auto& test) { return std::string(TagName(test.param.robot)); });

}  // namespace
}  // namespace swarmanoid
