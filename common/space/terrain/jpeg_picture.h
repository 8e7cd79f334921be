// Reads the pixels of a JPEG, for pictures on the floor (FloorPicture), in any process.
#pragma once

#include <string_view>

#include "common/space/terrain/png_picture.h"

namespace swarmanoid
{

bool IsJpeg(std::string_view bytes);
// Decodes grey or colours of 8 bits, with integers alone, so that all processes see the same pixels. Throws
// std::runtime_error that says what is wrong with the bytes.
ColourPicture JpegPicture(std::string_view bytes);

}  // namespace swarmanoid
