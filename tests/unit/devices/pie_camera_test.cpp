#include <map>

#include "common/control_interface/ci_pie_camera_sensor.h"
#include "tests/unit/devices/colour_scene.h"

namespace swarmanoid
{
namespace
{

TEST(PieCamera, PutsTheNearestBlobOfEachColourIntoItsSector)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  world.AddFootbot(5.4, 5.05);  // sector 0
  world.AddFootbot(5.9, 5.3);   // sector 0, farther
  world.AddFootbot(5, 5.5);     // 90 degrees: sector 3
  world.AddFootbot(5.4, 4.95);  // sector 11
  TestSensor camera(world, "pie_camera", "generic_pie_camera", {0});
  Paint(world, 1, CCI_Colour::RED);
  Paint(world, 2, 0xa01010);  // a dark red
  Paint(world, 3, CCI_Colour::GREEN);
  Paint(world, 4, CCI_Colour::RED);
  camera.Update();
  const auto& pie = camera.Of<CCI_PieCameraSensor>(0);
  EXPECT_EQ(pie.GetNumSectors(), 12U);
  EXPECT_EQ(pie.GetSlice(CCI_Colour::RED, 0).blobs, 2U);
  EXPECT_NEAR(pie.GetSlice(CCI_Colour::RED, 0).distance_m, std::hypot(0.4, 0.05), 1e-12);
  EXPECT_EQ(pie.GetSlice(CCI_Colour::RED, 11).blobs, 1U);
  EXPECT_EQ(pie.GetSlice(CCI_Colour::RED, 3).distance_m, CCI_PieCameraSensor::NOTHING);
  EXPECT_NEAR(pie.GetSlice(CCI_Colour::GREEN, 3).distance_m, 0.5, 1e-12);
  EXPECT_THROW(pie.GetAllSlices(0x123456), std::invalid_argument);
}

// In a crowd, and again after all have moved: the slices of before are gone.
TEST(PieCamera, CountsTheBlobsOfTheOmnidirectionalCamera)
{
  TestWorld world;
  RandomStream random(6, 6, 6, 6);
  for (int n = 0; n < 100; ++n)
    world.AddFootbot(random.Uniform(0, 10), random.Uniform(0, 10), random.Uniform(-kPi, kPi));
  const auto robots = world.RobotsOf(EntityKind::kFootbot);
  TestSensor pies(world, "pie_camera", "generic_pie_camera", robots);
  TestSensor cameras(world, "footbot_omnidirectional_camera", "generic_footbot_omnidirectional_camera", robots,
                     {{"aperture", "85"}});
  const std::vector<std::uint32_t> palette{CCI_Colour::RED, CCI_Colour::BLUE, 0, 0x705000, CCI_Colour::WHITE};
  std::size_t blobs = 0;
  for (int tick = 0; tick < 3; ++tick)
  {
    for (const std::uint32_t robot : robots)
    {
      Paint(world, robot, palette[random.Below(static_cast<std::uint32_t>(palette.size() - (tick == 2 ? 2 : 0)))]);
      world.Space().SetPose(
          robot, {{random.Uniform(0, 10), random.Uniform(0, 10), 0}, QuaternionFromYaw(random.Uniform(-kPi, kPi))});
    }
    pies.Update();
    cameras.Update();
    for (std::size_t k = 0; k < robots.size(); ++k)
    {
      std::map<std::pair<std::uint32_t, unsigned>, CCI_PieCameraSensor::Slice> expected;
      for (const CCI_ColourBlob& blob : BlobsOf(cameras, k))
      {
        const double turn = blob.angle_rad < 0 ? blob.angle_rad + 2 * kPi : blob.angle_rad;
        auto& slice =
            expected[{CCI_Colour::Nearest(blob.colour), std::min(11U, static_cast<unsigned>(turn * 6 / kPi))}];
        slice.distance_m = std::min(slice.distance_m, blob.distance_m);
        ++slice.blobs;
        ++blobs;
      }
      const auto& pie = pies.Of<CCI_PieCameraSensor>(k);
      for (const std::uint32_t colour : {CCI_Colour::RED, CCI_Colour::GREEN, CCI_Colour::BLUE, CCI_Colour::YELLOW,
                                         CCI_Colour::CYAN, CCI_Colour::MAGENTA, CCI_Colour::WHITE})
        for (unsigned sector = 0; sector < 12; ++sector)
        {
          const CCI_PieCameraSensor::Slice wanted = expected[{colour, sector}];
          ASSERT_EQ(pie.GetSlice(colour, sector).blobs, wanted.blobs) << "tick " << tick << " robot " << k;
          ASSERT_EQ(pie.GetSlice(colour, sector).distance_m, wanted.distance_m);
        }
    }
  }
  EXPECT_GT(blobs, 1500U);
}

TEST(PieCamera, NumberOfSectorsIsAParameter)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  TestSensor camera(world, "pie_camera", "generic_pie_camera", {0}, {{"sectors", "8"}});
  camera.Update();
  EXPECT_EQ(camera.Of<CCI_PieCameraSensor>(0).GetAllSlices(CCI_Colour::BLUE).size(), 8U);
}

}  // namespace
}  // namespace swarmanoid
