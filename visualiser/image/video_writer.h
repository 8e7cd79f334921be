// Writes a video of pictures in simulated time: mp4 (H.264), webm (VP9) or gif, by the ending of the file's name, or
// any other container that FFmpeg knows.
#pragma once

#include <memory>
#include <string>

#include "visualiser/scene/drawn_picture.h"

namespace swarmanoid
{

class VideoWriter
{
public:
  // The size is rounded down to even numbers. `seconds_per_picture` gives the nominal rate of the video. Throws
  // std::runtime_error with the name of the file, also if the build has no FFmpeg libraries.
  VideoWriter(const std::string& path, int width, int height, double seconds_per_picture);
  ~VideoWriter();

  // Shows the picture from `time` on (s from the start of the video); times must ascend.
  void Add(const Picture& picture, double time);
  // Writes the rest of the file. Otherwise the destructor does, but cannot report errors.
  void Finish();

private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace swarmanoid
