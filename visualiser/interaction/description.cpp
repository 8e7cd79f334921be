#include "visualiser/interaction/window_parameters.h"

namespace swarmanoid
{

std::vector<ParameterSpec> WindowParameters()
{
  return {
      {"window_size", ParameterType::kVector2, "pixels", "1024, 768", "Width and height of the window."},
      {"window_title", ParameterType::kText, "", "", "The window's title; without it the name of the experiment."},
      {"write_frames", ParameterType::kBoolean, "", "false",
       "Whether each picture of a tick is written to a PNG file, without the panels."},
      {"frame_directory", ParameterType::kText, "", "frames", "Folder of those files, taken from the run's folder."},
      {"frame_filename", ParameterType::kText, "", "frame", "They are called FRAME_FILENAME_<tick>.png."},
      {"every", ParameterType::kInteger, "ticks", "1",
       "A picture is drawn every so many ticks; larger numbers let a run go faster.", 1},
      {"max_frame_rate", ParameterType::kNumber, "1/s", "60",
       "Pictures in a second of real time at most; the ticks between are not drawn, unless frames are written.", 0.01,
       1000},
      {"show_panels", ParameterType::kBoolean, "", "true",
       "Whether the window starts with its panels; the key Tab shows and hides them."}};
}

}  // namespace swarmanoid
