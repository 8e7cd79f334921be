#include "common/space/terrain/png_picture.h"

#include <png.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "common/configuration/regular_file.h"
#include "common/space/terrain/jpeg_picture.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint64_t kMostPictureBytes = std::uint64_t{1} << 30U;
constexpr png_uint_32 kMostPixelsOfRow = 1U << 16U;
// A picture of this size takes a gigabyte.
constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 26U;

// A file that libpng reads. Errors of libpng return by longjmp, so functions that may meet one must not have objects
// with destructors.
struct Reader
{
  explicit Reader(std::string_view bytes) : rest(bytes)
  {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &OnError, [](png_structp, png_const_charp) {});
    if (png != nullptr) info = png_create_info_struct(png);
  }
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  static void OnError(png_structp png, png_const_charp text)
  {
    static_cast<Reader*>(png_get_error_ptr(png))->error = text;
    png_longjmp(png, 1);
  }

  static void OnRead(png_structp png, png_bytep target, std::size_t count)
  {
    std::string_view& rest = static_cast<Reader*>(png_get_io_ptr(png))->rest;
    if (count > rest.size()) png_error(png, "it is cut short");
    std::memcpy(target, rest.data(), count);
    rest.remove_prefix(count);
  }

  // Converts palettes and small samples to 8 bits a sample; 16 bits stay. Returns false after an error.
  bool ReadHeader()
  {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_user_limits(png, kMostPixelsOfRow, kMostPixelsOfRow);
    png_set_read_fn(png, this, &OnRead);
    png_read_info(png, info);
    if (std::uint64_t{png_get_image_width(png, info)} * png_get_image_height(png, info) > kMostPixels)
      png_error(png, "it has more than 67,108,864 pixels, the most that are read");
    png_set_expand(png);
    png_set_strip_alpha(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    return true;
  }
  bool ReadRows(png_bytepp rows)
  {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_read_image(png, rows);
    return true;
  }

  std::string_view rest;  // the bytes of the file that are not read yet
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string error;
};

// The content of a file: rows of samples, 1 to 4 of them a pixel, of 8 or 16 bits.
struct Samples
{
  int columns = 0;
  int rows = 0;
  std::size_t channels = 0;
  bool are_wide = false;
  std::size_t stride = 0;  // bytes in each row
  std::vector<std::uint8_t> bytes;

  bool IsGrey() const { return channels < 3; }
  template <class Take>
  void ForEachPixel(Take take) const
  {
    for (int row = 0; row < rows; ++row)
    {
      const std::uint8_t* const samples = bytes.data() + static_cast<std::size_t>(row) * stride;
      for (std::size_t x = 0; x < static_cast<std::size_t>(columns); ++x)
        take(samples + x * channels * (are_wide ? 2 : 1));
    }
  }
};

[[noreturn]] void Fail(const char* kind, const std::string& path, const std::string& why)
{
  throw std::runtime_error(std::string("cannot read the ") + kind + " '" + path + "': " + why);
}

std::string BytesOf(const char* kind, const std::string& path)
{
  try
  {
    return ReadRegularFile(path, kMostPictureBytes);
  }
  catch (const FileError& error)
  {
    Fail(kind, path, error.what());
  }
}

Samples SamplesOf(const std::string& file, const std::string& path)
{
  const auto fail = [&](const std::string& why) { Fail("PNG", path, why); };
  Reader reader(file);
  if (reader.info == nullptr) fail("out of memory");
  if (!reader.ReadHeader()) fail(reader.error);

  Samples samples;
  samples.columns = static_cast<int>(png_get_image_width(reader.png, reader.info));
  samples.rows = static_cast<int>(png_get_image_height(reader.png, reader.info));
  samples.stride = png_get_rowbytes(reader.png, reader.info);
  samples.bytes.resize(samples.stride * static_cast<std::size_t>(samples.rows));
  std::vector<png_bytep> rows;
  rows.reserve(static_cast<std::size_t>(samples.rows));
  for (int row = 0; row < samples.rows; ++row)
    rows.push_back(samples.bytes.data() + static_cast<std::size_t>(row) * samples.stride);
  if (!reader.ReadRows(rows.data())) fail(reader.error);
  samples.channels = png_get_channels(reader.png, reader.info);
  samples.are_wide = png_get_bit_depth(reader.png, reader.info) == 16;
  return samples;
}

}  // namespace

GreyPicture ReadGreyPicture(const std::string& path)
{
  const Samples samples = SamplesOf(BytesOf("PNG", path), path);
  GreyPicture picture;
  picture.columns = samples.columns;
  picture.rows = samples.rows;
  picture.values.reserve(static_cast<std::size_t>(samples.columns) * static_cast<std::size_t>(samples.rows));
  samples.ForEachPixel(
      [&](const std::uint8_t* pixel)
      {
        const auto sample = [&](std::size_t k)
        { return samples.are_wide ? (256 * pixel[2 * k] + pixel[2 * k + 1]) / 65535.0 : pixel[k] / 255.0; };
        picture.values.push_back(samples.IsGrey() ? sample(0)
                                                  : 0.299 * sample(0) + 0.587 * sample(1) + 0.114 * sample(2));
      });
  return picture;
}

ColourPicture ReadColourPicture(const std::string& path)
{
  const std::string file = BytesOf("picture", path);
  if (IsJpeg(file))
  {
    try
    {
      return JpegPicture(file);
    }
    catch (const std::exception& error)
    {
      Fail("JPEG", path, error.what());
    }
  }
  // libpng checks the rest of the signature, and recognises typical damage.
  if (!file.starts_with("\x89PNG")) Fail("picture", path, "it is neither a PNG nor a JPEG");
  const Samples samples = SamplesOf(file, path);
  ColourPicture picture;
  picture.columns = samples.columns;
  picture.rows = samples.rows;
  picture.pixels.reserve(static_cast<std::size_t>(samples.columns) * static_cast<std::size_t>(samples.rows));
  const std::size_t width = samples.are_wide ? 2 : 1;
  samples.ForEachPixel(
      [&](const std::uint8_t* pixel)
      {
        const std::uint32_t red = pixel[0];
        picture.pixels.push_back(samples.IsGrey() ? red * 0x010101
                                                  : red << 16 | std::uint32_t{pixel[width]} << 8 | pixel[2 * width]);
      });
  return picture;
}

}  // namespace swarmanoid
