#include "common/plugins/script_parameters.h"

#include "common/configuration/parameter_table.h"

namespace swarmanoid
{

ScriptParameters& ScriptParameters::Instance()
{
  static ScriptParameters parameters;
  return parameters;
}

std::vector<ParameterSpec> ScriptParameters::TableOf(const PluginDescription& controller,
                                                     const TConfigurationTree& parameters,
                                                     const std::string& folder) const
{
  const auto found = readers_.find(controller.label);
  if (found == readers_.end() || !parameters.Exists()) return controller.parameters;
  return Joined(controller.parameters, found->second(parameters, folder));
}

}  // namespace swarmanoid
