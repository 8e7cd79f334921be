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

// Splits descriptions of parameters: at most 20 words stand in the cell of a table, the rest in a list under it.
class TableNotes
{
public:
  // Returns the part for the cell, with bars escaped, and keeps the rest.
  std::string Cell(const ParameterSpec& parameter);
  // Returns the list with an empty line before it; empty if all descriptions are short.
  std::string List() const;

private:
  std::string list_;
};

}  // namespace swarmanoid
