// Replaces video_writer.cpp in builds without FFmpeg's libraries.
#include "visualiser/image/video_writer.h"

#include <stdexcept>

namespace swarmanoid
{
namespace
{

[[noreturn]] void Refuse(const std::string& path)
{
  throw std::runtime_error("cannot handle the video '" + path +
                           "': this build has no video; install the packages libavcodec-dev libavformat-dev "
                           "libavutil-dev libswscale-dev and build again, or write pictures");
}

}  // namespace

struct VideoWriter::State
{
};

VideoWriter::VideoWriter(const std::string& path, int, int, double) { Refuse(path); }
VideoWriter::~VideoWriter() = default;
void VideoWriter::Add(const Picture&, double) {}
void VideoWriter::Finish() {}

}  // namespace swarmanoid
