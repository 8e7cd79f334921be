// What is done with the whole table of a plug-in's parameters: checking what an experiment gives, and filling in what
// it leaves out. Used by the reader of experiment files and by the program of a real robot, so that both say the same.
#pragma once

#include <string>
#include <vector>

#include "common/configuration/parameter.h"

namespace swarmanoid
{

// Everything that is wrong with the parameters of an element, each with its place and the nearest name. `owner` is
// whose parameters they are, without an article: "controller <footbot_diffusion>". `others`: names of attributes and
// elements that are no parameters and are checked elsewhere.
std::vector<ConfigurationError> MistakesIn(const TConfigurationTree& tree, const std::vector<ParameterSpec>& specs,
                                           const std::string& owner, const std::vector<std::string>& others = {});

// The element, or an empty one of that name and place if there is none.
TConfigurationTree OrEmpty(const TConfigurationTree& tree, const std::string& name, const SourceLocation& place);

// The element with all its parameters: those that it leaves out have their defaults. Paths are absolute: relative ones
// start at `folder`. A default that is no value of its type ("" of a number) stands for none: it is not filled in.
TConfigurationTree WithDefaults(const TConfigurationTree& tree, const std::vector<ParameterSpec>& specs,
                                const std::string& folder);

// `own`, followed by `more`: tables of parameters are put together from parts.
std::vector<ParameterSpec> Joined(std::vector<ParameterSpec> own, const std::vector<ParameterSpec>& more);

// What is wrong with a table itself, such as a default outside of the range; empty if it is right.
std::string MistakeInTable(const std::vector<ParameterSpec>& specs);

}  // namespace swarmanoid
