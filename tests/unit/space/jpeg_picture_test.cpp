// JPEGs as pictures on the floor, against what libjpeg was given to write.
#include "common/space/terrain/jpeg_picture.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include <jpeglib.h>

#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

// Columns of 8 by 8 pixels, a block of the format, of one colour each.
std::string Written(const std::vector<std::uint32_t>& colours, bool grey)
{
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr manager{};
  jpeg.err = jpeg_std_error(&manager);
  jpeg_create_compress(&jpeg);
  unsigned char* bytes = nullptr;
  unsigned long count = 0;
  jpeg_mem_dest(&jpeg, &bytes, &count);
  jpeg.image_width = static_cast<JDIMENSION>(8 * colours.size());
  jpeg.image_height = 8;
  jpeg.input_components = grey ? 1 : 3;
  jpeg.in_color_space = grey ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 100, TRUE);
  if (!grey) jpeg.comp_info[0].h_samp_factor = jpeg.comp_info[0].v_samp_factor = 1;
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<unsigned char> samples;
  for (const std::uint32_t colour : colours)
    for (int x = 0; x < 8; ++x)
      for (const unsigned shift : {16U, 8U, 0U})
        if (!grey || shift == 0) samples.push_back(static_cast<unsigned char>(colour >> shift));
  for (int y = 0; y < 8; ++y)
  {
    JSAMPROW row = samples.data();
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  std::string file(reinterpret_cast<const char*>(bytes), count);
  std::free(bytes);
  return file;
}

void ExpectNear(const ColourPicture& picture, const std::vector<std::uint32_t>& colours)
{
  ASSERT_EQ(picture.columns, static_cast<int>(8 * colours.size()));
  ASSERT_EQ(picture.rows, 8);
  ASSERT_EQ(picture.pixels.size(), 64 * colours.size());
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    for (const unsigned shift : {16U, 8U, 0U})
      EXPECT_NEAR(picture.pixels[i] >> shift & 0xff, colours[i / 8 % colours.size()] >> shift & 0xff, 3) << i;
}

TEST(JpegPicture, PixelsAreThoseThatWereWritten)
{
  const std::vector<std::uint32_t> colours{0xff0000, 0x00ff00, 0x1040c0, 0xffffff, 0x000000};
  ExpectNear(JpegPicture(Written(colours, false)), colours);
  const std::vector<std::uint32_t> greys{0x000000, 0x808080, 0xffffff};
  ExpectNear(JpegPicture(Written(greys, true)), greys);
}

TEST(JpegPicture, AFileIsKnownByItsBytesNotByItsName)
{
  const test::TemporaryFolder folder;
  ExpectNear(ReadColourPicture(folder.Write("floor.png", Written({0x00ff00}, false))), {0x00ff00});
}

TEST(ColourPicture, OfOtherFilesItSaysWhichAreTaken)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.Write("floor.gif", "GIF89a");
  EXPECT_EQ(test::MessageOf<std::runtime_error>([&] { ReadColourPicture(path); }),
            "cannot read the picture '" + path + "': it is neither a PNG nor a JPEG");
}

TEST(JpegPicture, WhatIsDamagedIsRefusedWithItsReason)
{
  const auto why = [](const std::string& bytes) -> std::string
  { return test::MessageOf<std::runtime_error>([&] { JpegPicture(bytes); }, "nothing is wrong"); };
  const std::string file = Written({0xff0000, 0x00ff00, 0x0000ff}, false);
  EXPECT_EQ(why(file), "nothing is wrong");
  for (const std::size_t length : {std::size_t{3}, file.size() / 2, file.size() - 20})
    EXPECT_NE(why(file.substr(0, length)), "nothing is wrong") << length;
  EXPECT_FALSE(IsJpeg("\x89PNG"));
}

}  // namespace
}  // namespace swarmanoid
