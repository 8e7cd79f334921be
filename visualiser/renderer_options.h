// A renderer's parameters on a command line: as --name value, one option for each entry of its table, and as
// name=value. Used by `swarmanoid attach` and by the visualiser program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "visualiser/render.h"

namespace CLI
{
class App;
}

namespace swarmanoid
{

// The description of "text" or "text_render", or of the renderer in a user's library: a path, or a name that is looked
// for in SWARMANOID_PLUGIN_PATH. Throws ConfigurationError, naming those that there are. The result stays until the
// program ends.
const PluginDescription& FindRenderer(std::string_view kind);

// Adds --name for every parameter of the renderer; a value given goes to `parameters` as "name=value". Choices of a
// parameter called `format` are flags too: --csv. A name that the command uses itself is left out.
void AddRendererOptions(CLI::App& app, const PluginDescription& renderer, std::vector<std::string>& parameters);

// The configuration of a renderer from words "name=value". Throws ConfigurationError with what is allowed.
RenderConfiguration ConfigureRenderer(const PluginDescription& renderer, const std::vector<std::string>& parameters);

}  // namespace swarmanoid
