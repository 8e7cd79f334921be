// Documents generated from the tables of the experiment file and of the registered plug-ins.
#pragma once

#include <string>

#include "common/plugins/catalogue.h"

namespace swarmanoid
{

// Returns docs/experiment_reference.md: every element and parameter except those of plug-ins.
std::string ExperimentReference();

// Returns the same as an XML schema, for editors, with the registered plug-ins and their parameters. `swarmanoid list
// schema` prints it. Elements of other plug-ins may have any content.
std::string ExperimentXsd();

// Returns docs/plugin_reference.md: labels, robots, channels and parameters of all registered plug-ins.
std::string PluginReference();

// Returns the type as these pages show it: "number", "x, y", "calm, wild".
std::string TypeText(const ParameterSpec& parameter);

}  // namespace swarmanoid
