// The table of experiment files, which declares every element and parameter once. The reader, the defaults, the error
// messages, docs/experiment_reference.md and the XML schema follow from it. Plug-ins have their own tables.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/configuration/parameter.h"
#include "common/experiment/experiment.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid
{

struct ElementSpec
{
  // The first tag is the name; the others are aliases. Empty for the elements of plug-ins, whose tags are labels.
  std::vector<std::string> tags;
  std::string description;
  // Each may be written as an attribute or as a child element.
  std::vector<ParameterSpec> parameters;
  std::vector<ElementSpec> children;
  bool required = false;
  bool repeatable = false;
  // If set, registered labels of that kind are further child tags. plugin_element has one entry: the common content of
  // these children.
  std::optional<PluginKind> plugins;
  std::vector<ElementSpec> plugin_element;
  std::optional<EntityKind> entity;

  const std::string& Name() const { return tags.front(); }
  // Returns whether the tag is the name or an alias.
  bool HasTag(const std::string& tag) const;
  // Returns the child element of that tag or name, nullptr for none.
  const ElementSpec* FindChild(const std::string& tag) const;
  // Returns the same for an element that exists by construction of the table.
  const ElementSpec& Child(const std::string& tag) const;
};

// Returns the root element, <ahss-config>. It grows with the table of entity kinds; references stay valid.
const ElementSpec& ExperimentSchema();

// Returns the elements of entities in the arena. Without position and orientation, they also describe the content of
// <distribute>.
const std::vector<ElementSpec>& EntityElements();
const std::vector<ElementSpec>& DistributedEntityElements();

// One experiment has at most this many entities.
inline constexpr std::size_t kMostEntities = 2'000'000;
// No body and no arena is smaller than this, in metres.
inline constexpr double kLeastSize = 1e-6;

}  // namespace swarmanoid
