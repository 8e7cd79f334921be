#include "common/space/terrain/terrain.h"
#include "common/space/terrain/rough_terrain.h"

#include <gmock/gmock.h>

#include <octomap/ColorOcTree.h>
#include <octomap/OcTreeStamped.h>
#include <octomap/octomap.h>
#include <png.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/math/random.h"
#include "common/space/space_query.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

// It is a real corridor, part of Debian's liboctomap-dev.
constexpr const char* kBuilding = "/usr/share/doc/liboctomap-dev/examples/data/geb079.bt";

class TemporaryFile
{
public:
  explicit TemporaryFile(const std::string& name) : name_(name) {}
  std::string Path() const { return folder_ / name_; }

private:
  test::TemporaryFolder folder_;
  std::string name_;
};

TEST(VoxelTerrain, TheRealBuildingIsSolidWhereItsTreeIsOccupied)
{
  if (!std::filesystem::exists(kBuilding)) GTEST_SKIP() << kBuilding << " is not installed";
  octomap::OcTree tree(kBuilding);
  const VoxelTerrain terrain(kBuilding);
  RandomStream random(3, 0, 0, 0);
  int solid = 0;
  for (int i = 0; i < 100000; ++i)
  {
    const Vector3 low = terrain.Low();
    const Vector3 high = terrain.High();
    const Vector3 p(random.Uniform(low.x(), high.x()), random.Uniform(low.y(), high.y()),
                    random.Uniform(low.z(), high.z()));
    const auto* node = tree.search(p.x(), p.y(), p.z());
    const bool occupied = node != nullptr && tree.isNodeOccupied(node);
    ASSERT_EQ(terrain.IsSolid(p), occupied) << p.transpose();
    solid += occupied;
  }
  EXPECT_GT(solid, 1000);
}

TEST(VoxelTerrain, SegmentsHitTheFirstOccupiedCell)
{
  if (!std::filesystem::exists(kBuilding)) GTEST_SKIP() << kBuilding << " is not installed";
  const VoxelTerrain terrain(kBuilding);
  RandomStream random(4, 0, 0, 0);
  int hits = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const auto point = [&]
    {
      Vector3 p;
      for (int axis = 0; axis < 3; ++axis) p[axis] = random.Uniform(terrain.Low()[axis] - 1, terrain.High()[axis] + 1);
      return p;
    };
    const Vector3 from = point();
    const Vector3 to = from + (point() - from).normalized() * random.Uniform(0.1, 6);
    const auto hit = terrain.SegmentHit(from, to);
    // Small steps along the segment find nothing before the hit.
    const double length = (to - from).norm();
    const double end = hit.value_or(1);
    for (double t = 0; t < end - 1e-9; t += 0.01 / length)
      ASSERT_FALSE(terrain.IsSolid(from + t * (to - from))) << i << " " << t << " " << end;
    if (!hit) continue;
    ++hits;
    ASSERT_TRUE(terrain.IsSolid(from + (*hit + 1e-9) * (to - from)) ||
                terrain.IsSolid(from + (*hit + 1e-6) * (to - from)));
  }
  EXPECT_GT(hits, 300);
}

TEST(VoxelTerrain, ASectionCoversExactlyTheSolidCells)
{
  TemporaryFile file("section.bt");
  octomap::OcTree tree(0.1);
  const auto centre = [](int cell) { return 0.1F * static_cast<float>(cell) + 0.05F; };
  const auto fill = [&](int x, int y) { tree.updateNode(octomap::point3d(centre(x), centre(y), 0.05F), true); };
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 3; ++y)
      if (x != 2 || y != 1) fill(x, y);
  tree.writeBinary(file.Path());

  const VoxelTerrain terrain(file.Path());
  const auto section = terrain.Section(0.05);
  EXPECT_LE(section.size(), 4U);
  double area = 0;
  for (const TerrainRectangle& r : section)
  {
    area += (r.high - r.low).prod();
    EXPECT_FALSE(r.low.x() < 0.25 && r.high.x() > 0.25 && r.low.y() < 0.15 && r.high.y() > 0.15);
  }
  EXPECT_NEAR(area, 0.14, 1e-9);
  EXPECT_TRUE(terrain.Section(0.5).empty());
  EXPECT_NEAR(*terrain.GroundBelow({0.05, 0.05, 3}), 0.1, 1e-9);
  EXPECT_FALSE(terrain.GroundBelow({0.25, 0.15, 3}));
}

