#include "common/space/terrain/jpeg_picture.h"

#include <csetjmp>
#include <cstdio>
#include <stdexcept>

#include <jerror.h>
#include <jpeglib.h>

namespace swarmanoid
{
namespace
{

// The limit is the same as for PNGs. A picture of this size takes a gigabyte.
constexpr std::uint64_t kMostJpegPixels = std::uint64_t{1} << 26U;

// Errors of libjpeg return by longjmp, so functions that may meet one must not have objects with destructors.
struct JpegReader
{
  explicit JpegReader(std::string_view bytes) : bytes_(bytes)
  {
    jpeg.err = jpeg_std_error(&manager_);
    jpeg.client_data = this;
    manager_.error_exit = &OnError;
    manager_.emit_message = &OnWarning;
  }
  ~JpegReader() { jpeg_destroy_decompress(&jpeg); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  static void OnError(j_common_ptr jpeg)
  {
    auto& reader = *static_cast<JpegReader*>(jpeg->client_data);
    char text[JMSG_LENGTH_MAX];
    jpeg->err->format_message(jpeg, text);
    reader.error = text;
    longjmp(reader.back_, 1);
  }

  // A damaged picture is read as far as possible, but an incomplete one is refused.
  static void OnWarning(j_common_ptr jpeg, int level)
  {
    if (level < 0 && jpeg->err->msg_code == JWRN_JPEG_EOF) OnError(jpeg);
  }

  // This function and those below return false after an error.
  bool ReadHeader()
  {
    if (setjmp(back_) != 0) return false;
    jpeg_create_decompress(&jpeg);
    jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size());
    jpeg_read_header(&jpeg, TRUE);
    jpeg.out_color_space = jpeg.jpeg_color_space == JCS_GRAYSCALE ? JCS_GRAYSCALE : JCS_RGB;
    jpeg.dct_method = JDCT_ISLOW;
    return true;
  }
  bool ReadRows(unsigned char* samples, std::size_t stride)
  {
    if (setjmp(back_) != 0) return false;
    jpeg_start_decompress(&jpeg);
    while (jpeg.output_scanline < jpeg.output_height)
    {
      JSAMPROW row = samples + jpeg.output_scanline * stride;
      jpeg_read_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_decompress(&jpeg);
    return true;
  }

  jpeg_decompress_struct jpeg{};
  std::string error;

private:
  std::string_view bytes_;
  jpeg_error_mgr manager_{};
  std::jmp_buf back_{};
};

}  // namespace

bool IsJpeg(std::string_view bytes) { return bytes.starts_with("\xff\xd8\xff"); }

ColourPicture JpegPicture(std::string_view bytes)
{
  JpegReader reader(bytes);
  if (!reader.ReadHeader()) throw std::runtime_error(reader.error);
  const auto columns = static_cast<std::size_t>(reader.jpeg.image_width);
  const auto rows = static_cast<std::size_t>(reader.jpeg.image_height);
  if (std::uint64_t{columns} * rows > kMostJpegPixels)
    throw std::runtime_error("it has more than 67,108,864 pixels, the most that are read");
  const std::size_t channels = reader.jpeg.out_color_space == JCS_GRAYSCALE ? 1 : 3;
  std::vector<unsigned char> samples(columns * rows * channels);
  if (!reader.ReadRows(samples.data(), columns * channels)) throw std::runtime_error(reader.error);

  ColourPicture picture;
  picture.columns = static_cast<int>(columns);
  picture.rows = static_cast<int>(rows);
  picture.pixels.reserve(columns * rows);
  for (std::size_t at = 0; at < samples.size(); at += channels)
  {
    const std::uint32_t first = samples[at];
    picture.pixels.push_back(channels == 1 ? first * 0x010101
                                           : first << 16U | std::uint32_t{samples[at + 1]} << 8U | samples[at + 2]);
  }
  return picture;
}

}  // namespace swarmanoid
