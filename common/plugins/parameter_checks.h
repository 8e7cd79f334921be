// ParameterChecks: what the table of a plug-in's parameters cannot say, such as values that must fit each other. The
// reader of experiment files asks for them, so that these mistakes are found before anything starts, too. Filled beside
// the registries of plug-ins, before roles start; read-only afterwards.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "common/plugins/catalogue.h"

namespace swarmanoid
{

// The mistakes in parameters that are right each by itself; every one names its place, the value and the cure.
using ParameterCheck = std::function<std::vector<ConfigurationError>(const Parameters&)>;

class ParameterChecks
{
public:
  static ParameterChecks& Instance();

  // A plug-in may have several checks.
  void Add(PluginKind kind, const PluginDescription& plugin, ParameterCheck check);
  // What all checks of the plug-in find.
  std::vector<ConfigurationError> Mistakes(PluginKind kind, const PluginDescription& plugin,
                                           const Parameters& parameters) const;

private:
  std::map<std::tuple<PluginKind, std::string, std::string>, std::vector<ParameterCheck>> checks_;
};

}  // namespace swarmanoid
