// ScriptParameters: the parameters that the scripts of controllers declare. A plug-in that runs scripts registers a
// reader of declarations beside its description. Filled before roles start, and read-only afterwards.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/configuration/parameter.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid
{

class ScriptParameters
{
public:
  // Returns the parameters that the script named in <parameters> declares. Throws ConfigurationError for a mistake of
  // the script. `folder`: relative paths start here.
  using Reader = std::vector<ParameterSpec> (*)(const TConfigurationTree& parameters, const std::string& folder);

  static ScriptParameters& Instance();

  // Sets the reader of a controller.
  void Add(const std::string& label, Reader reader) { readers_.emplace(label, reader); }
  bool Has(const std::string& label) const { return readers_.contains(label); }
  // Returns the table of a controller's parameters, with those that its script declares. `parameters`: the element in
  // the file.
  std::vector<ParameterSpec> TableOf(const PluginDescription& controller, const TConfigurationTree& parameters,
                                     const std::string& folder) const;

private:
  std::map<std::string, Reader> readers_;
};

}  // namespace swarmanoid
