#include "visualiser/scene/drawn_picture.h"

#include <png.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "common/configuration/output_file.h"

namespace swarmanoid
{
namespace
{

struct FileCloser
{
  void operator()(std::FILE* file) const { std::fclose(file); }
};

[[noreturn]] void Fail(const std::string& path, const std::string& what)
{
  throw std::runtime_error("cannot write the picture '" + path + "': " + what);
}

// Writes the picture. `path` is for messages. A temporary file beside it is never written through a link.
void WriteTo(const std::string& file_name, const Picture& picture, const std::string& path)
{
  std::unique_ptr<std::FILE, FileCloser> file(file_name == path ? std::fopen(file_name.c_str(), "wb")
                                                                : OpenOutputFile(file_name));
  if (file == nullptr) Fail(path, std::strerror(errno));
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop header = png == nullptr ? nullptr : png_create_info_struct(png);
  if (header == nullptr) Fail(path, "no memory");
  // libpng leaves by longjmp, so no object with a destructor may be made after this line.
  if (setjmp(png_jmpbuf(png)) != 0)
  {
    png_destroy_write_struct(&png, &header);
    Fail(path, std::strerror(errno));
  }
  png_init_io(png, file.get());
  png_set_compression_level(png, 1);
  png_set_filter(png, 0, PNG_FILTER_SUB);
  png_set_IHDR(png, header, static_cast<png_uint_32>(picture.width), static_cast<png_uint_32>(picture.height), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, header);
  png_set_filler(png, 0, PNG_FILLER_AFTER);
  for (int y = 0; y < picture.height; ++y) png_write_row(png, picture.At(0, y));
  png_write_end(png, header);
  png_destroy_write_struct(&png, &header);
  if (std::fclose(file.release()) != 0) Fail(path, std::strerror(errno));
}

}  // namespace

void WritePng(const Picture& picture, const std::string& path)
{
  namespace fs = std::filesystem;
  std::error_code none;
  const fs::file_type type = fs::symlink_status(path, none).type();
  // A pipe or a link is written in place.
  if (type != fs::file_type::not_found && type != fs::file_type::regular) return WriteTo(path, picture, path);
  const std::string draft = path + ".new";
  try
  {
    WriteTo(draft, picture, path);
    if (std::rename(draft.c_str(), path.c_str()) != 0) Fail(path, std::strerror(errno));
  }
  catch (...)
  {
    if (fs::is_regular_file(draft, none)) fs::remove(draft, none);
    throw;
  }
}

}  // namespace swarmanoid
