#include "common/plugin_descriptions/renderers.h"

namespace swarmanoid
{

PluginDescription FoxgloveRenderDescription()
{
  PluginDescription description;
  description.label = "foxglove_render";
  description.brief = "shows the simulation in Foxglove and Lichtblick: transforms, bodies, attributes of the entities";
  description.parameters = {
      {.name = "address",
       .type = ParameterType::kText,
       .default_value = "127.0.0.1",
       .description = "Where it listens, in numbers. Whoever reaches it may look: 127.0.0.1 is this machine alone."},
      {.name = "port",
       .type = ParameterType::kInteger,
       .default_value = "8765",
       .description = "The port there; 0: a free one, which the log names.",
       .minimum = 0,
       .maximum = 65535},
      {.name = "every",
       .type = ParameterType::kInteger,
       .unit = "ticks",
       .default_value = "1",
       .description = "Messages are sent every so many ticks.",
       .minimum = 1,
       .maximum = 1e6},
      {.name = "origins",
       .type = ParameterType::kText,
       .default_value = "https://app.foxglove.dev",
       .description =
           "Sites whose pages may look, separated by blanks. Pages of this machine and programs always may."}};
  return description;
}

}  // namespace swarmanoid
