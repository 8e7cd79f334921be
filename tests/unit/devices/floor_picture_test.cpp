// The readings of ground sensors on a picture on the floor equal the pixels that the test has painted.
#include <png.h>
#include <unistd.h>

#include "common/control_interface/footbot/ci_footbot_base_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_ground_sensor.h"
#include "common/math/random.h"
#include "common/space/terrain/floor_picture.h"
#include "tests/unit/devices/test_world.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

class PictureFile
{
public:
  PictureFile(int columns, const std::vector<std::uint32_t>& pixels)
  {
    std::vector<std::uint8_t> bytes;
    for (const std::uint32_t pixel : pixels)
      for (const unsigned shift : {16U, 8U, 0U}) bytes.push_back(static_cast<std::uint8_t>(pixel >> shift));
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(columns);
    image.height = static_cast<png_uint_32>(pixels.size() / static_cast<std::size_t>(columns));
    image.format = PNG_FORMAT_RGB;
    if (png_image_write_to_file(&image, Path().c_str(), 0, bytes.data(), 0, nullptr) == 0)
      throw std::runtime_error("cannot write " + Path());
  }
  std::string Path() const { return folder_ / "floor.png"; }

private:
  test::TemporaryFolder folder_;
};

TEST(FloorPicture, ColoursSeenThroughATintAreProducts)
{
  EXPECT_EQ(Tinted(0x123456, 0xffffff), 0x123456U);
  EXPECT_EQ(Tinted(0xffffff, 0x123456), 0x123456U);
  EXPECT_EQ(Tinted(0xff8000, 0x0000ff), 0U);
  EXPECT_EQ(Tinted(0x808080, 0x808080), 0x404040U);  // 64.25
}

// 3 by 2 pixels on 3 by 2 m with its middle at (5, 5), first as it is, then turned by a quarter.
TEST(FloorPicture, TheUpperLeftPixelIsAtTheLeastXAndTheLargestY)
{
  const PictureFile file(3, {0xff0000, 0x00ff00, 0x0000ff, 0x111111, 0x222222, 0x333333});
  for (const bool turned : {false, true})
  {
    TestWorld world;
    world.AddFootbot(5, 5);
    const auto patch = world.Add(EntityKind::kGroundPatch, {5, 5, 0}, turned ? kPi / 2 : 0, {3, 2, 0}, false, -1);
    world.Configuration().entities[patch].tree = TreeOf({{"picture", file.Path()}});
    world.Configuration().entities[patch].colour = 0xffffff;
    TestSensor sensor(world, "footbot_ground", "generic_footbot_ground", {0});
    const auto colour_at = [&](double x, double y)
    {
      const Vector3 place = turned ? Vector3(5 - y, 5 + x, 0) : Vector3(5 + x, 5 + y, 0);
      world.Space().SetPose(0, {place, Quaternion::Identity()});
      sensor.Update();
      return sensor.Of<CCI_FootBotGroundSensor>(0).GetFloorColour();
    };
    EXPECT_EQ(colour_at(-1, 0.5), 0xff0000U);
    EXPECT_EQ(colour_at(0, 0.5), 0x00ff00U);
    EXPECT_EQ(colour_at(1, 0.5), 0x0000ffU);
    EXPECT_EQ(colour_at(-1, -0.5), 0x111111U);
    EXPECT_EQ(colour_at(1.49, -0.99), 0x333333U);
    EXPECT_EQ(colour_at(1.51, -0.5), 0xffffffU);  // beside it

    world.Space().GetEntity(patch).SetAttribute("colour", 0xff00ff);  // an experiment tints it
    EXPECT_EQ(colour_at(0, 0.5), 0U);
    EXPECT_EQ(colour_at(0, -0.5), 0x220022U);
  }
}

// Each sensor reads the pixel below it, not that below the robot.
TEST(FloorPicture, EachSensorReadsItsOwnPixel)
{
  using Places = CCI_FootBotBaseGroundSensor;
  constexpr int kSide = 200;  // pixels of 1 cm: 2 m
  std::vector<std::uint32_t> pixels;
  RandomStream random(5, 1, 1, 1);
  for (int k = 0; k < kSide * kSide; ++k)
    pixels.push_back(0x010101 * static_cast<std::uint32_t>(random.Uniform(0, 255)));
  const PictureFile file(kSide, pixels);
  TestWorld world;
  world.AddFootbot(5, 5);
  const auto patch = world.Add(EntityKind::kGroundPatch, {5, 5, 0}, 0, {2, 2, 0}, false, -1);
  world.Configuration().entities[patch].tree = TreeOf({{"picture", file.Path()}});
  world.Configuration().entities[patch].colour = 0xffffff;
  TestSensor sensor(world, "footbot_ground", "generic_footbot_ground", {0});
  const std::span<const double> readings = sensor.Of<CCI_FootBotGroundSensor>(0).GetAllSensorReadings();
  for (int n = 0; n < 50; ++n)
  {
    const Vector3 place(random.Uniform(4.2, 5.8), random.Uniform(4.2, 5.8), 0);
    world.Space().SetPose(0, {place, Quaternion::Identity()});
    sensor.Update();
    for (std::size_t i = 0; i < Places::NUM_SENSORS; ++i)
    {
      const auto& [x, y] = Places::PLACES_M[i];
      const auto column = static_cast<int>((place.x() + x - 4) * 100);
      const auto row = kSide - 1 - static_cast<int>((place.y() + y - 4) * 100);
      const std::uint32_t pixel = pixels[static_cast<std::size_t>(row * kSide + column)];
      EXPECT_NEAR(readings[i], (pixel & 0xff) / 255.0, 1e-12) << i;
    }
  }
}

}  // namespace
}  // namespace swarmanoid
