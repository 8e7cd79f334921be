// ParameterChecks: checks that the table of a plug-in's parameters cannot express, such as values that must fit each
// other. The reader of experiment files calls them, so that these mistakes are found before anything starts. They are
// added beside the registries of plug-ins before roles start, and are read-only afterwards.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "common/plugins/catalogue.h"

namespace swarmanoid
{

// Returns the mistakes in parameters that are valid one by one. Each names its position, the value and the cure.
using ParameterCheck = std::function<std::vector<ConfigurationError>(const Parameters&)>;

class ParameterChecks
{
public:
  static ParameterChecks& Instance();

  // Adds a check. A plug-in may have several.
  void Add(PluginKind kind, const PluginDescription& plugin, ParameterCheck check);
  // Returns the mistakes that all checks of the plug-in find.
  std::vector<ConfigurationError> Mistakes(PluginKind kind, const PluginDescription& plugin,
                                           const Parameters& parameters) const;

private:
  std::map<std::tuple<PluginKind, std::string, std::string>, std::vector<ParameterCheck>> checks_;
};

}  // namespace swarmanoid
