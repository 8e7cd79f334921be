// Checks and completes the parameters of a plug-in by its table. The reader of experiment files and the program of a
// real robot share it, so that their messages are the same.
#pragma once

#include <string>
#include <vector>

#include "common/configuration/parameter.h"

namespace swarmanoid
{

// Returns all mistakes in the parameters of an element, each with its position and the nearest name. `owner` names the
// plug-in without an article: "controller <footbot_diffusion>". `others`: attributes and elements that are no
// parameters and are checked elsewhere.
std::vector<ConfigurationError> MistakesIn(const TConfigurationTree& tree, const std::vector<ParameterSpec>& specs,
                                           const std::string& owner, const std::vector<std::string>& others = {});

// Returns the element, or an empty element of that name and position if it does not exist.
TConfigurationTree OrEmpty(const TConfigurationTree& tree, const std::string& name, const SourceLocation& place);

// Returns the element with defaults for all parameters that it leaves out. Paths become absolute: relative ones start
// at `folder`. A default that is no value of its type ("" for a number) is not filled in.
TConfigurationTree WithDefaults(const TConfigurationTree& tree, const std::vector<ParameterSpec>& specs,
                                const std::string& folder);

// Returns `own`, followed by `more`. Tables of parameters are joined from parts.
std::vector<ParameterSpec> Joined(std::vector<ParameterSpec> own, const std::vector<ParameterSpec>& more);

// Returns the mistake in a table itself, such as a default out of range; empty if the table is right.
std::string MistakeInTable(const std::vector<ParameterSpec>& specs);

}  // namespace swarmanoid
