#include "common/space/terrain/grey_picture.h"

#include <png.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>

namespace swarmanoid
{
namespace
{

// A file that libpng reads. Its errors come back by longjmp, so no function that may meet one has objects of its own.
struct Reader
{
  explicit Reader(const std::string& path) : file(std::fopen(path.c_str(), "rb"))
  {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &OnError, [](png_structp, png_const_charp) {});
    if (png != nullptr) info = png_create_info_struct(png);
  }
  ~Reader()
  {
    png_destroy_read_struct(&png, &info, nullptr);
    if (file != nullptr) std::fclose(file);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  static void OnError(png_structp png, png_const_charp text)
  {
    static_cast<Reader*>(png_get_error_ptr(png))->error = text;
    png_longjmp(png, 1);
  }

  // Palettes and few bits become 8 bits a sample; 16 bits stay. False after an error.
  bool ReadHeader()
  {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_init_io(png, file);
    png_read_info(png, info);
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

  std::FILE* file;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string error;
};

}  // namespace

GreyPicture ReadGreyPicture(const std::string& path)
{
  Reader reader(path);
  const auto fail = [&](const std::string& why)
  { throw std::runtime_error("cannot read the PNG '" + path + "': " + why); };
  if (reader.file == nullptr) fail("it cannot be opened");
  if (reader.info == nullptr) fail("out of memory");
  if (!reader.ReadHeader()) fail(reader.error);

  GreyPicture picture;
  picture.columns = static_cast<int>(png_get_image_width(reader.png, reader.info));
  picture.rows = static_cast<int>(png_get_image_height(reader.png, reader.info));
  const std::size_t stride = png_get_rowbytes(reader.png, reader.info);
  std::vector<std::uint8_t> bytes(stride * static_cast<std::size_t>(picture.rows));
  std::vector<png_bytep> rows;
  rows.reserve(static_cast<std::size_t>(picture.rows));
  for (int row = 0; row < picture.rows; ++row) rows.push_back(bytes.data() + static_cast<std::size_t>(row) * stride);
  if (!reader.ReadRows(rows.data())) fail(reader.error);

  const std::size_t channels = png_get_channels(reader.png, reader.info);
  const bool wide = png_get_bit_depth(reader.png, reader.info) == 16;
  const auto sample = [&](const std::uint8_t* row, std::size_t k)
  { return wide ? (256 * row[2 * k] + row[2 * k + 1]) / 65535.0 : row[k] / 255.0; };
  picture.values.reserve(static_cast<std::size_t>(picture.columns) * rows.size());
  for (const std::uint8_t* row : rows)
    for (std::size_t x = 0; x < static_cast<std::size_t>(picture.columns); ++x)
    {
      const std::size_t k = x * channels;
      picture.values.push_back(channels == 1
                                   ? sample(row, k)
                                   : 0.299 * sample(row, k) + 0.587 * sample(row, k + 1) + 0.114 * sample(row, k + 2));
    }
  return picture;
}

}  // namespace swarmanoid
