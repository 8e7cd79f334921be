#include "common/configuration/parameter_table.h"
#include "common/plugin_descriptions/renderers.h"

namespace swarmanoid
{

PluginDescription PageRenderDescription()
{
  PluginDescription description;
  description.label = "page_render";
  description.brief =
      "one HTML file with the page of web_render and the run, which plays in a browser without a server or a network";
  description.parameters =
      Joined({{"file", ParameterType::kText, "", "run.html", "The file, taken from the run's folder."},
              {"every", ParameterType::kInteger, "ticks", "1", "States are recorded every so many ticks.", 1, 1e15},
              {"from", ParameterType::kInteger, "ticks", "0", "The first tick that is recorded.", 0, 1e15},
              {"to", ParameterType::kInteger, "ticks", "0", "The last tick that is recorded; 0: until the run ends.", 0,
               1e15}},
             ViewpointParameters());
  return description;
}

}  // namespace swarmanoid
