#include "tests/unit/visualiser/read_png.h"

#include <png.h>

#include <stdexcept>

namespace swarmanoid
{

Picture ReadPng(const std::string& path)
{
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0)
    throw std::runtime_error("cannot read the picture '" + path + "': " + image.message);
  image.format = PNG_FORMAT_RGBA;
  Picture picture;
  picture.width = static_cast<int>(image.width);
  picture.height = static_cast<int>(image.height);
  picture.pixels.resize(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, picture.pixels.data(), 0, nullptr) == 0)
    throw std::runtime_error("cannot read the picture '" + path + "': " + image.message);
  return picture;
}

}  // namespace swarmanoid
