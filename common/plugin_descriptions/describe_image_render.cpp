#include "common/configuration/parameter_table.h"
#include "common/plugin_descriptions/renderers.h"

namespace swarmanoid
{

PluginDescription ImageRenderDescription()
{
  PluginDescription description;
  description.label = "image_render";
  description.brief = "pictures (PNG) and videos of the arena, drawn without a window or an X server";
  description.parameters = {
      {"size", ParameterType::kVector2, "pixels", "1024, 768", "Width and height of the pictures.", 1, 32768},
      {"camera", ParameterType::kText, "", "",
       "Where the camera stands: the number of a viewpoint, top (straight above), default (all of the arena), or "
       "x,y,z/heading,pitch,roll in metres and degrees; without it the first viewpoint, or default where there is "
       "none."},
      {"every", ParameterType::kInteger, "ticks", "1", "A picture is drawn every so many ticks.", 1, 1e15},
      {"from", ParameterType::kInteger, "ticks", "0", "The tick of the first picture.", 0, 1e15},
      {"to", ParameterType::kInteger, "ticks", "0", "The tick of the last picture; 0: until the run ends.", 0, 1e15},
      {"at", ParameterType::kInteger, "ticks", "-1",
       "The tick of a single picture; it takes the place of every, from and to.", -1, 1e15},
      {"file", ParameterType::kText, "", "",
       "A picture file, taken from the run's folder; each picture replaces the one before, so it shows the last one."},
      {"directory", ParameterType::kText, "", "",
       "Folder for numbered pictures, taken from the run's folder; frames, where neither file nor video is given."},
      {"filename", ParameterType::kText, "", "frame", "Numbered pictures are called FILENAME_<tick>.png."},
      {"video", ParameterType::kText, "", "",
       "A video file, taken from the run's folder: .mp4 (H.264), .webm (VP9), .gif or another ending that FFmpeg "
       "knows."},
      {"speed", ParameterType::kNumber, "", "1", "Simulated seconds that pass in a second of the video.", 1e-3, 1e6},
      {"stop", ParameterType::kBoolean, "", "false",
       "Whether the run, or the watching where it is attached, ends after the last picture."},
      {"show_clock", ParameterType::kBoolean, "", "false", "Whether a line below shows the simulated time."},
      {"show_scale", ParameterType::kBoolean, "", "false",
       "Whether a line below shows the distance of the floor's lines."},
      {"show_status", ParameterType::kBoolean, "", "false",
       "Whether a line below says how the run goes: tick, real-time factor, processes that are late."},
      {"show_owners", ParameterType::kBoolean, "", "false",
       "Whether the labels of robots and preys name the engine and the controller host that own them."}};
  description.parameters =
      Joined(Joined(std::move(description.parameters), ViewpointParameters()), QualityParameters());
  return description;
}

}  // namespace swarmanoid
