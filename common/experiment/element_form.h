// The allowed content of an element of an experiment file, by its path in the file, for editors in which users fill it
// in. It comes from the tables that the reader of the file checks against. `swarmanoid edit` uses it.
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
    std::vector<ParameterSpec> required;  // parameters that a new element must get
    bool may_be_added = true;             // false: the element exists and may occur only once
  };

  bool known = false;  // false: no table describes the content of the element
  std::string description;
  std::vector<ParameterSpec> parameters;  // each one value, as an attribute or as a child element
  std::vector<Child> children;
  bool required = false;  // an experiment must have the element
};

// Returns the form of an element. `path`: the elements from the root of the experiment to it. Only plug-ins whose
// libraries are loaded, as after reading the experiment, are known.
ElementForm FormOf(std::span<const ConfigurationNode* const> path);

}  // namespace swarmanoid