TEST(VoxelTerrain, FilesThatAreNoMapsAreRefusedByName)
{
  EXPECT_THROW(VoxelTerrain("/nowhere/map.bt"), std::runtime_error);
  TemporaryFile file("nonsense.bt");
  std::FILE* out = std::fopen(file.Path().c_str(), "w");
  std::fputs("this is not a map", out);
  std::fclose(out);
  EXPECT_THROW(VoxelTerrain{file.Path()}, std::runtime_error);
}

TEST(VoxelTerrain, NodesWithinNodesWithoutEndAreRefused)
{
  TemporaryFile file("deep.bt");
  std::ofstream out(file.Path(), std::ios::binary);
  out << "# Octomap OcTree binary file\nid OcTree\nsize 1000000\nres 0.1\ndata\n" << std::string(200000, '\xff');
  out.close();
  EXPECT_EQ(test::MessageOf<std::runtime_error>([&] { VoxelTerrain terrain(file.Path()); }),
            "'" + file.Path() + "' is damaged");
}

TEST(VoxelTerrain, NothingIsReservedForWhatAFileOnlyClaims)
{
  TemporaryFile file("claims.bt");
  for (const auto& [size, resolution] : {std::pair("99999999999", "0.1"), {"5", "1e-300"}, {"5", "1e300"}, {"5", "-1"}})
  {
    std::ofstream out(file.Path(), std::ios::binary);
    out << "# Octomap OcTree binary file\nid OcTree\nsize " << size << "\nres " << resolution << "\ndata\n"
        << std::string(2, '\0');
    out.close();
    EXPECT_THROW(VoxelTerrain(file.Path()), std::runtime_error) << size << ' ' << resolution;
  }
}

TEST(VoxelTerrain, AFileThatIsCutShortIsRefusedByName)
{
  TemporaryFile whole("whole.bt"), cut("cut.bt");
  RoughTerrain numbers;
  numbers.size = {0.5, 0.5};
  numbers.resolution = 0.05;
  WriteRoughTerrain(whole.Path(), numbers);
  std::filesystem::copy_file(whole.Path(), cut.Path());
  std::filesystem::resize_file(cut.Path(), std::filesystem::file_size(whole.Path()) - 1);
  EXPECT_EQ(test::MessageOf<std::runtime_error>([&] { VoxelTerrain terrain(cut.Path()); }),
            "'" + cut.Path() + "' is cut short");
}

HeightTerrain Hills()
{
  RandomStream random(5, 0, 0, 0);
  std::vector<double> heights;
  for (int i = 0; i < 21 * 11; ++i) heights.push_back(random.Uniform(0, 0.5));
  return {heights, 21, 11, 10, 5};
}

TEST(HeightTerrain, SegmentsHitTheSurfaceExactly)
{
  const HeightTerrain terrain = Hills();
  RandomStream random(6, 0, 0, 0);
  int hits = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const Vector3 from(random.Uniform(-1, 11), random.Uniform(-1, 6), random.Uniform(0.2, 2));
    const Vector3 to(random.Uniform(-1, 11), random.Uniform(-1, 6), random.Uniform(-0.5, 1));
    const auto hit = terrain.SegmentHit(from, to);
    for (double t = 0; t < hit.value_or(1) - 1e-6; t += 0.001)
      ASSERT_FALSE(terrain.IsSolid(from + t * (to - from))) << i << " " << t;
    if (!hit) continue;
    ++hits;
    const Vector3 at = from + *hit * (to - from);
    ASSERT_TRUE(terrain.IsSolid(at - Vector3(0, 0, 1e-9)) || terrain.IsSolid(from + (*hit + 1e-9) * (to - from)));
  }
  EXPECT_GT(hits, 500);
}

TEST(HeightTerrain, GridPointsKeepTheirHeights)
{
  const HeightTerrain terrain = Hills();
  EXPECT_NEAR(*terrain.GroundBelow({0, 0, 9}), terrain.Height(0, 0), 1e-12);
  EXPECT_NEAR(*terrain.GroundBelow({10, 5, 9}), terrain.Height(20, 10), 1e-12);
  EXPECT_NEAR(*terrain.GroundBelow({1.5, 2, 9}), terrain.Height(3, 4), 1e-12);
  EXPECT_FALSE(terrain.GroundBelow({-0.1, 0, 9}));
}

