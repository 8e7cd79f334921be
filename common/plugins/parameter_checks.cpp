#include "common/plugins/parameter_checks.h"

#include <utility>

namespace swarmanoid
{

ParameterChecks& ParameterChecks::Instance()
{
  static ParameterChecks checks;
  return checks;
}

void ParameterChecks::Add(PluginKind kind, const PluginDescription& plugin, ParameterCheck check)
{
  checks_[{kind, plugin.label, plugin.implementation}].push_back(std::move(check));
}

std::vector<ConfigurationError> ParameterChecks::Mistakes(PluginKind kind, const PluginDescription& plugin,
                                                          const Parameters& parameters) const
{
  std::vector<ConfigurationError> all;
  const auto found = checks_.find({kind, plugin.label, plugin.implementation});
  if (found == checks_.end()) return all;
  for (const ParameterCheck& check : found->second)
    for (ConfigurationError& mistake : check(parameters)) all.push_back(std::move(mistake));
  return all;
}

}  // namespace swarmanoid
