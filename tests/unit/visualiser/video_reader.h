// Reads videos, to compare them with the drawn pictures.
#pragma once

#include <string>

#include "visualiser/scene/drawn_picture.h"

namespace swarmanoid
{

// Returns whether this build has FFmpeg's libraries.
bool HasVideo();

struct VideoContents
{
  int width = 0;
  int height = 0;
  int pictures = 0;
  double seconds = 0;  // time from the first picture to the last one
  std::string codec;
  Picture first, last;
};
// Decodes the whole video. Throws std::runtime_error, which names the file.
VideoContents ReadVideo(const std::string& path);

}  // namespace swarmanoid
