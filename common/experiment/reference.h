// Documents generated from the tables of the experiment file and of the registered plug-ins.
#pragma once

#include <string>

#include "common/plugins/catalogue.h"

namespace swarmanoid
{

// docs/experiment_reference.md: every element and parameter but those of plug-ins.
std::string ExperimentReference();

// docs/experiment.xsd: the same as an XML schema, for editors. Elements of plug-ins may hold anything in it.
std::string ExperimentXsd();

// A page about the registered plug-ins of all kinds but controllers: labels, robots, channels, parameters.
std::string PluginReference();

}  // namespace swarmanoid
