#include "common/configuration/parameter_table.h"
#include "common/plugin_descriptions/renderers.h"

namespace swarmanoid
{

PluginDescription WebRenderDescription()
{
  PluginDescription description;
  description.label = "web_render";
  description.brief = "a page for the browser: live 3D view, list, inspector, plots; prints its address";
  description.parameters = Joined(
      {{"port", ParameterType::kInteger, "", "0", "TCP port of the page; 0 takes a free one.", 0, 65535},
       {"address", ParameterType::kText, "", "127.0.0.1",
        "IP address to listen on. The default serves this machine only; 0.0.0.0 serves every network that it is in."},
       {.name = "tls",
        .type = ParameterType::kChoice,
        .default_value = "auto",
        .description = "Whether the page is reached by https alone; auto: if the address is not of this machine only.",
        .choices = {"auto", "on", "off"}},
       {"certificate", ParameterType::kPath, "", "",
        "File with certificate chain and private key for https, in the form PEM; without it web_render makes a "
        "certificate of its own, keeps it, and prints its fingerprint."},
       {"rate", ParameterType::kNumber, "Hz", "30", "States per second that a page gets at most.", 0.1, 60},
       {"bandwidth", ParameterType::kNumber, "MB/s", "1",
        "States that each page gets at most. Thousands of robots come less often then; the page draws what is between.",
        0.01, 1000},
       {"allow_control", ParameterType::kBoolean, "", "false",
        "Lets all who have the printed address, with its token, pause, step, change the speed and move entities."},
       {"clients", ParameterType::kInteger, "", "16",
        "Pages without the token that may look at the same time; as many others that have it.", 1, 256},
       {"linger", ParameterType::kNumber, "s", "-1",
        "Time for which the last state is served after the run; -1: until interrupted where attached, not at all where "
        "the visualisation is part of the experiment.",
        -1, 1e9},
       {"url_file", ParameterType::kText, "", "",
        "File that gets the address, taken from the run's folder; without it web_render.url where the visualisation is "
        "part of the experiment, none where attached."}},
      ViewpointParameters());
  return description;
}

}  // namespace swarmanoid
