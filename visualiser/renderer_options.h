// Reads a renderer's parameters from a command line: as --name value, with one option for each entry of its table, and
// as name=value. `swarmanoid attach` and the visualiser program use it.
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

// Returns the description of "text" or "text_render", or of the renderer in a user's library, given by a path or a name
// in SWARMANOID_PLUGIN_PATH. Throws ConfigurationError with the available renderers. The result is valid until the
// program ends.
const PluginDescription& FindRenderer(std::string_view kind);

// Adds --name for every parameter of the renderer; a given value is added to `parameters` as "name=value". Choices of a
// parameter called `format` are flags too: --csv. A name that the command itself uses is left out.
void AddRendererOptions(CLI::App& app, const PluginDescription& renderer, std::vector<std::string>& parameters);

// Adds the words "name=value" of a renderer, and its options as above if its kind is not empty.
void AddParametersOf(const std::string& kind, CLI::App& app, std::vector<std::string>& parameters);

// Makes the configuration of a renderer from words "name=value". Throws ConfigurationError with the allowed values.
RenderConfiguration ConfigureRenderer(const PluginDescription& renderer, const std::vector<std::string>& parameters);

}  // namespace swarmanoid
