// What an element of an experiment file may hold, by its place in the file: for whoever lets users fill it in. It comes
// from the tables that the reader of the file checks against. Used by `swarmanoid edit`.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/configuration/parameter.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid
{

struct ElementForm
{
  struct Child
  {
    std::string tag;
    std::string description;
    std::vector<ParameterSpec> required;  // what a new one has to be given
    bool may_be_added = true;             // false: it is there, and once is all
  };

  bool known = false;  // false: no table says what the element holds
  std::string description;
  std::vector<ParameterSpec> parameters;  // each a value, as an attribute or as a child element
  std::vector<Child> children;
  bool required = false;  // an experiment without it is none
};

// `path`: the elements from the root of the experiment to the one that is asked for. The libraries of its plug-ins are
// loaded, as after reading the experiment: others are not known.
ElementForm FormOf(std::span<const ConfigurationNode* const> path);

}  // namespace swarmanoid
