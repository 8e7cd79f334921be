#include "common/configuration/parameter_table.h"
#include "common/plugin_descriptions/renderers.h"

namespace swarmanoid
{

std::vector<ParameterSpec> WindowParameters()
{
  return {
      {"window_size", ParameterType::kVector2, "pixels", "1024, 768", "Width and height of the window.", 1, 32768},
      {"window_title", ParameterType::kText, "", "", "The window's title; without it the name of the experiment."},
      {"write_frames", ParameterType::kBoolean, "", "false",
       "Whether each picture of a tick is written to a PNG file, without the panels."},
      {"frame_directory", ParameterType::kText, "", "frames", "Folder of those files, taken from the run's folder."},
      {"frame_filename", ParameterType::kText, "", "frame", "They are called FRAME_FILENAME_<tick>.png."},
      {"every", ParameterType::kInteger, "ticks", "1",
       "A picture is drawn every so many ticks; larger numbers let a run go faster.", 1, 1e15},
      {"max_frame_rate", ParameterType::kNumber, "1/s", "60",
       "Pictures in a second of real time at most; the ticks between are not drawn, unless frames are written.", 0.01,
       1000},
      {"show_panels", ParameterType::kBoolean, "", "true",
       "Whether the window starts with its panels; the key Tab shows and hides them."}};
}

namespace
{

PluginDescription WindowRenderDescription(const char* label, const char* brief)
{
  return {.label = label,
          .brief = brief,
          .parameters = Joined(Joined(WindowParameters(), ViewpointParameters()), QualityParameters())};
}

}  // namespace

PluginDescription OpenGlRenderDescription()
{
  return WindowRenderDescription("opengl_render",
                                 "a window on the arena, with panels to watch and steer the run; needs a display");
}

PluginDescription OgreRenderDescription()
{
  return WindowRenderDescription(
      "ogre_render", "a window drawn by OGRE, with materials and soft shadows, and the same panels; needs a display");
}

}  // namespace swarmanoid
