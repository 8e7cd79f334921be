// Blob extraction in pixels: noise of the image, read back through the geometry of the camera.
#include "common/control_interface/ci_colour_blob_sensor.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

constexpr int kPictureTicks = 4000;
constexpr double kPixels = 3;  // deviation of each coordinate

struct Pixel
{
  double u, v;
};

// Moments of the places of the one blob in the image, as `to_image` finds them from its readings.
template <class ToImage>
void CheckImageNoise(TestWorld& world, TestSensor& camera, const Pixel& exact, ToImage to_image)
{
  double u = 0, v = 0, uu = 0, vv = 0, uv = 0;
  for (std::uint64_t tick = 1; tick <= kPictureTicks; ++tick)
  {
    world.Space().SetTick(tick);
    camera.Update();
    const auto blobs = camera.Of<CCI_ColourBlobSensor>(0).GetAllBlobs();
    ASSERT_EQ(blobs.size(), 1U);
    const Pixel pixel = to_image(blobs[0]);
    EXPECT_NEAR(pixel.u, std::round(pixel.u), 1e-6) << "whole pixels";
    EXPECT_NEAR(pixel.v, std::round(pixel.v), 1e-6);
    const double du = pixel.u - exact.u, dv = pixel.v - exact.v;
    u += du / kPictureTicks;
    v += dv / kPictureTicks;
    uu += du * du / kPictureTicks;
    vv += dv * dv / kPictureTicks;
    uv += du * dv / kPictureTicks;
  }
  const double deviation = std::sqrt(kPixels * kPixels + 1.0 / 12);  // and that of rounding
  const double error = 4 * deviation / std::sqrt(kPictureTicks);
  EXPECT_NEAR(u, 0, error);
  EXPECT_NEAR(v, 0, error);
  EXPECT_NEAR(std::sqrt(uu), deviation, error);
  EXPECT_NEAR(std::sqrt(vv), deviation, error);
  EXPECT_NEAR(uv, 0, 4 * deviation * deviation / std::sqrt(kPictureTicks)) << "the two are independent";
}

const TestParameters kNoise{{"noise_kind", "gaussian"}, {"noise_deviation", std::to_string(kPixels)}};

void LightRed(TestWorld& world, std::uint32_t robot)
{
  for (int led = 0; led < 12; ++led) world.Space().GetEntity(robot).SetAttribute("led", CCI_Colour::RED, led);
}

TEST(PixelCameras, NoiseOfCamerasThatLookDownIsThatOfTheirImage)
{
  struct Camera
  {
    const char* type;
    bool is_eyebot;
    double height, aperture_degrees;  // height of the eye above the LEDs, and aperture of the view
  };
  for (const Camera& c : {Camera{"footbot_omnidirectional_camera", false, 0.2887 - 0.085, 70},
                          Camera{"eyebot_camera", true, 2 - 0.085, 30}})
  {
    SCOPED_TRACE(c.type);
    TestWorld world;
    c.is_eyebot ? world.AddEyebot(5, 5, 2) : world.AddFootbot(5, 5);
    const auto other = world.AddFootbot(5.3, 5.15);
    LightRed(world, other);
    TestSensor camera(world, c.type, std::string("pixel_noise_") + c.type, {0}, kNoise);
    // Pixels from the middle are proportional to the angle from the axis.
    const double per_radian = 240 / DegreesToRadians(c.aperture_degrees);
    const auto to_image = [&](const CCI_ColourBlob& blob)
    {
      const double radius = std::atan2(blob.distance_m, c.height) * per_radian;
      return Pixel{radius * std::cos(blob.angle_rad), radius * std::sin(blob.angle_rad)};
    };
    CCI_ColourBlob exact;
    exact.distance_m = std::hypot(0.3, 0.15);
    exact.angle_rad = std::atan2(0.15, 0.3);
    CheckImageNoise(world, camera, to_image(exact), to_image);
  }
}

TEST(PixelCameras, NoiseOfTheCameraThatLooksAheadIsThatOfItsImage)
{
  TestWorld world;
  world.Add(EntityKind::kHandbot, {5, 5, 0}, 0, {0.18, 0.17, 0.16});
  const auto other = world.AddFootbot(5.9, 5.2);
  LightRed(world, other);
  TestSensor camera(world, "handbot_camera", "pixel_noise_handbot_camera", {0}, kNoise);
  // A pinhole: pixels are proportional to the tangents, across and upwards.
  const double per_tangent = 240 / std::tan(DegreesToRadians(30));
  const auto to_image = [&](const CCI_ColourBlob& blob)
  {
    const double across = std::tan(blob.angle_rad);
    return Pixel{across * per_tangent, std::tan(blob.elevation_rad) * std::hypot(1, across) * per_tangent};
  };
  const double ahead = 0.9 - 0.09, left = 0.2, up = 0.085 - 0.1;
  CheckImageNoise(world, camera, {left / ahead * per_tangent, up / ahead * per_tangent}, to_image);
}

}  // namespace
}  // namespace swarmanoid
