// For builds without FFmpeg's libraries.
#include <stdexcept>

#include "tests/unit/visualiser/video_reader.h"

namespace swarmanoid
{

bool HasVideo() { return false; }

VideoContents ReadVideo(const std::string& path) { throw std::runtime_error("cannot read the video '" + path + "'"); }

}  // namespace swarmanoid