TEST(HeightTerrain, APictureIsReadFromTheTop)
{
  TemporaryFile file("hills.png");
  const std::uint8_t pixels[] = {255, 0, 0, 0, 0, 0};  // 3 by 2: only the upper left is white
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 3;
  image.height = 2;
  image.format = PNG_FORMAT_GRAY;
  ASSERT_NE(png_image_write_to_file(&image, file.Path().c_str(), 0, pixels, 0, nullptr), 0);
  const HeightTerrain terrain(file.Path(), 4, 2, 0.5);
  EXPECT_NEAR(terrain.Height(0, 1), 0.5, 1e-9);
  EXPECT_NEAR(terrain.Height(0, 0), 0, 1e-9);
  EXPECT_NEAR(*terrain.GroundBelow({0, 2, 1}), 0.5, 1e-9);
  EXPECT_EQ(terrain.High(), Vector3(4, 2, 0.5));
  const auto walls = terrain.Section(0.2);
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_EQ(walls[0].high, Vector2(2, 2));
}

// Writes samples as they are, with a claim about their gamma.
void WritePicture(const std::string& path, int columns, int colour_type, int bits, std::vector<std::uint8_t> bytes)
{
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  const std::size_t stride = bytes.size() / 2;
  png_set_IHDR(png, info, static_cast<png_uint_32>(columns), 2, bits, colour_type, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_gAMA(png, info, 0.45455);
  const png_color greys[] = {{0, 0, 0}, {51, 51, 51}, {255, 255, 255}};
  if (colour_type == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, greys, 3);
  png_write_info(png, info);
  png_write_row(png, bytes.data());
  png_write_row(png, bytes.data() + stride);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

TEST(HeightTerrain, GreyIsHeightInProportionInAnyKindOfPicture)
{
  TemporaryFile file("greys.png");
  const auto heights = [&](int columns)
  {
    const HeightTerrain terrain(file.Path(), 1, 1, 10);
    std::vector<double> found;
    for (int column = 0; column < columns; ++column) found.push_back(terrain.Height(column, 1));
    return found;
  };
  const auto near = [](std::vector<double> expected)
  { return testing::Pointwise(testing::DoubleNear(1e-12), std::move(expected)); };
  WritePicture(file.Path(), 3, PNG_COLOR_TYPE_GRAY, 8, {0, 51, 255, 0, 0, 0});
  EXPECT_THAT(heights(3), near({0, 2, 10}));
  WritePicture(file.Path(), 3, PNG_COLOR_TYPE_GRAY, 16, {0, 0, 0x33, 0x33, 255, 255, 0, 0, 0, 0, 0, 0});
  EXPECT_THAT(heights(3), near({0, 2, 10}));
  WritePicture(file.Path(), 3, PNG_COLOR_TYPE_PALETTE, 8, {0, 1, 2, 0, 0, 0});
  EXPECT_THAT(heights(3), near({0, 2, 10}));
  WritePicture(file.Path(), 2, PNG_COLOR_TYPE_GRAY_ALPHA, 8, {51, 0, 255, 128, 0, 0, 0, 0});
  EXPECT_THAT(heights(2), near({2, 10}));
  WritePicture(file.Path(), 2, PNG_COLOR_TYPE_RGB, 8, {51, 51, 51, 255, 0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_THAT(heights(2), near({2, 2.99}));
  WritePicture(file.Path(), 8, PNG_COLOR_TYPE_GRAY, 1, {0b01000001, 0});
  EXPECT_THAT(heights(8), near({0, 10, 0, 0, 0, 0, 0, 10}));
}

TEST(HeightTerrain, APictureOfASingleColumnIsRefused)
{
  TemporaryFile file("thin.png");
  WritePicture(file.Path(), 1, PNG_COLOR_TYPE_GRAY, 8, {0, 255});
  EXPECT_EQ(test::MessageOf<std::runtime_error>([&] { HeightTerrain terrain(file.Path(), 1, 1, 1); }),
            "the PNG '" + file.Path() + "' must have at least 2 by 2 pixels");
}

TEST(HeightTerrain, FilesThatAreNoPicturesAreRefusedByName)
{
  EXPECT_THROW(HeightTerrain("/nowhere/hills.png", 1, 1, 1), std::runtime_error);
  TemporaryFile file("nonsense.png");
  std::ofstream(file.Path()) << "this is no picture";
  EXPECT_EQ(test::MessageOf<std::runtime_error>([&] { HeightTerrain terrain(file.Path(), 1, 1, 1); }),
            "cannot read the PNG '" + file.Path() + "': Not a PNG file");
  // Its width is another, 2^30; the checksum of the chunk is right.
  WritePicture(file.Path(), 3, PNG_COLOR_TYPE_GRAY, 8, {0, 51, 255, 0, 0, 0});
  std::fstream wide(file.Path(), std::ios::binary | std::ios::in | std::ios::out);
  std::array<unsigned char, 17> header{};
  wide.seekg(12);
  wide.read(reinterpret_cast<char*>(header.data()), header.size());
  header[4] = header[8] = 0x40;
  const auto sum = static_cast<std::uint32_t>(crc32(0, header.data(), header.size()));
  wide.seekp(12);
  wide.write(reinterpret_cast<const char*>(header.data()), header.size());
  for (int shift = 24; shift >= 0; shift -= 8) wide.put(static_cast<char>(sum >> shift));
  wide.close();
  EXPECT_THROW(HeightTerrain(file.Path(), 1, 1, 1), std::runtime_error);
  WritePicture(file.Path(), 3, PNG_COLOR_TYPE_GRAY, 8, {0, 51, 255, 0, 0, 0});
  std::filesystem::resize_file(file.Path(), std::filesystem::file_size(file.Path()) - 20);
  EXPECT_THROW(HeightTerrain(file.Path(), 1, 1, 1), std::runtime_error);
}

TEST(RoughTerrain, IsMadeFromItsNumbersAlone)
{
  TemporaryFile first("first.bt"), again("again.bt"), other("other.bt");
  RoughTerrain numbers;
  numbers.size = {1, 0.8};
  numbers.resolution = 0.02;
  WriteRoughTerrain(first.Path(), numbers);
  WriteRoughTerrain(again.Path(), numbers);
  EXPECT_EQ(test::TextOf(first.Path()), test::TextOf(again.Path()));
  numbers.seed = 2;
  WriteRoughTerrain(other.Path(), numbers);
  EXPECT_NE(test::TextOf(first.Path()), test::TextOf(other.Path()));
}

// OctoMap as built by Debian prints its actions on standard error.
TEST(RoughTerrain, IsMadeAndReadInSilence)
{
  TemporaryFile file("silent.bt");
  RoughTerrain numbers;
  numbers.size = {0.5, 0.5};
  numbers.resolution = 0.05;
  testing::internal::CaptureStderr();
  WriteRoughTerrain(file.Path(), numbers);
  const VoxelTerrain terrain(file.Path());
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(octomap::OcTree(file.Path()).getResolution(), 0.05) << "OctoMap reads it too";
}

TEST(RoughTerrain, IsAsHighAndAsDeepAsItWasAskedFor)
{
  TemporaryFile file("rough.bt");
  RoughTerrain numbers;
  numbers.size = {2, 1};
  numbers.resolution = 0.01;
  numbers.roughness = 0.05;
  numbers.depth = 0.1;
  numbers.holes = 4;
  WriteRoughTerrain(file.Path(), numbers);
  const VoxelTerrain terrain(file.Path());
  EXPECT_NEAR(terrain.Low().x(), 0, 1e-9);
  EXPECT_NEAR(terrain.High().x(), 2, 1e-9);
  EXPECT_NEAR(terrain.High().y(), 1, 1e-9);
  EXPECT_NEAR(terrain.High().z(), 0.05, 0.0051);

  double highest = 0, steepest = 0;
  int in_holes = 0, columns = 0;
  for (double x = 0.005; x < 2; x += 0.01)
    for (double y = 0.005; y < 1; y += 0.01)
    {
      const auto ground = terrain.GroundBelow({x, y, 1});
      ASSERT_TRUE(ground) << x << " " << y;
      ++columns;
      if (*ground < -0.05)
      {
        ++in_holes;
        EXPECT_NEAR(*ground, -0.1, 1e-9) << "the floor of a hole is flat";
        continue;
      }
      EXPECT_GE(*ground, -1e-9);
      highest = std::max(highest, *ground);
      const auto beside = terrain.GroundBelow({x - 0.01, y, 1});
      if (beside && *beside > -0.05) steepest = std::max(steepest, std::abs(*ground - *beside));
    }
  EXPECT_GT(highest, 0.04);
  EXPECT_LT(steepest, 0.0101) << "at most a cell from column to column";
  EXPECT_GT(in_holes, columns / 50);
  EXPECT_LT(in_holes, columns / 2);
}

TEST(RoughTerrain, RefusesNumbersThatMakeNone)
{
  RoughTerrain numbers;
  numbers.size = {100, 100};
  EXPECT_THROW(WriteRoughTerrain("never.bt", numbers), std::invalid_argument);
  numbers.size = {1, 1};
  numbers.resolution = 0;
  EXPECT_THROW(WriteRoughTerrain("never.bt", numbers), std::invalid_argument);
  numbers.resolution = 0.1;
  EXPECT_THROW(WriteRoughTerrain("/nowhere/never.bt", numbers), std::runtime_error);
}

// A wall of cells of 0.1 m, 0.2 m thick at x = 2, from y = 0 to 2 and up to 0.5 m; .ot with probabilities, .bt without.
template <class Map = octomap::OcTree>
void WriteWall(const std::string& path)
{
  Map map(0.1);
  for (int x = 20; x < 22; ++x)
    for (int y = 0; y < 20; ++y)
      for (int z = 0; z < 5; ++z)
        for (int seen = 0; seen <= z; ++seen)
          map.updateNode(octomap::point3d(static_cast<float>((x + 0.5) * 0.1), static_cast<float>((y + 0.5) * 0.1),
                                          static_cast<float>((z + 0.5) * 0.1)),
                         true);
  if constexpr (std::is_same_v<Map, octomap::ColorOcTree>) map.integrateNodeColor(2.05F, 0.05F, 0.05F, 255, 0, 127);
  if (path.ends_with(".ot"))
    map.write(path);
  else
    map.writeBinary(path);
}

TEST(VoxelTerrain, BothKindsOfOctoMapFilesHoldTheSameGround)
{
  TemporaryFile binary("wall.bt"), full("wall.ot");
  WriteWall(binary.Path());
  WriteWall(full.Path());
  // Maps with colours or times have the same ground.
  TemporaryFile coloured("coloured.ot"), coloured_binary("coloured.bt"), stamped("stamped.ot"),
      stamped_binary("stamped.bt");
  WriteWall<octomap::ColorOcTree>(coloured.Path());
  WriteWall<octomap::ColorOcTree>(coloured_binary.Path());
  WriteWall<octomap::OcTreeStamped>(stamped.Path());
  WriteWall<octomap::OcTreeStamped>(stamped_binary.Path());
  const VoxelTerrain a(binary.Path());
  for (const TemporaryFile* other : {&full, &coloured, &coloured_binary, &stamped, &stamped_binary})
  {
    const VoxelTerrain b(other->Path());
    EXPECT_EQ(a.Low(), b.Low());
    EXPECT_EQ(a.High(), b.High());
    RandomStream random(8, 0, 0, 0);
    for (int k = 0; k < 2000; ++k)
    {
      const Vector3 point(random.Uniform(1.5, 2.5), random.Uniform(-0.5, 2.5), random.Uniform(-0.2, 0.7));
      ASSERT_EQ(a.IsSolid(point), b.IsSolid(point)) << other->Path() << ": " << point.transpose();
    }
  }
}

TEST(VoxelTerrain, OccludesInItsOwnWorldAlone)
{
  TemporaryFile file("hides.bt");
  WriteWall(file.Path());
  Experiment experiment;
  experiment.arena_size = {4, 2, 1};
  experiment.entities.resize(3);
  for (std::size_t k = 0; k < 3; ++k) experiment.entities[k].id = "e" + std::to_string(k);
  experiment.entities[0].kind = EntityKind::kTerrain;
  experiment.entities[0].tree = test::TerrainTree("octomap", {{"file", file.Path()}});
  experiment.entities[1].kind = experiment.entities[2].kind = EntityKind::kLightBulb;
  experiment.engines.resize(2);
  experiment.engines[0].entities = {0, 1};
  experiment.engines[1].entities = {2};
  const CSwarmanoidSpace space(experiment);
  SpaceQuery query(space);
  const auto hit = query.FindFirstHit({1, 1, 0.25}, {3, 1, 0.25}, 1, {});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->entity, 0U);
  EXPECT_NEAR(hit->fraction, 0.5, 1e-9);
  EXPECT_FALSE(query.FindFirstHit({1, 1, 0.55}, {3, 1, 0.55}, 1, {})) << "above the wall";
  EXPECT_FALSE(query.FindFirstHit({1, 1, 0.25}, {3, 1, 0.25}, 2, {})) << "not of the observer's world";
}

}  // namespace
}  // namespace swarmanoid
