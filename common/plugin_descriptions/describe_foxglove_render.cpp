#include "common/plugin_descriptions/renderers.h"

namespace swarmanoid
{

using enum ParameterType;

PluginDescription FoxgloveRenderDescription()
{
  PluginDescription description;
  description.label = "foxglove_render";
  description.brief = "shows the simulation in Foxglove and Lichtblick: transforms, bodies, attributes of the entities";
  description.parameters = {
      {"address", kText, "", "127.0.0.1",
       "The address at which it listens, in numbers. All who reach it may look: 127.0.0.1 is this machine alone."},
      {"port", kInteger, "", "8765", "The port there; 0: a free one, which the log names.", 0, 65535},
      {"every", kInteger, "ticks", "1", "Messages are sent every so many ticks.", 1, 1e6},
      {"origins", kText, "", "https://app.foxglove.dev",
       "Sites whose pages may look, separated by blanks. Pages of this machine and programs always may."}};
  return description;
}

}  // namespace swarmanoid
