// Documents generated from the tables of the experiment file and of the registered plug-ins.
#pragma once

#include <string>

#include "common/plugins/catalogue.h"

namespace swarmanoid
{

// docs/experiment_reference.md: every element and parameter but those of plug-ins.
std::string ExperimentReference();

// The same as an XML schema, for editors, with the registered plug-ins and their parameters. `swarmanoid list schema`
// prints it. Elements of other plug-ins may hold anything in it.
std::string ExperimentXsd();

// docs/plugin_reference.md: the registered plug-ins of all kinds: labels, robots, channels, parameters.
std::string PluginReference();

// As these pages say it: "number", "x, y", "calm, wild".
std::string TypeText(const ParameterSpec& parameter);

}  // namespace swarmanoid
